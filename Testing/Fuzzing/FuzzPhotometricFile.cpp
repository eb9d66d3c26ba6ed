// SPDX-License-Identifier: BSD-3-Clause
// Whatever the bytes of a lamp file are, they are an InputError or a table and an opening in order.

#include "Luminaires/PhotometricFile.h"
#include "Progress/InputError.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace irradiance::fuzzing
{

namespace
{

void require(bool isRight, const char* what)
{
  if (!isRight)
  {
    std::fprintf(stderr, "%s\n", what);
    std::abort();
  }
}

void check(const PhotometricFile& file)
{
  const std::vector<double>&polar = file.table.polar, &azimuth = file.table.azimuth;
  require(polar.size() >= 2 && std::is_sorted(polar.begin(), polar.end()), "polar angles");
  require(polar.front() >= 0 && polar.back() <= 180, "polar angles leave the sphere");
  require(!azimuth.empty() && std::is_sorted(azimuth.begin(), azimuth.end()), "azimuths");
  require(azimuth.back() - azimuth.front() <= 360, "azimuths go round more than once");
  require(file.table.values.size() == polar.size() * azimuth.size(), "number of values");
  for (const double value : file.table.values)
  {
    require(value >= 0 && std::isfinite(value), "a value");
  }
  require(file.table.flux() > 0, "flux");
  require(!file.opening.name().empty(), "name");
  const std::vector<Facet> facets = litFacets(file.opening, file.table);
  require(facets.empty() == (file.opening.shape == LuminousOpening::Shape::Point), "facets");
  for (const Facet& facet : facets)
  {
    require(facet.size() >= 3, "corners");
    for (const Vector3& corner : facet)
    {
      require(corner.allFinite(), "a corner");
    }
  }
}

void run(const std::string& bytes)
{
  try
  {
    const PhotometricText text("lamp", bytes);
    const auto same = [&](const std::string&) { return bytes; };
    check(parsePhotometricFile(text, bytes.size() % 2 ? 1 : 0, same));
  }
  catch (const InputError&)
  {
  }
}

}

}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  irradiance::fuzzing::run({ reinterpret_cast<const char*>(data), size });
  return 0;
}
