// SPDX-License-Identifier: BSD-3-Clause
#include "Input/CommaTable.h"

#include "vtksys/SystemTools.hxx"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <system_error>

namespace irradiance
{

namespace
{

/// Without the blanks and the quotes around it.
std::string trimmed(const std::string& cell)
{
  constexpr const char* kAround = " \t\r\"";
  const std::size_t first = cell.find_first_not_of(kAround);
  return first == std::string::npos
    ? std::string()
    : cell.substr(first, cell.find_last_not_of(kAround) - first + 1);
}

std::vector<std::string> cellsOf(const std::string& line)
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

}

CommaTable::CommaTable(const std::string& fileName, bool ignoresCase)
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

bool CommaTable::next()
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

double CommaTable::progress() const
{
  return length_ > 0 ? std::min(1.0, static_cast<double>(read_) / static_cast<double>(length_)) : 0;
}

bool CommaTable::hasAny(const std::vector<std::string>& columns) const
{
  return std::any_of(
    columns.begin(), columns.end(), [this](const std::string& column) { return has(column); });
}

void CommaTable::require(const std::vector<std::string>& columns) const
{
  for (const std::string& column : columns)
  {
    throwIf(!has(column), header_, ": there is no column ", column);
  }
}

const std::string& CommaTable::cell(const std::string& column) const
{
  const std::size_t i = columns_.at(column);
  failIf(i >= cells_.size(), " has ", cells_.size(), " values and none in the column ", column);
  return cells_[i];
}

double CommaTable::value(const std::string& column) const
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

}
