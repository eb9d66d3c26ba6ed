// SPDX-License-Identifier: BSD-3-Clause
#include "Options.h"

#include <vtksys/CommandLineArguments.hxx>

#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>

namespace movingteapot
{
namespace
{

using Arguments = vtksys::CommandLineArguments;

[[noreturn]] void Reject(const std::string& option, const std::string& text, const std::string& why)
{
  throw std::runtime_error(option + ": " + why + ", not \"" + text + "\"");
}

double ReadNumber(const std::string& option, const std::string& text, double least, double most)
{
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !(value >= least && value <= most))
  {
    const auto bound = [](double x) { return std::to_string(x).substr(0, 6); };
    Reject(option, text, "a number from " + bound(least) + " to " + bound(most) + " is expected");
  }
  return value;
}

int ReadCount(const std::string& option, const std::string& text, int least)
{
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const bool whole = !text.empty() && *end == '\0' && value == std::floor(value);
  if (!whole || value < least || value > std::numeric_limits<int>::max())
  {
    Reject(option, text, "a whole number, at least " + std::to_string(least) + ", is expected");
  }
  return int(value);
}

int ReadTraversalMode(const std::string& text)
{
  static const std::map<std::string, int> modes = { { "onetree", 0 }, { "sequential", 1 },
    { "parallel", 2 } };
  const auto mode = modes.find(text);
  if (mode == modes.end())
  {
    Reject("--traversal", text, "onetree, sequential or parallel is expected");
  }
  return mode->second;
}

void ReadSize(const std::string& text, int& width, int& height)
{
  const std::size_t cross = text.find('x');
  if (cross == std::string::npos)
  {
    Reject("--size", text, "width x height in pixels, such as 1280x720, is expected");
  }
  width = ReadCount("--size", text.substr(0, cross), 160);
  height = ReadCount("--size", text.substr(cross + 1), 120);
  if (width > 8192 || height > 8192)
  {
    Reject("--size", text, "at most 8192x8192 is expected");
  }
}

// The options as text, the way the parser of VTK takes them; their sense is checked above.
struct Texts
{
  std::string Walks = "1000000";
  std::string Frames = "60";
  std::string Threads = "0";
  std::string Output = "./MovingTeapot-output";
  std::string Size = "1280x720";
  std::string Smooth = "2";
  std::string Traversal = "parallel";
  std::string CellSize = "0.046";
  std::string TeapotSegments = "10";
  std::string Head;
  std::string Teapot;
  bool NoPictures = false;
  bool NoComparison = false;
  bool Help = false;
};

struct TextOption
{
  const char* Name;
  const char* Value;
  std::string Texts::*Text;
  const char* Help;
};

struct Switch
{
  const char* Name;
  bool Texts::*On;
  const char* Help;
};

constexpr TextOption TextOptions[] = {
  { "--walks", "N", &Texts::Walks, "shooting walks" },
  { "--frames", "N", &Texts::Frames, "frames, the first included" },
  { "--threads", "N", &Texts::Threads, "threads; 0: all there are" },
  { "--output", "FOLDER", &Texts::Output, "where everything is written" },
  { "--size", "WxH", &Texts::Size, "size of the pictures in pixels" },
  { "--smooth", "N", &Texts::Smooth, "times to smooth head and teapot in the pictures" },
  { "--traversal", "MODE", &Texts::Traversal, "onetree, sequential or parallel" },
  { "--cell-size", "M", &Texts::CellSize, "edge of the cells of the walls in m" },
  { "--teapot-segments", "N", &Texts::TeapotSegments, "cuts along each edge of a teapot patch" },
  { "--head", "FILE", &Texts::Head, "a mesh of yours for the head (*)" },
  { "--teapot", "FILE", &Texts::Teapot, "a mesh of yours for the teapot (*)" },
};

constexpr Switch Switches[] = {
  { "--no-pictures", &Texts::NoPictures, "no PNG files and no movie" },
  { "--no-comparison", &Texts::NoComparison, "the updates alone: half the time and memory" },
  { "--help", &Texts::Help, "this text" },
};

void Declare(Arguments& arguments, Texts& texts)
{
  for (const TextOption& option : TextOptions)
  {
    arguments.AddArgument(
      option.Name, Arguments::SPACE_ARGUMENT, &(texts.*option.Text), option.Help);
  }
  for (const Switch& option : Switches)
  {
    arguments.AddBooleanArgument(option.Name, &(texts.*option.On), option.Help);
  }
}

// The parser's "--option value"; "--option=value" is split into it.
void Feed(Arguments& arguments, int argc, char* argv[])
{
  arguments.Initialize();
  for (int i = 1; i < argc; ++i)
  {
    const std::string argument = argv[i];
    const std::size_t equal = argument.find('=');
    if (argument.rfind("--", 0) == 0 && equal != std::string::npos)
    {
      arguments.ProcessArgument(argument.substr(0, equal).c_str());
      arguments.ProcessArgument(argument.substr(equal + 1).c_str());
    }
    else
    {
      arguments.ProcessArgument(argument.c_str());
    }
  }
}

int KeepUnknown(const char* argument, void* unknown)
{
  *static_cast<std::string*>(unknown) = argument;
  return 0;
}

void Parse(Arguments& arguments)
{
  std::string unknown;
  arguments.SetClientData(&unknown);
  arguments.SetUnknownArgumentCallback(KeepUnknown);
  if (!arguments.Parse())
  {
    throw std::runtime_error(
      unknown.empty() ? "the last option lacks its value" : unknown + ": there is no such option");
  }
}

}

Options ReadOptions(int argc, char* argv[])
{
  Texts texts;
  Arguments arguments;
  Feed(arguments, argc, argv);
  Declare(arguments, texts);
  Parse(arguments);

  Options options;
  options.Walks = ReadCount("--walks", texts.Walks, 1);
  options.Frames = ReadCount("--frames", texts.Frames, 2);
  options.Threads = ReadCount("--threads", texts.Threads, 0);
  options.Output = texts.Output;
  options.Pictures = !texts.NoPictures;
  options.Comparison = !texts.NoComparison;
  ReadSize(texts.Size, options.Width, options.Height);
  options.SmoothingPasses = ReadCount("--smooth", texts.Smooth, 0);
  options.TraversalMode = ReadTraversalMode(texts.Traversal);
  options.CellSize = ReadNumber("--cell-size", texts.CellSize, 0.005, 1.0);
  options.TeapotSegments = ReadCount("--teapot-segments", texts.TeapotSegments, 2);
  options.HeadFile = texts.Head;
  options.TeapotFile = texts.Teapot;
  options.Help = texts.Help;
  return options;
}

std::string HelpText()
{
  const Texts defaults;
  std::ostringstream help;
  help << "MovingTeapot: the light in a room through which a teapot moves.\n\nOptions:\n";
  for (const TextOption& option : TextOptions)
  {
    const std::string& value = defaults.*option.Text;
    help << "  " << std::left << std::setw(18) << option.Name << std::setw(7) << option.Value
         << option.Help << (value.empty() ? "" : " (" + value + ")") << '\n';
  }
  for (const Switch& option : Switches)
  {
    help << "  " << std::left << std::setw(25) << option.Name << option.Help << '\n';
  }
  help << "\n(*) .obj .ply .stl .vtp .vtk or .off, z up; it is scaled to fit.\n";
  return help.str();
}

}
