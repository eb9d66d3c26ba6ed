// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RandomChoices.h"

#include "vtkSunSkySource.h"

#include <algorithm>
#include <cmath>

/// Lights, as random as they may be: how strong they are, lamps with a table of intensity, and skies.
namespace RandomModels
{

using Tuple = std::vector<double>;

inline Tuple RandomTuple(RandomNumbers& random, double high)
{
  Tuple tuple{ random.Between(0, high) };
  if (Chance(random, 4))
  {
    tuple.insert(tuple.end(), { random.Between(0, high), Chance(random, 2) ? 0 : high });
  }
  return tuple;
}

/// From 1 down to where all but rounding is lost beside other lights.
inline double RandomWeakness(RandomNumbers& random)
{
  return Chance(random, 3) ? std::pow(10, -random.Below(40)) : 1;
}

inline Tuple Scaled(Tuple tuple, double factor)
{
  std::for_each(tuple.begin(), tuple.end(), [&](double& value) { value *= factor; });
  return tuple;
}

// Lamps with a table.

inline bool HasTable(vtkPolyData* mesh)
{
  return mesh->GetFieldData()->HasArray("RadiantIntensity");
}

/// Of some watts, or of as many as its table has.
inline void SetRandomFlux(RandomNumbers& random, vtkPolyData* lamp)
{
  Chance(random, 4)
    ? lamp->GetFieldData()->RemoveArray("Flux")
    : SetFieldTuple(lamp, "Flux", Scaled(RandomTuple(random, 40), RandomWeakness(random)));
}

/// Round or lopsided, with jumps or gaps or none. A flat lamp has light on its front alone.
inline void SetRandomTable(RandomNumbers& random, vtkPolyData* lamp, bool isFlat)
{
  std::vector<Tuple> polars{ { 0, 90 }, { 0, 40, 40, 90 }, { 10, 30, 60 } },
    azimuths{ { 0 }, { 0, 90, 180, 270, 360 }, { -30, 80, 100 } };
  if (!isFlat)
  {
    polars.insert(polars.end(), { { 0, 180 }, { 30, 90, 90, 170 } });
  }
  const Tuple polar = Pick(random, polars), azimuth = Pick(random, azimuths);
  Tuple values(polar.size() * azimuth.size());
  std::generate(
    values.begin(), values.end(), [&] { return Chance(random, 4) ? 0 : random.Between(0, 10); });
  values[0] = 1;
  SetField(lamp, "PolarAngles", polar);
  SetField(lamp, "AzimuthAngles", azimuth);
  SetField(lamp, "RadiantIntensity", values);
}

/// Any axes across each other; of a flat lamp the axis stays.
inline void SetRandomAxes(RandomNumbers& random, vtkPolyData* lamp, bool isFlat)
{
  Vector axis{ 0, 0, -1 }, reference{};
  if (!isFlat)
  {
    axis = { random.Between(-1, 1), random.Between(-1, 1), random.Between(0.1, 1) };
    vtkMath::Normalize(axis.data());
    SetCellValues(lamp, "LampAxis", { axis[0], axis[1], axis[2] });
  }
  vtkMath::Perpendiculars(axis.data(), reference.data(), nullptr, random.Between(0, 6));
  SetCellValues(lamp, "LampReference", { reference[0], reference[1], reference[2] });
}

inline bool IsFlat(vtkPolyData* mesh)
{
  const double* bounds = mesh->GetBounds();
  return mesh->GetNumberOfPolys() > 0 && bounds[4] == bounds[5];
}

/// Around the origin: points, a square of one lamp or two that shines downwards, or a box.
inline Mesh RandomLuminaire(RandomNumbers& random)
{
  const double side = 0.125 * (1 + random.Below(4));
  const int kind = random.Below(3);
  Mesh lamp = kind == 0 ? MakePointLight({ 0, 0, 0 }, { 1 })
    : kind == 1 ? MakeRectangle({ -side, -side, 0 }, { 0, 2 * side, 0 }, { 2 * side, 0, 0 }, 2)
                : MakeBox(side, 0.25, 0.125);
  if (kind == 0 && Chance(random, 3))
  {
    lamp = Join({ lamp, MakePointLight({ 0.25, 0, 0 }, { 1 }) });
  }
  lamp->GetCellData()->RemoveArray("RadiantFlux");
  if (kind == 1 && Chance(random, 3))
  {
    SetCellValues(lamp, "LampId", { 1 });
    lamp->GetCellData()->GetArray("LampId")->SetComponent(random.Below(4), 0, -7);
  }
  SetRandomTable(random, lamp, kind == 1);
  SetRandomFlux(random, lamp);
  if (Chance(random, 2))
  {
    SetRandomAxes(random, lamp, kind == 1);
  }
  return lamp;
}

// Skies.

inline bool IsSky(vtkPolyData* mesh)
{
  return mesh->GetFieldData()->HasArray("SunIrradiance");
}

/// Sun and sky, or one of them, at day or at night. Now and then its bounds leave out what moves.
inline Mesh RandomSky(RandomNumbers& random)
{
  vtkNew<vtkSunSkySource> source;
  source->SetSkyModel(random.Below(vtkSunSkySource::Perez)); // Perez has none for some input
  source->SetSunAzimuth(random.Between(0, 360));
  source->SetSunAltitude(random.Between(-10, 90));
  source->SetSunAngularRadius(Chance(random, 3) ? 0 : random.Between(0, 10));
  source->SetDirectNormalIrradiance(Chance(random, 3) ? 0 : random.Between(0, 900));
  source->SetDiffuseHorizontalIrradiance(Chance(random, 3) ? 0 : random.Between(0, 400));
  source->SetGround(Chance(random, 2));
  if (!Chance(random, 6))
  {
    const double low = Chance(random, 12) ? -1 : -8;
    source->SetBounds(low, 11, low, 11, low, 11);
  }
  source->Update();
  Mesh sky = Copy(source->GetOutput());
  if (Chance(random, 4))
  {
    SetFieldTuple(sky, "SunIrradiance", { random.Between(0, 500), 0, random.Between(0, 500) });
    SetFieldTuple(sky, "SkyWeights", { random.Between(0, 1), 1, 0 });
  }
  return sky;
}

}
