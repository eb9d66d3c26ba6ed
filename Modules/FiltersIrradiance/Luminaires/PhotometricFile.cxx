// SPDX-License-Identifier: BSD-3-Clause
#include "Luminaires/PhotometricFile.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

namespace irradiance
{

namespace
{

std::string bytesOf(const std::string& fileName)
{
  std::ifstream stream(fileName, std::ios::binary);
  std::string bytes;
  if (stream && !std::filesystem::is_directory(fileName))
  {
    bytes.assign(std::istreambuf_iterator<char>(stream), {});
  }
  throwIf(!stream || bytes.empty(), "the file " + fileName + " is empty or cannot be read");
  return bytes;
}

}

PhotometricFile parsePhotometricFile(
  const PhotometricText& text, int lampSet, const ReadBeside& readBeside)
{
  PhotometricFile file =
    text.tiltLine() < text.size() ? parseIes(text, readBeside) : parseEulumdat(text, lampSet);
  const double flux = file.table.flux();
  throwIf(!(flux > 0 && flux <= std::numeric_limits<double>::max()), text.fileName(),
    ": the flux of the table is ", flux, "; it has to be above 0 and finite");
  return file;
}

PhotometricFile readPhotometricFile(const std::string& fileName, int lampSet)
{
  const auto readBeside = [&](const std::string& name) {
    const std::string leaf = name.substr(name.find_last_of("/\\") + 1); // + 1 of npos is 0
    return bytesOf((std::filesystem::path(fileName).parent_path() / leaf).string());
  };
  return parsePhotometricFile({ fileName, bytesOf(fileName) }, lampSet, readBeside);
}

bool isPhotometricFile(const std::string& fileName)
{
  try
  {
    const PhotometricText text(fileName, bytesOf(fileName));
    if (text.tiltLine() == text.size())
    {
      for (const std::size_t i : { 1, 2, 3, 5 }) // kind, symmetry, numbers of angles
      {
        text.number(i, "", text.line(i));
      }
    }
    return true;
  }
  catch (const InputError&)
  {
    return false;
  }
}

}
