// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Progress/InputError.h"

#include "vtksys/SystemTools.hxx"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <system_error>
#include <vector>

namespace irradiance
{

/// A file of comma-separated values, line by line. The first line names the columns, in any order;
/// empty lines and those that begin with # are passed over, blanks and quotes around a value as
/// well. All throw InputError, naming file, line, column and value.
class CommaTable
{
public:
  /// `ignoresCase`: columns are asked for in small letters, and the file has any.
  explicit CommaTable(const std::string& fileName, bool ignoresCase = false)
    : fileName_(fileName)
    , stream_(fileName)
  {
    throwIf(!stream_, "the file ", fileName, " cannot be read");
    std::error_code unknown; // such as the length of a pipe
    length_ = std::filesystem::file_size(fileName, unknown);
    length_ = unknown ? 0 : length_;
    throwIf(!next(), "the file ", fileName, " is empty; its first line has to name the columns");
    for (std::size_t i = 0; i < cells_.size(); ++i)
    {
      std::string& name = cells_[i];
      constexpr const char* kMark = "\xef\xbb\xbf"; // with which some programs begin text
      name = name.rfind(kMark, 0) == 0 ? trimmed(name.substr(3)) : name;
      name = ignoresCase ? vtksys::SystemTools::LowerCase(name) : name;
      failIf(!columns_.emplace(name, i).second, ": two columns are named ", name);
    }
    header_ = where();
  }

  /// Reads the next line with values; false at the end.
  bool next()
  {
    std::string line, content;
    do
    {
      if (!std::getline(stream_, line))
      {
        throwIf(stream_.bad(), "the file ", fileName_, " cannot be read");
        return false;
      }
      ++line_;
      read_ += line.size() + 1;
      content = trimmed(line);
    } while (content.empty() || content.front() == '#');
    cells_ = cellsOf(line);
    return true;
  }

  /// What was read of the file, 0..1; 0 if its length is not known.
  double progress() const
  {
    return length_ > 0 ? std::min(1.0, static_cast<double>(read_) / static_cast<double>(length_))
                       : 0;
  }
  std::string where() const { return "line " + std::to_string(line_) + " of " + fileName_; }
  /// Throws InputError that begins with where().
  template <class... Parts>
  void failIf(bool isWrong, const Parts&... parts) const
  {
    throwIf(isWrong, "line ", line_, " of ", fileName_, parts...);
  }

  bool has(const std::string& column) const { return columns_.count(column) > 0; }
  bool hasAny(const std::vector<std::string>& columns) const
  {
    return std::any_of(
      columns.begin(), columns.end(), [this](const std::string& column) { return has(column); });
  }
  void require(const std::vector<std::string>& columns) const
  {
    for (const std::string& column : columns)
    {
      throwIf(!has(column), header_, ": there is no column ", column);
    }
  }

  const std::string& cell(const std::string& column) const
  {
    const std::size_t i = columns_.at(column);
    failIf(i >= cells_.size(), " has ", cells_.size(), " values and none in the column ", column);
    return cells_[i];
  }
  /// A finite number.
  double value(const std::string& column) const
  {
    const std::string& text = cell(column);
    const char* begin = text.data() + (!text.empty() && text.front() == '+' ? 1 : 0);
    const char* end = text.data() + text.size();
    double number = 0;
    const auto read = std::from_chars(begin, end, number); // the same in every locale
    failIf(read.ec != std::errc() || read.ptr != end, ", column ", column, ": \"", text,
      "\" is not a number");
    failIf(!std::isfinite(number), ", column ", column, ": ", text, " is not finite");
    return number;
  }

private:
  /// Without the blanks and the quotes around it.
  static std::string trimmed(const std::string& cell)
  {
    constexpr const char* kAround = " \t\r\"";
    const std::size_t first = cell.find_first_not_of(kAround);
    return first == std::string::npos
      ? std::string()
      : cell.substr(first, cell.find_last_not_of(kAround) - first + 1);
  }

  static std::vector<std::string> cellsOf(const std::string& line)
  {
    std::vector<std::string> cells;
    std::size_t begin = 0;
    for (std::size_t comma = 0; comma != std::string::npos; begin = comma + 1)
    {
      comma = line.find(',', begin);
      cells.push_back(trimmed(line.substr(begin, comma - begin)));
    }
    return cells;
  }

  std::string fileName_;
  std::ifstream stream_;
  std::uintmax_t read_ = 0, length_ = 0; ///< bytes
  std::size_t line_ = 0;
  std::string header_;
  std::vector<std::string> cells_;
  std::map<std::string, std::size_t> columns_;
};

}
