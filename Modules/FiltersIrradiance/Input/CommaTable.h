// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_CommaTable_h
#define irradiance_CommaTable_h

#include "Progress/InputError.h"

#include <cstdint>
#include <fstream>
#include <map>
#include <string>
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
  explicit CommaTable(const std::string& fileName, bool ignoresCase = false);

  /// Reads the next line with values; false at the end.
  bool next();

  /// What was read of the file, 0..1; 0 if its length is not known.
  double progress() const;
  std::string where() const { return "line " + std::to_string(line_) + " of " + fileName_; }
  /// Throws InputError that begins with where().
  template <class... Parts>
  void failIf(bool isWrong, const Parts&... parts) const
  {
    throwIf(isWrong, "line ", line_, " of ", fileName_, parts...);
  }

  bool has(const std::string& column) const { return columns_.count(column) > 0; }
  bool hasAny(const std::vector<std::string>& columns) const;
  void require(const std::vector<std::string>& columns) const;

  const std::string& cell(const std::string& column) const;
  /// A finite number.
  double value(const std::string& column) const;

private:
  std::string fileName_;
  std::ifstream stream_;
  std::uintmax_t read_ = 0, length_ = 0; ///< bytes
  std::size_t line_ = 0;
  std::string header_;
  std::vector<std::string> cells_;
  std::map<std::string, std::size_t> columns_;
};

}

#endif
