// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Data/ArrayNames.h"
#include "Data/NamedArray.h"
#include "Sampling/DirectionTable.h"
#include "Surfaces/Sky.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace irradiance
{

/// Of the polydata of the input that messages call `where`.
struct SkyFields
{
  const std::string& where;
  vtkFieldData* arrays;

  bool has(const char* name) const { return arrays->GetArray(name) != nullptr; }
  std::vector<double> column(const char* name) const
  {
    return columnOf(where, arrays, name, missing(name));
  }

  /// The one tuple of an array, of this many finite numbers. Amounts are 0 or more, and a single one
  /// is repeated.
  std::vector<double> tuple(const char* name, std::size_t size, bool areAmounts = false) const
  {
    constexpr double kMost = 1e30;
    const double least = areAmounts ? 0 : -kMost;
    vtkDataArray* const array = arrays->GetArray(name);
    throwIf(!array, where, missing(name));
    const auto components = static_cast<std::size_t>(array->GetNumberOfComponents());
    const std::string what = where + ": the field-data array " + name;
    throwIf(
      array->GetNumberOfTuples() != 1 || !(components == size || (areAmounts && components == 1)),
      what, " is not one tuple of ", size, " components");
    std::vector<double> values;
    for (std::size_t i = 0; i < size; ++i)
    {
      values.push_back(array->GetComponent(0, components == 1 ? 0 : static_cast<int>(i)));
      throwIf(!(values.back() >= least && values.back() <= kMost), what, " has the value ",
        values.back(), ", which is not within ", least, "..", kMost);
    }
    return values;
  }

  static std::string missing(const char* name)
  {
    return std::string(": has a sky, but not the field-data array ") + name;
  }

  static bool isDark(const std::vector<double>& values)
  {
    return std::all_of(values.begin(), values.end(), [](double value) { return value == 0; });
  }

  Box withMargin(Box box) const
  {
    constexpr double kMargin = 0.1; // of the diagonal
    throwIf(box.isEmpty() || !(box.extent().norm() > 0), where,
      ": has a sky, but nothing static tells where its light is wanted; set ", kSkyBounds,
      " (Bounds of vtkSunSkySource)");
    box.inflate(kMargin * box.extent().norm());
    return box;
  }
};

/// Whether the field data of a polydata have a sky or a sun, as vtkSunSkySource describes them.
inline bool hasSky(vtkPolyData* input)
{
  vtkFieldData* const fields = input->GetFieldData();
  return fields->GetArray(kSkyRadiance) || fields->GetArray(kSunIrradiance);
}

/// How many bands its light has.
inline int bandsOfSky(vtkPolyData* input)
{
  for (const char* const name : { kSunIrradiance, kSkyWeights })
  {
    vtkDataArray* const array = input->GetFieldData()->GetArray(name);
    if (array && array->GetNumberOfComponents() == 3)
    {
      return 3;
    }
  }
  return 1;
}

/// The sky and the sun; null if both are dark. Without bounds of its own it lights those of what is
/// static, with a margin. Throws InputError, naming `where`, the array and the value.
inline std::shared_ptr<const Sky> readSky(
  const std::string& where, vtkPolyData* input, int bands, const Box& ofStatics)
{
  const SkyFields fields{ where, input->GetFieldData() };
  const auto count = static_cast<std::size_t>(bands);
  Sky sky;
  if (fields.has(kSkyRadiance))
  {
    sky.radiance = fields.column(kSkyRadiance);
    sky.polarAngles = fields.column(kSkyPolarAngles);
    sky.azimuths = fields.column(kSkyAzimuths);
    try
    {
      const DirectionTable check(sky.polarAngles, sky.azimuths, sky.radiance);
    }
    catch (const InputError& error)
    {
      throw InputError(where + ": of the table " + kSkyRadiance + ", " + error.what());
    }
    sky.bandWeights = fields.has(kSkyWeights) ? fields.tuple(kSkyWeights, count, true)
                                              : std::vector<double>(count, 1);
    if (SkyFields::isDark(sky.radiance) || SkyFields::isDark(sky.bandWeights))
    {
      sky.radiance.clear();
    }
  }
  if (fields.has(kSunIrradiance))
  {
    sky.sunIrradiance = fields.tuple(kSunIrradiance, count, true);
    if (SkyFields::isDark(sky.sunIrradiance))
    {
      sky.sunIrradiance.clear();
    }
    else
    {
      const std::vector<double> towards = fields.tuple(kSunDirection, 3);
      sky.towardsSun = Vector3(towards[0], towards[1], towards[2]).normalized();
      throwIf(!(sky.towardsSun.norm() > 0.5), where, ": the field-data array ", kSunDirection,
        " is 0 0 0, no direction");
      constexpr double kWidest = 45; // degrees
      const double degrees =
        fields.has(kSunAngularRadius) ? fields.tuple(kSunAngularRadius, 1, true).front() : 0;
      throwIf(!(degrees <= kWidest), where, ": the field-data array ", kSunAngularRadius, " is ",
        degrees, " degrees; at most ", kWidest, " are possible");
      sky.sunRadius = degrees * kPi / 180;
    }
  }
  if (sky.radiance.empty() && sky.sunIrradiance.empty())
  {
    return nullptr;
  }
  if (fields.has(kSkyBounds))
  {
    const std::vector<double> bounds = fields.tuple(kSkyBounds, 6);
    sky.lit = { { bounds[0], bounds[2], bounds[4] }, { bounds[1], bounds[3], bounds[5] } };
    throwIf(!(sky.lit.extent().minCoeff() > 0), where, ": the field-data array ", kSkyBounds,
      " is not xmin xmax ymin ymax zmin zmax of a box");
  }
  else
  {
    sky.lit = fields.withMargin(ofStatics);
  }
  return std::make_shared<const Sky>(std::move(sky));
}

}
