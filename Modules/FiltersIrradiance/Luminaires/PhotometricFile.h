// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PhotometricFile_h
#define irradiance_PhotometricFile_h

#include "Luminaires/LuminousOpening.h"
#include "Luminaires/PhotometricText.h"

#include <functional>
#include <string>
#include <vector>

namespace irradiance
{

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

#endif
