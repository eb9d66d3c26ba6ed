// SPDX-License-Identifier: BSD-3-Clause
#include "Luminaires/PhotometricFile.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <utility>

namespace irradiance
{

namespace
{

constexpr const char* kIesSeparators = " \t,";

/// The version of the standard: 1986, 1991, 1995, 2002 or 2019. Other years count as the last
/// version before them.
int yearOf(std::string_view firstLine)
{
  const std::string line = upperCase(firstLine);
  for (const std::string begin : { "IESNA:LM-63-", "IES:LM-63-", "IESNA" })
  {
    int year = 0;
    if (line.rfind(begin, 0) == 0 &&
      std::from_chars(line.data() + begin.size(), line.data() + line.size(), year).ec ==
        std::errc())
    {
      year += year < 80 ? 2000 : year < 100 ? 1900 : 0;
      return year < 1991 ? 1986
        : year < 1995    ? 1991
        : year < 2002    ? 1995
        : year < 2019    ? 2002
                         : 2019;
    }
  }
  return 1986;
}

/// The labels of the form [KEYWORD] value; [MORE] goes on with the value before.
std::map<std::string, std::string> keywordsOf(const PhotometricText& text, std::size_t end)
{
  std::map<std::string, std::string> values;
  std::string keyword;
  for (std::size_t i = 0; i < end; ++i)
  {
    const std::string_view line = text.line(i);
    const std::size_t bracket = line.find(']');
    if (line.empty() || line.front() != '[' || bracket == std::string_view::npos)
    {
      continue;
    }
    const std::string key = upperCase(line.substr(1, bracket - 1));
    keyword = key == "MORE" ? keyword : key;
    const std::string_view value = line.substr(bracket + 1);
    const std::size_t first = value.find_first_not_of(" \t");
    std::string& all = values[keyword];
    all += first == std::string_view::npos
      ? std::string()
      : (all.empty() ? "" : " ") + std::string(value.substr(first));
  }
  return values;
}

/// "cd" unless the keywords say mW/sr, W/sr or uW/sr, as germicidal lamps do: no number says so.
std::string unitOf(const std::map<std::string, std::string>& keywords)
{
  for (const char* const keyword : { "_INTENSITYUNITS", "TEST" })
  {
    const auto found = keywords.find(keyword);
    const std::string value = found == keywords.end() ? "" : upperCase(found->second);
    const std::size_t unit = value.find("W/SR");
    if (unit != std::string::npos)
    {
      const char before = unit > 0 ? value[unit - 1] : ' ';
      // The last byte of the micro sign, or of the Greek letter.
      const bool isMicro = before == 'U' || before == '\xB5' || before == '\xBC';
      return before == 'M' ? "mW/sr" : isMicro ? "uW/sr" : "W/sr";
    }
  }
  return "cd";
}

/// The factor of a luminaire that is not tilted, from the table of factors over its tilt.
double factorUntilted(NumberReader& numbers)
{
  numbers.nextCount("lamp-to-luminaire geometry", 1, 3);
  const std::size_t count = numbers.nextCount("number of tilt angles");
  const std::vector<double> angles = numbers.nextAngles("tilt angle", count, -180, 180, false);
  std::vector<double> factors;
  while (factors.size() < count)
  {
    factors.push_back(numbers.next("tilt factor", 0));
  }
  const auto above = std::lower_bound(angles.begin(), angles.end(), 0.0);
  const auto i = static_cast<std::size_t>(above - angles.begin());
  if (i == 0 || i == count)
  {
    return factors[i == 0 ? 0 : count - 1];
  }
  return factors[i - 1] -
    (factors[i] - factors[i - 1]) * angles[i - 1] / (angles[i] - angles[i - 1]);
}

double tiltFactor(
  const PhotometricText& text, int year, NumberReader& numbers, const ReadBeside& readBeside)
{
  const std::size_t line = text.tiltLine();
  const std::string name(text.line(line).substr(5));
  if (upperCase(name) == "NONE")
  {
    return 1;
  }
  if (upperCase(name) == "INCLUDE")
  {
    return factorUntilted(numbers);
  }
  text.failIf(year >= 2019 || name.empty(), line, "TILT is \"", name, "\"; NONE",
    year >= 2019 ? " and INCLUDE are possible in LM-63-2019"
                 : ", INCLUDE and the name of a file are possible");
  std::string bytes;
  try
  {
    bytes = readBeside(name);
  }
  catch (const InputError& error)
  {
    text.failIf(true, line, "TILT: ", error.what());
  }
  const PhotometricText tilt(text.fileName() + ", TILT=" + name, bytes);
  NumberReader tiltNumbers(tilt, 0, kIesSeparators);
  return factorUntilted(tiltNumbers);
}

/// What the symmetry leaves out is put back, so that the planes go all around.
StoredAngles aroundTypeC(const NumberReader& numbers, const std::vector<double>& angles)
{
  StoredAngles around(angles);
  const double first = angles.front(), last = angles.back(), gap = 360 - last;
  constexpr double kSame = 1e-3; // degrees
  if (angles.size() == 1)
  {
    return around;
  }
  if ((first == 0 && (last == 90 || last == 180)) || (first == 90 && last == 270))
  {
    around.mirrorAtLast();
    if (last == 90)
    {
      around.mirrorAtLast();
    }
  }
  else
  {
    const bool isClosing = gap == 0 || std::abs(gap - angles[1]) < kSame ||
      std::abs(gap - (last - *(angles.end() - 2))) < kSame;
    numbers.failIf(!(first == 0 && last > 180 && isClosing), "the horizontal angles go from ",
      first, " to ", last,
      "; possible are 0 to 90, 180, 360 or one step less, 90 to 270, and one angle alone");
    around.closeIfOpen();
  }
  return around;
}

/// Types A and B: a table that begins at 0 is mirrored there.
StoredAngles acrossZero(const std::vector<double>& angles)
{
  StoredAngles across(angles);
  if (angles.front() == 0)
  {
    across = reversed(across);
    across.mirrorAtLast();
    across = reversed(across);
  }
  return across;
}

StoredAngles polarAngles(StoredAngles angles)
{
  for (double& angle : angles.degrees)
  {
    angle += 90;
  }
  return angles;
}

/// Types A and B are tables in other frames: their angles only get other names. Their horizontal
/// angles go clockwise as seen from above (LM-63-2002).
IntensityTable readTable(
  NumberReader& numbers, int year, std::size_t type, std::size_t rows, std::size_t planes)
{
  using Range = std::pair<double, double>;
  const Range half{ -90, 90 }, turn{ -180, 180 };
  // In 1986 types A and C had one number.
  const bool isOldA = type == 1 && year == 1986 && NumberReader(numbers).next("vertical angle") < 0;
  const bool isB = type == 2, isC = type == 1 && !isOldA;
  const Range v = isB ? turn : isC ? Range{ 0, 180 } : half;
  const std::vector<double> vertical =
    numbers.nextAngles("vertical angle", rows, v.first, v.second, !isB);
  const Range h = isB ? half : isC ? Range{ 0, 360 } : turn;
  const std::vector<double> horizontal =
    numbers.nextAngles("horizontal angle", planes, h.first, h.second, isB);
  numbers.failIf(rows < 2 || (planes < 2 && !isC), "there are ", rows, " vertical and ", planes,
    " horizontal angles; ", isC ? "two and one" : "two and two", " at least are needed");
  const StoredAngles around = isC ? aroundTypeC(numbers, horizontal) : acrossZero(horizontal);
  const std::vector<double> values = numbers.lastValues("candela value", rows, planes);
  if (isC)
  {
    return expandedTable(StoredAngles(vertical), around, values, 1, rows);
  }
  if (!isB)
  {
    return expandedTable(polarAngles(acrossZero(vertical)), reversed(around), values, 1, rows);
  }
  IntensityTable table = expandedTable(polarAngles(around), acrossZero(vertical), values, rows, 1);
  table.axis = { 0, 1, 0 };
  table.reference = { 0, 0, -1 };
  return table;
}

LuminousOpening readOpening(NumberReader& numbers, int year)
{
  const double metre = numbers.nextCount("type of units", 1, 2) == 1 ? 0.3048 : 1;
  const double width = numbers.next("width") * metre, length = numbers.next("length") * metre,
               height = numbers.next("height") * metre;
  const std::optional<LuminousOpening> opening = iesOpening(year, width, length, height);
  numbers.failIf(!opening, "no luminous opening has the signs of width ", width, ", length ",
    length, " and height ", height, " m");
  return *opening;
}

}

PhotometricFile parseIes(const PhotometricText& text, const ReadBeside& readBeside)
{
  PhotometricFile file;
  const std::size_t tiltLine = text.tiltLine();
  std::map<std::string, std::string> keywords = keywordsOf(text, tiltLine);
  file.luminaire = keywords["LUMINAIRE"];
  file.manufacturer = keywords["MANUFAC"];
  file.unit = unitOf(keywords);
  const int year = yearOf(text.line(0));
  NumberReader numbers(text, tiltLine + 1, kIesSeparators);
  double factor = tiltFactor(text, year, numbers, readBeside);
  numbers.next("number of lamps"); // the table is for their lumens
  numbers.next("lumens of a lamp");
  factor *= numbers.nextPositive("candela multiplier");
  const std::size_t rows = numbers.nextCount("number of vertical angles");
  const std::size_t planes = numbers.nextCount("number of horizontal angles");
  const std::size_t type = numbers.nextCount("photometric type", 1, 3);
  file.opening = readOpening(numbers, year);
  factor *= numbers.nextPositive("ballast factor");
  // Later it is for future use, and then says how the file was made: no factor.
  factor *= year < 1995 ? numbers.nextPositive("ballast-lamp photometric factor")
                        : (numbers.next("number before the watts"), 1);
  numbers.next("input watts");
  file.table = readTable(numbers, year, type, rows, planes);
  factor *= file.unit == "mW/sr" ? 1e-3 : file.unit == "uW/sr" ? 1e-6 : 1;
  file.table.scale(factor);
  if (upperCase(numbers.peek()) == "[ENDBLOCK]")
  {
    file.warnings.push_back(text.fileName() + " has several luminaires; the first one is read");
  }
  return file;
}

}
