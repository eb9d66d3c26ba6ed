// SPDX-License-Identifier: BSD-3-Clause
#include "Options.h"

#include <vtksys/CommandLineArguments.hxx>

#include <algorithm>
#include <cstdio>
#include <stdexcept>

namespace pathtracedroom
{
namespace
{

int Reject(const char* argument, void*)
{
  throw std::runtime_error(std::string(argument) + ": there is no such option");
}

void Check(bool isGood, const char* what)
{
  if (!isGood)
  {
    throw std::runtime_error(what);
  }
}

void SetSize(const std::string& text, Options& options)
{
  int end = 0;
  const int read = std::sscanf(text.c_str(), "%dx%d%n", &options.Width, &options.Height, &end);
  Check(read == 2 && end == int(text.size()) && options.Width >= 1 && options.Height >= 1 &&
      std::max(options.Width, options.Height) <= 8192,
    "--size: pixels such as 640x480 are expected, up to 8192x8192");
}

void SetTraversal(const std::string& name, Options& options)
{
  const auto found = std::find_if(Options::Traversals.begin(), Options::Traversals.end(),
    [&](const Options::TraversalName& traversal) { return traversal.Name == name; });
  Check(found != Options::Traversals.end(), "--traversal: onetree, sequential or parallel");
  options.Traversal = found->Mode;
}

}

const std::vector<Options::TraversalName> Options::Traversals = {
  { "onetree", irradiance::TraversalMode::OneTree },
  { "sequential", irradiance::TraversalMode::Sequential },
  { "parallel", irradiance::TraversalMode::Parallel },
};

Options ReadOptions(int argc, const char* const* argv)
{
  Options options;
  std::string size = "640x480", traversal = "parallel";
  bool help = false;
  using Arguments = vtksys::CommandLineArguments;
  Arguments arguments;
  arguments.Initialize(argc, argv);
  arguments.SetUnknownArgumentCallback(Reject);
  const auto add = [&](const char* name, auto* value, const char* text) {
    arguments.AddArgument(name, Arguments::SPACE_ARGUMENT, value, text);
  };
  add("--scene", &options.Scene, "room or teapots (room)");
  add("--segments", &options.Segments, "cuts along each edge of a teapot patch (30)");
  add("--size", &size, "of the picture in pixels (640x480)");
  add("--samples", &options.Samples, "for each pixel (64)");
  add("--threads", &options.Threads, "0: all there are (0)");
  add("--output", &options.Output, "the picture without .png (PathTracedRoom)");
  add("--traversal", &traversal, "onetree, sequential or parallel (parallel)");
  add("--rounds", &options.Rounds, "of the comparison (5)");
  arguments.AddBooleanArgument(
    "--traversals", &options.CompareTraversals, "no picture: times the three traversals");
  arguments.AddBooleanArgument("--help", &help, "this text");
  Check(arguments.Parse() != 0, "an option lacks its value; --help shows all");
  options.Help = help ? std::string("Options:\n") + arguments.GetHelp() : "";
  SetSize(size, options);
  SetTraversal(traversal, options);
  Check(options.Segments >= 2, "--segments: a whole number from 2 on is expected");
  Check(options.Samples >= 1, "--samples: a whole number from 1 on is expected");
  Check(options.Rounds >= 1, "--rounds: a whole number from 1 on is expected");
  Check(options.Threads >= 0, "--threads: a whole number from 0 on is expected");
  return options;
}

}
