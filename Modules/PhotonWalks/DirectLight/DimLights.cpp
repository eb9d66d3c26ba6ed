// SPDX-License-Identifier: BSD-3-Clause
#include "DirectLight/DimLights.h"

#include <algorithm>
#include <numeric>

namespace irradiance
{

namespace
{

/// Times the mean radiosity. Twice as bright a ceiling is found with less noise by looking for it.
constexpr double kBrightest = 1.5;

}

/// What arrives at first and returns at each reflection fills the static object evenly, roughly: as
/// much as its mean radiosity.
DimLights::DimLights(const SceneObjects& objects, const FirstHits& hits, double reflected)
  : objects_(objects)
{
  constexpr double kMostReturned = 0.99; // what returns is known from few rays
  const double returned = std::min({ hits.returned(), reflected, kMostReturned });
  brightest_ = hits.area() > 0 ? kBrightest * hits.arrived() / (1 - returned) / hits.area() : 0;
}

bool DimLights::contains(const Light& light) const
{
  const SceneObject& object = objects_[light.cell.object];
  const double* const exitance = object.exitanceOf(light.cell.cell);
  return light.surface() &&
    std::accumulate(exitance, exitance + object.emission->bands, 0.0) <= brightest_;
}

}
