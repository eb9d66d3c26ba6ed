// SPDX-License-Identifier: BSD-3-Clause
#include "Luminaires/PhotometricText.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

namespace irradiance
{

namespace
{

bool isUtf8(const std::string& text)
{
  int following = 0;
  for (const char c : text)
  {
    const auto byte = static_cast<unsigned char>(c);
    const bool follows = (byte & 0xC0) == 0x80;
    if (follows != following > 0 || byte >= 0xF8)
    {
      return false;
    }
    following = follows ? following - 1 : byte < 0x80 ? 0 : byte < 0xE0 ? 1 : byte < 0xF0 ? 2 : 3;
  }
  return following == 0;
}

std::string utf8OfLatin1(const std::string& text)
{
  std::string utf8;
  for (const char c : text)
  {
    const auto byte = static_cast<unsigned char>(c);
    utf8 += byte < 0x80 ? "" : byte < 0xC0 ? "\xC2" : "\xC3";
    utf8 += byte < 0x80 ? c : static_cast<char>(0x80 | (byte & 0x3F));
  }
  return utf8;
}

}

std::string upperCase(std::string_view text)
{
  std::string upper(text);
  std::transform(upper.begin(), upper.end(), upper.begin(),
    [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  return upper;
}

PhotometricText::PhotometricText(const std::string& fileName, const std::string& bytes)
  : fileName_(fileName)
{
  const std::string mark = bytes.substr(0, 2);
  throwIf(mark == "\xFF\xFE" || mark == "\xFE\xFF" || mark.find('\0') != std::string::npos,
    fileName, " is UTF-16 or no text at all; lamp files are ASCII, ISO 8859-1 or UTF-8");
  text_ = bytes.substr(bytes.rfind("\xEF\xBB\xBF", 0) == 0 ? 3 : 0);
  text_.resize(std::min(text_.size(), text_.find('\x1A'))); // how DOS marks the end
  text_ = isUtf8(text_) ? text_ : utf8OfLatin1(text_);
  const std::string_view all = text_;
  for (std::size_t begin = 0; begin < all.size();)
  {
    const std::size_t end = std::min(all.find_first_of("\r\n", begin), all.size());
    lines_.push_back(all.substr(begin, end - begin));
    begin = end + (all.substr(end, 2) == "\r\n" ? 2 : 1);
  }
}

std::string_view PhotometricText::line(std::size_t i) const
{
  const std::string_view line = i < lines_.size() ? lines_[i] : std::string_view();
  const std::size_t first = line.find_first_not_of(" \t");
  return first == std::string_view::npos
    ? std::string_view()
    : line.substr(first, line.find_last_not_of(" \t") - first + 1);
}

std::size_t PhotometricText::tiltLine() const
{
  std::size_t i = 0;
  while (i < size() && upperCase(line(i).substr(0, 5)) != "TILT=")
  {
    ++i;
  }
  return i;
}

double PhotometricText::number(std::size_t line, const char* name, std::string_view word) const
{
  std::string point(word.substr(!word.empty() && word.front() == '+' ? 1 : 0));
  std::replace(point.begin(), point.end(), ',', '.');
  double number = 0;
  const char* const end = point.data() + point.size();
  const auto read = std::from_chars(point.data(), end, number);
  failIf(read.ec != std::errc() || read.ptr != end || !std::isfinite(number), line, "the ", name,
    " is ", '"', word.substr(0, 40), '"', ", which is no finite number");
  return number;
}

std::string_view NumberReader::peek()
{
  for (; line_ < text_.size(); ++line_, column_ = 0)
  {
    const std::string_view line = text_.line(line_);
    column_ = std::min(line.find_first_not_of(separators_, column_), line.size());
    if (column_ < line.size())
    {
      return line.substr(column_, line.find_first_of(separators_, column_) - column_);
    }
  }
  return {};
}

double NumberReader::next(const char* name, double low, double high)
{
  const std::string_view word = peek();
  text_.failIf(word.empty(), text_.size() - 1, "the file ends before the ", name);
  const double number = text_.number(line_, name, word);
  failIf(!(number >= low && number <= high), "the ", name, " is ", number, "; ", low, " to ", high,
    " are possible");
  column_ += word.size();
  return number;
}

double NumberReader::nextPositive(const char* name)
{
  const double number = next(name);
  failIf(!(number > 0), "the ", name, " is ", number, "; it has to be above 0");
  return number;
}

std::size_t NumberReader::nextCount(const char* name, std::size_t low, std::size_t high)
{
  const double number = next(name, static_cast<double>(low), static_cast<double>(high));
  failIf(number != std::floor(number), "the ", name, " is ", number, ", which is no whole number");
  return static_cast<std::size_t>(number);
}

std::vector<double> NumberReader::nextAngles(
  const char* name, std::size_t count, double low, double high, bool mayRepeat)
{
  std::vector<double> angles;
  while (angles.size() < count)
  {
    const double angle = next(name, low, high);
    const double last = angles.empty() ? low - 1 : angles.back();
    failIf(mayRepeat ? angle < last : angle <= last, "the ", name, " ", angle, " follows ", last,
      "; angles have to increase");
    angles.push_back(angle);
  }
  return angles;
}

std::vector<double> NumberReader::lastValues(
  const char* name, std::size_t polar, std::size_t azimuth)
{
  const std::string counts = joined(polar, " x ", azimuth);
  failIf(polar > kMostValues / azimuth, "the table has ", counts, " values; ", kMostValues,
    " are possible");
  std::vector<double> values;
  while (values.size() < polar * azimuth)
  {
    const double value = next(name);
    failIf(value < 0, "the ", name, " is ", value, ", which is negative");
    values.push_back(value);
  }
  const std::string_view word = peek();
  failIf(!word.empty() && word.find_first_not_of("+-.0123456789eE,") == std::string_view::npos, '"',
    word.substr(0, 40), "\" follows the table of ", counts,
    " values; the numbers of angles do not fit it");
  return values;
}

}
