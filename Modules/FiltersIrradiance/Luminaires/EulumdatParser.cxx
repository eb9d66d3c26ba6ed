// SPDX-License-Identifier: BSD-3-Clause
#include "Luminaires/PhotometricFile.h"

#include <algorithm>
#include <cmath>

namespace irradiance
{

namespace
{

/// Lines of the head have their numbers of the format, from 1.
NumberReader numberAt(const PhotometricText& text, std::size_t line)
{
  text.failIf(text.line(line - 1).empty(), line - 1,
    "a number has to be here in EULUMDAT; in IES a line begins with TILT=");
  return { text, line - 1, " \t" };
}

/// An empty line is 0.
double lengthAt(const PhotometricText& text, std::size_t line, const char* name)
{
  return text.line(line - 1).empty() ? 0 : numberAt(text, line).next(name, 0);
}

/// The length lies along y, as C90 does.
LuminousOpening eulumdatOpening(const PhotometricText& text)
{
  constexpr double kMillimetre = 0.001;
  const double length = lengthAt(text, 16, "length or diameter of the luminous area") * kMillimetre;
  const double width = lengthAt(text, 17, "width of the luminous area") * kMillimetre;
  double height = 0;
  for (const std::size_t line : { 18, 19, 20, 21 })
  {
    height = std::max(height, lengthAt(text, line, "height of the luminous area") * kMillimetre);
  }
  using Shape = LuminousOpening::Shape;
  const bool isRound = width == 0 && length > 0;
  const Shape shape = isRound               ? Shape::Cylinder
    : length > 0 || width > 0 || height > 0 ? Shape::Box
                                            : Shape::Point;
  return { shape, 2, { isRound ? length : width, length, height } };
}

/// The planes that the file holds of those that it lists, by its symmetry, and all around.
StoredAngles storedPlanes(
  const NumberReader& numbers, std::size_t symmetry, const std::vector<double>& listed)
{
  if (symmetry == 1 || listed.size() == 1)
  {
    return StoredAngles({ 0 });
  }
  if (symmetry == 0)
  {
    StoredAngles around(listed);
    around.closeIfOpen();
    return around;
  }
  const double first = symmetry == 3 ? -90 : 0, last = symmetry == 2 ? 180 : 90;
  std::vector<double> angles;
  for (const double turn : { -360., 0. }) // C270 comes before C0
  {
    for (const double angle : listed)
    {
      if (angle + turn >= first && angle + turn <= last)
      {
        angles.push_back(angle + turn);
      }
    }
  }
  const std::size_t stored = listed.size() / (symmetry == 4 ? 4 : 2) + 1;
  numbers.failIf(angles.size() != stored || angles.front() != first || angles.back() != last,
    "of the ", listed.size(), " C angles ", angles.size(), " are from ", first, " to ", last,
    "; with the symmetry ", symmetry, " they are to be ", stored, ", with both of these");
  StoredAngles around(angles);
  around.mirrorAtLast();
  if (symmetry == 4)
  {
    around.mirrorAtLast();
  }
  return around;
}

void warnOfOutputRatio(PhotometricFile& file, const PhotometricText& text, double stated)
{
  const double perCent = file.table.flux() / 10; // of cd/klm
  const bool differs = stated > 0 && std::abs(perCent - stated) > 5;
  if (differs || perCent > 105)
  {
    file.warnings.push_back(joined(text.fileName(), ": the table holds ", perCent,
      " % of the lamps' lumens, and the light output ratio is ", stated, " %; the table counts",
      perCent > 105 ? " (are its values candela in place of cd/klm?)" : ""));
  }
}

}

PhotometricFile parseEulumdat(const PhotometricText& text, int lampSet)
{
  PhotometricFile file;
  file.manufacturer = text.line(0);
  file.luminaire = text.line(8);
  const std::size_t symmetry = numberAt(text, 3).nextCount("EULUMDAT symmetry", 0, 4);
  const std::size_t planes = numberAt(text, 4).nextCount("number of C planes");
  const std::size_t rows = numberAt(text, 6).nextCount("number of gamma angles");
  file.opening = eulumdatOpening(text);
  const double ratio = lengthAt(text, 23, "light output ratio");
  const double conversion = numberAt(text, 24).nextPositive("conversion factor");
  const std::size_t sets = numberAt(text, 26).nextCount("number of lamp sets");
  const auto lampSetNumber = static_cast<std::size_t>(lampSet);
  throwIf(lampSetNumber >= sets, "LampSet is ", lampSet, ", and ", text.fileName(), " has ", sets,
    " sets of lamps, counted from 0");
  const std::size_t linesPerSet = 6, firstSet = 27, ratios = 10;
  const double lumens =
    numberAt(text, firstSet + lampSetNumber * linesPerSet + 2).nextPositive("lumens of the lamps");

  NumberReader numbers(text, firstSet - 1 + sets * linesPerSet + ratios, " \t");
  const StoredAngles around =
    storedPlanes(numbers, symmetry, numbers.nextAngles("C angle", planes, 0, 360, false));
  const std::vector<double> gamma = numbers.nextAngles("gamma angle", rows, 0, 180, true);
  numbers.failIf(rows < 2, "there is one gamma angle; two at least are needed");
  const std::size_t stored = 1 + *std::max_element(around.stored.begin(), around.stored.end());
  file.table = expandedTable(
    StoredAngles(gamma), around, numbers.lastValues("intensity", rows, stored), 1, rows);
  file.table.scale(conversion);
  warnOfOutputRatio(file, text, ratio);
  file.table.scale(lumens / 1000);
  return file;
}

}
