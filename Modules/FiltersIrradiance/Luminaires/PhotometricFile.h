// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Luminaires/LuminousOpening.h"
#include "Progress/InputError.h"

#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace irradiance
{

/// Of ASCII letters, in every locale.
std::string upperCase(std::string_view text);

/// The lines of a lamp file, counted from 0 here and from 1 in errors.
class PhotometricText
{
public:
  /// Of UTF-8 or ISO 8859-1, with lines that end in any way, up to Ctrl-Z. Throws InputError.
  PhotometricText(const std::string& fileName, const std::string& bytes);
  PhotometricText(const PhotometricText&) = delete;
  PhotometricText& operator=(const PhotometricText&) = delete;

  const std::string& fileName() const { return fileName_; }
  std::size_t size() const { return lines_.size(); }
  /// Without blanks around it; empty past the end.
  std::string_view line(std::size_t i) const;
  /// The first line that begins with TILT=, in any case of letters; size() if there is none.
  std::size_t tiltLine() const;

  /// Throws InputError that names the line.
  template <class... Parts>
  void failIf(bool isWrong, std::size_t line, const Parts&... parts) const
  {
    throwIf(isWrong, fileName_, ", line ", line + 1, ": ", parts...);
  }
  /// A finite number, with a decimal point or comma, in every locale. Throws InputError.
  double number(std::size_t line, const char* name, std::string_view word) const;

private:
  std::string fileName_, text_;
  std::vector<std::string_view> lines_;
};

/// One number after the other, where any mixture of separators and ends of lines parts them.
class NumberReader
{
public:
  static constexpr std::size_t kMostValues = 4000000; ///< of a table

  /// `text` must outlive it.
  NumberReader(const PhotometricText& text, std::size_t firstLine, const char* separators)
    : text_(text)
    , line_(firstLine)
    , separators_(separators)
  {
  }

  /// What comes next; empty at the end.
  std::string_view peek();
  /// Throws InputError that names the number, also if it is not between these.
  double next(const char* name, double low = -std::numeric_limits<double>::infinity(),
    double high = std::numeric_limits<double>::infinity());
  double nextPositive(const char* name);
  std::size_t nextCount(const char* name, std::size_t low = 1, std::size_t high = kMostValues);
  /// Angles in order; `mayRepeat`: not decreasing, else increasing.
  std::vector<double> nextAngles(
    const char* name, std::size_t count, double low, double high, bool mayRepeat);
  /// All values of a table, 0 or more. Nothing but words may follow them.
  std::vector<double> lastValues(const char* name, std::size_t polar, std::size_t azimuth);
  /// Throws InputError that names the line.
  template <class... Parts>
  void failIf(bool isWrong, const Parts&... parts) const
  {
    text_.failIf(isWrong, line_, parts...);
  }

private:
  const PhotometricText& text_;
  std::size_t line_, column_ = 0;
  const char* separators_;
};

/// What a lamp file says, of either kind.
struct PhotometricFile
{
  std::string luminaire, manufacturer;
  std::string unit = "cd"; ///< of the file; radiant ones end with W/sr
  IntensityTable table;    ///< full, cd or W/sr
  LuminousOpening opening;
  std::vector<std::string> warnings;

  bool isRadiometric() const { return unit != "cd"; }
};

/// Returns what is in the file of this name beside the lamp file. Throws InputError.
using ReadBeside = std::function<std::string(const std::string&)>;

/// Each throws InputError, naming file, line and value. `lampSet`: whose lumens count.
PhotometricFile parseIes(const PhotometricText& text, const ReadBeside& readBeside);
PhotometricFile parseEulumdat(const PhotometricText& text, int lampSet);
/// By what is in the text: a line that begins with TILT= makes it IES.
PhotometricFile parsePhotometricFile(
  const PhotometricText& text, int lampSet, const ReadBeside& readBeside);

PhotometricFile readPhotometricFile(const std::string& fileName, int lampSet);
/// Whether it looks like a lamp file, well or not.
bool isPhotometricFile(const std::string& fileName);

}
