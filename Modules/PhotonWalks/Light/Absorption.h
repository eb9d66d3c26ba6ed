// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Absorption_h
#define irradiance_Absorption_h

#include "Light/Material.h"
#include "Light/Power.h"

#include <algorithm>

namespace irradiance
{

/// The probability that a walk survives a hit on a diffuse material: the part of its strongest band
/// that the material reflects. One band: the reflectance (section 3.1 of the paper).
inline double survivalProbability(
  const Power& incoming, const Material& material, std::uint32_t triangle)
{
  if (material.bands == 1)
  {
    return material.reflectanceOf(triangle, 0);
  }
  double strongest = 0, mostReflected = 0;
  for (int band = 0; band < material.bands; ++band)
  {
    const double reflectance = material.reflectanceOf(triangle, band);
    strongest = std::max(strongest, reflectance * static_cast<double>(incoming[band]));
    mostReflected = std::max(mostReflected, reflectance);
  }
  // The quotient may be rounded up.
  return std::min(strongest / static_cast<double>(incoming.largest()), mostReflected);
}

/// The power of a walk that survived with `probability` > 0. The reflected power over the
/// probability keeps the mean, and leaves the strongest band what it had: one band keeps its power.
inline Power survivingPower(
  const Power& incoming, const Material& material, std::uint32_t triangle, double probability)
{
  if (material.bands == 1)
  {
    return incoming;
  }
  Power outgoing;
  for (int band = 0; band < material.bands; ++band)
  {
    const double reflected =
      material.reflectanceOf(triangle, band) * static_cast<double>(incoming[band]);
    outgoing[band] = std::min(nearestQuanta(reflected / probability), incoming.largest());
  }
  return outgoing;
}

}

#endif
