// SPDX-License-Identifier: BSD-3-Clause
#include "Options.h"

#include "CommandLine.h"

#include <algorithm>
#include <stdexcept>

namespace pathtracedroom
{
namespace
{

using namespace movingteapot;

Setter Traversal(irradiance::TraversalMode& mode)
{
  return [&mode](const std::string& text) {
    const auto& all = Options::Traversals;
    const auto found = std::find_if(
      all.begin(), all.end(), [&](const Options::TraversalName& t) { return t.Name == text; });
    if (found == all.end())
    {
      throw std::invalid_argument("onetree, sequential or parallel");
    }
    mode = found->Mode;
  };
}

std::vector<Option> OptionsOf(Options& o)
{
  return {
    { "--scene", "NAME", "room", "room or teapots", Text(o.Scene) },
    { "--segments", "N", "30", "cuts along each edge of a teapot patch", Count(o.Segments, 2) },
    { "--size", "WxH", "640x480", "size of the picture in pixels", Size(o.Width, o.Height, 1) },
    { "--samples", "N", "64", "samples for each pixel", Count(o.Samples, 1) },
    { "--threads", "N", "0", "threads; 0: all there are", Count(o.Threads, 0) },
    { "--traversal", "MODE", "parallel", "onetree, sequential or parallel",
      Traversal(o.Traversal) },
    { "--traversals", "", "", "no picture: times the three traversals",
      Switch(o.CompareTraversals, true) },
    { "--rounds", "N", "5", "rounds of that", Count(o.Rounds, 1) },
    { "--output", "FOLDER", "./PathTracedRoom-output", "where all results go", Text(o.Output) },
    { "--help", "", "", "this text", Switch(o.Help, true) },
  };
}

}

const std::vector<Options::TraversalName> Options::Traversals = {
  { "onetree", irradiance::TraversalMode::OneTree },
  { "sequential", irradiance::TraversalMode::Sequential },
  { "parallel", irradiance::TraversalMode::Parallel },
};

Options ReadOptions(const std::vector<std::string>& words)
{
  Options result;
  ReadCommandLine(OptionsOf(result), words);
  return result;
}

std::string HelpText()
{
  Options ignored;
  return ComposeHelp("PathTracedRoom: a picture by bidirectional path tracing.", OptionsOf(ignored),
    "", "PathTracedRoom.png, PathTracedRoom.vti");
}

}
