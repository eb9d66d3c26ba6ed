// SPDX-License-Identifier: BSD-3-Clause
#include "Options.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iomanip>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace movingteapot
{
namespace
{

// Throws std::invalid_argument that says what was expected instead of an option's text.
using Setter = std::function<void(const std::string&)>;

template <typename T>
Setter Number(T& value, double least, double most, const std::string& expected)
{
  return [&value, least, most, expected](const std::string& text) {
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    const bool inRange = !text.empty() && *end == '\0' && number >= least && number <= most;
    if (!inRange || T(number) != number)
    {
      throw std::invalid_argument(expected);
    }
    value = T(number);
  };
}

Setter Count(int& value, int least)
{
  return Number(value, least, std::numeric_limits<int>::max(),
    "a whole number, at least " + std::to_string(least) + ",");
}

Setter Size(int& width, int& height)
{
  return [&](const std::string& text) {
    int end = 0;
    if (std::sscanf(text.c_str(), "%dx%d%n", &width, &height, &end) != 2 ||
      end != int(text.size()) || width < 160 || height < 120 || std::max(width, height) > 8192)
    {
      throw std::invalid_argument("160x120 to 8192x8192 pixels, such as 1280x720,");
    }
  };
}

Setter TraversalMode(int& mode)
{
  return [&mode](const std::string& text) {
    const std::vector<std::string> names = { "onetree", "sequential", "parallel" };
    mode = int(std::find(names.begin(), names.end(), text) - names.begin());
    if (mode == int(names.size()))
    {
      throw std::invalid_argument("onetree, sequential or parallel");
    }
  };
}

Setter Text(std::string& value)
{
  return [&value](const std::string& text) { value = text; };
}

Setter Switch(bool& value, bool to)
{
  return [&value, to](const std::string&) { value = to; };
}

struct Option
{
  std::string Name;
  std::string Value; // what it takes; empty for a switch
  std::string Default;
  std::string Help;
  Setter Set;
};

std::vector<Option> OptionsOf(Options& o)
{
  return {
    { "--walks", "N", "1000000", "shooting walks", Count(o.Walks, 1) },
    { "--frames", "N", "60", "frames, the first included", Count(o.Frames, 2) },
    { "--threads", "N", "0", "threads; 0: all there are", Count(o.Threads, 0) },
    { "--output", "FOLDER", "./MovingTeapot-output", "where everything is written",
      Text(o.Output) },
    { "--size", "WxH", "1280x720", "size of the pictures in pixels", Size(o.Width, o.Height) },
    { "--smooth", "N", "2", "times to smooth head and teapot in the pictures",
      Count(o.Smoothings, 0) },
    { "--traversal", "MODE", "parallel", "onetree, sequential or parallel",
      TraversalMode(o.TraversalMode) },
    { "--cell-size", "M", "0.046", "edge of the cells of the walls in m",
      Number(o.Scene.CellSize, 0.005, 1.0, "a number from 0.005 to 1") },
    { "--teapot-segments", "N", "10", "cuts along each edge of a teapot patch",
      Count(o.Scene.TeapotSegments, 2) },
    { "--head", "FILE", "", "a mesh of yours for the head (*)", Text(o.Scene.HeadFile) },
    { "--teapot", "FILE", "", "a mesh of yours for the teapot (*)", Text(o.Scene.TeapotFile) },
    { "--no-pictures", "", "", "no PNG files and no movie", Switch(o.Pictures, false) },
    { "--no-comparison", "", "", "the updates alone: half the time and memory",
      Switch(o.Comparison, false) },
    { "--help", "", "", "this text", Switch(o.Help, true) },
  };
}

}

Options ReadOptions(const std::vector<std::string>& words)
{
  Options result;
  const std::vector<Option> options = OptionsOf(result);
  for (const Option& option : options)
  {
    if (!option.Default.empty())
    {
      option.Set(option.Default);
    }
  }
  for (auto word = words.begin(); word != words.end(); ++word)
  {
    const std::size_t equal = word->find('=');
    const std::string name = word->substr(0, equal);
    const auto option =
      std::find_if(options.begin(), options.end(), [&](const Option& o) { return o.Name == name; });
    if (option == options.end() || (option->Value.empty() && equal != std::string::npos))
    {
      throw std::runtime_error(*word + ": there is no such option");
    }
    const bool isNext = !option->Value.empty() && equal == std::string::npos;
    if (isNext && ++word == words.end())
    {
      throw std::runtime_error("the last option lacks its value");
    }
    const std::string value = isNext ? *word : word->substr(equal + 1);
    try
    {
      option->Set(value);
    }
    catch (const std::invalid_argument& mismatch)
    {
      throw std::runtime_error(
        name + ": " + mismatch.what() + " is expected, not \"" + value + "\"");
    }
  }
  return result;
}

std::string HelpText()
{
  Options ignored;
  std::ostringstream help;
  help << "MovingTeapot: the light in a room through which a teapot moves.\n\nOptions:\n"
       << std::left;
  for (const Option& option : OptionsOf(ignored))
  {
    help << "  " << std::setw(18) << option.Name << std::setw(7) << option.Value << option.Help
         << (option.Default.empty() ? "" : " (" + option.Default + ")") << '\n';
  }
  help << "\n(*) .obj .ply .stl .vtp .vtk or .off, z up; it is scaled to fit.\n";
  return help.str();
}

}
