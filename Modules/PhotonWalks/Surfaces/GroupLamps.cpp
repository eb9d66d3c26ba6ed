// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/GroupLamps.h"

#include <algorithm>
#include <cmath>

namespace irradiance
{

namespace
{

/// Lamps that are scaled alike are to be the same but for rounding: so less digits are kept.
double scaledDown(double value, double scale)
{
  constexpr int kDigits = 40;
  int exponent = 0;
  const double digits = scale > 0 ? std::frexp(value / scale, &exponent) : 0;
  return std::ldexp(std::round(std::ldexp(digits, kDigits)), exponent - kDigits);
}

void scaleDown(std::vector<double>& values, const Bands& scale, int bands)
{
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = scaledDown(values[i], scale[i % static_cast<std::size_t>(bands)]);
  }
}

/// Null if the group has no lamps there.
std::shared_ptr<const Emission> partOf(
  const std::shared_ptr<const Emission>& emission, std::uint32_t group, const Bands& scale)
{
  const bool isScaled = std::any_of(scale.begin(), scale.end(), [](double of) { return of != 1; });
  if (!emission ||
    (emission->groups.empty() && emission->group == group && group == 0 && !isScaled))
  {
    return emission; // the usual one takes no memory
  }
  const Emission& whole = *emission;
  Emission part = whole;
  part.groups.clear();
  part.group = 0;
  const auto isOther = [&](std::size_t cell) { return whole.groupOf(cell) != group; };
  const auto bands = static_cast<std::size_t>(whole.bands);
  bool hasAny = false;
  for (std::size_t i = 0; i < part.exitance.size(); ++i)
  {
    part.exitance[i] = isOther(i / bands) ? 0 : part.exitance[i];
    hasAny = hasAny || part.exitance[i] > 0;
  }
  part.points.erase(std::remove_if(part.points.begin(), part.points.end(),
                      [&](const PointSource& source) { return isOther(source.cell); }),
    part.points.end());
  if (!hasAny && part.points.empty())
  {
    return nullptr;
  }
  if (isScaled)
  {
    scaleDown(part.exitance, scale, whole.bands);
    for (PointSource& source : part.points)
    {
      scaleDown(source.flux, scale, whole.bands);
    }
    for (Luminaire& lamp : part.luminaires)
    {
      scaleDown(lamp.flux, scale, whole.bands);
    }
  }
  return std::make_shared<const Emission>(std::move(part));
}

std::vector<Bands> brightestOf(const Emission& emission)
{
  std::vector<Bands> brightest;
  const auto add = [&](std::size_t cell, const double* values) {
    const std::uint32_t group = emission.groupOf(cell);
    const bool isLight =
      std::any_of(values, values + emission.bands, [](double value) { return value > 0; });
    brightest.resize(std::max<std::size_t>(brightest.size(), isLight ? group + 1 : 0));
    for (int band = 0; isLight && band < emission.bands; ++band)
    {
      double& most = brightest[group][static_cast<std::size_t>(band)];
      most = std::max(most, values[band]);
    }
  };
  const std::size_t cells = emission.exitance.size() / static_cast<std::size_t>(emission.bands);
  for (std::size_t cell = 0; cell < cells; ++cell)
  {
    add(cell, emission.exitanceOf(cell));
  }
  for (const PointSource& source : emission.points)
  {
    add(source.cell, source.flux.data());
  }
  return brightest;
}

std::shared_ptr<const std::vector<bool>> lampCellsOf(const Emission& emission)
{
  if (emission.exitance.empty())
  {
    return nullptr;
  }
  std::vector<bool> cells(emission.exitance.size() / static_cast<std::size_t>(emission.bands));
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
  {
    cells[cell] = emission.hasExitance(cell);
  }
  return std::make_shared<const std::vector<bool>>(std::move(cells));
}

}

void SceneLamps::update(const SceneObjects& objects)
{
  objects_.resize(objects.size());
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    OfObject& known = objects_[i];
    known.isPresent = objects[i].isPresent;
    if (known.emission == objects[i].emission)
    {
      continue;
    }
    known.emission = objects[i].emission;
    known.brightest = known.emission ? brightestOf(*known.emission) : std::vector<Bands>();
    const auto cells = known.emission ? irradiance::lampCellsOf(*known.emission) : nullptr;
    if (!cells || !known.lampCells || *cells != *known.lampCells)
    {
      known.lampCells = cells;
    }
  }
}

SceneObjects GroupLamps::only(const SceneObjects& objects, const SceneLamps* scene,
  std::uint32_t group, const Bands& scale, bool hasSky)
{
  SceneObjects all = objects;
  parts_.resize(objects.size());
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    Part& known = parts_[i];
    SceneObject& object = i == 0 ? all.staticObject : all.dynamicObjects[i - 1];
    if (known.whole != object.emission || known.scale != scale)
    {
      const auto part = partOf(object.emission, group, scale);
      if (!part || !known.part || !(*part == *known.part))
      {
        known.part = part;
      }
      known.whole = object.emission;
      known.scale = scale;
    }
    object.emission = known.part;
    object.lampCells = scene ? scene->lampCellsOf(i) : nullptr;
  }
  all.sky = hasSky ? all.sky : nullptr;
  return all;
}

}
