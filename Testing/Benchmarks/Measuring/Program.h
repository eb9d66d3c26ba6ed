// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

/// The arguments of a program, each with a default.
class Arguments
{
public:
  Arguments(int argc, char* argv[])
    : words_(argv + 1, argv + argc)
  {
  }

  /// Throws std::invalid_argument for a word that is no number.
  template <class Number>
  Number number(std::size_t i, Number otherwise) const
  {
    return i < words_.size() ? static_cast<Number>(std::stod(words_[i])) : otherwise;
  }
  std::string text(std::size_t i, const std::string& otherwise) const
  {
    return i < words_.size() ? words_[i] : otherwise;
  }

private:
  std::vector<std::string> words_;
};

/// What a benchmark does; each program defines its own. Errors are exceptions.
void run(const Arguments& arguments);
