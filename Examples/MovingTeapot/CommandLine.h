// SPDX-License-Identifier: BSD-3-Clause
/** Options of a program from a table of them: each says what it takes and where that goes. */
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace movingteapot
{

/** Takes an option's text; throws std::invalid_argument that says what was expected instead. */
using Setter = std::function<void(const std::string&)>;

/** A number from `least` to `most`. The references must outlive the setters. */
Setter Number(double& value, double least, double most, const std::string& expected);
/** A whole number, `least` at least. */
Setter Count(int& value, int least);
/** Such as 1280x720, in pixels: at least `least` wide and high. */
Setter Size(int& width, int& height, int least = 120);
Setter Text(std::string& value);
Setter Switch(bool& value, bool to);

struct Option
{
  std::string Name;
  std::string Value; // what it takes: its unit, or N, FILE and the like; empty for a switch
  std::string Default;
  std::string Help;
  Setter Set;
};

/**
 * Sets the defaults, then what the words "--option value" or "--option=value" say. Throws
 * std::runtime_error that names the option and what is wrong with it.
 */
void ReadCommandLine(const std::vector<Option>& options, const std::vector<std::string>& words);

/**
 * What --help prints: `purpose`, a line for each option with its default, `notes` (may be empty),
 * and, last, `results`: the files in the folder of the option --output.
 */
std::string ComposeHelp(const std::string& purpose, const std::vector<Option>& options,
  const std::string& notes, const std::string& results);

}
