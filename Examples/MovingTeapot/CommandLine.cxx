// SPDX-License-Identifier: BSD-3-Clause
#include "CommandLine.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace movingteapot
{
namespace
{

double ReadNumber(const std::string& text, double least, double most, const std::string& expected)
{
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !(number >= least && number <= most))
  {
    throw std::invalid_argument(expected);
  }
  return number;
}

}

Setter Number(double& value, double least, double most, const std::string& expected)
{
  return [&value, least, most, expected](
           const std::string& text) { value = ReadNumber(text, least, most, expected); };
}

Setter Count(int& value, int least)
{
  return [&value, least](const std::string& text) {
    const std::string expected = "a whole number, at least " + std::to_string(least) + ",";
    const double number = ReadNumber(text, least, std::numeric_limits<int>::max(), expected);
    if (int(number) != number)
    {
      throw std::invalid_argument(expected);
    }
    value = int(number);
  };
}

Setter Size(int& width, int& height, int least)
{
  return [&width, &height, least](const std::string& text) {
    int end = 0;
    if (std::sscanf(text.c_str(), "%dx%d%n", &width, &height, &end) != 2 ||
      end != int(text.size()) || std::min(width, height) < least || std::max(width, height) > 8192)
    {
      const std::string limit = std::to_string(least);
      throw std::invalid_argument(limit + "x" + limit + " to 8192x8192 pixels, such as 1280x720,");
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

void ReadCommandLine(const std::vector<Option>& options, const std::vector<std::string>& words)
{
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
      throw std::runtime_error(name + ": its value is missing");
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
}

std::string ComposeHelp(const std::string& purpose, const std::vector<Option>& options,
  const std::string& notes, const std::string& results)
{
  std::ostringstream help;
  help << purpose << "\n\nOptions:\n" << std::left;
  std::string folder;
  for (const Option& option : options)
  {
    const std::string value = option.Value.empty() ? "off" : "none";
    help << "  " << std::setw(18) << option.Name << std::setw(7) << option.Value << option.Help
         << " (" << (option.Default.empty() ? value : option.Default) << ")\n";
    folder = option.Name == "--output" ? option.Default : folder;
  }
  help << (notes.empty() ? "" : "\n") << notes << "\nResults: " << folder << ": " << results
       << '\n';
  return help.str();
}

}
