// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Reflection_h
#define irradiance_Reflection_h

#include "Light/Material.h"
#include "Light/Power.h"

namespace irradiance
{

/// The part of `incoming` that a diffuse material reflects, rounded to the nearest quantum.
inline Power reflected(const Power& incoming, const Material& material, std::uint32_t triangle)
{
  Power outgoing;
  for (int band = 0; band < material.bands; ++band)
  {
    outgoing[band] =
      nearestQuanta(material.reflectanceOf(triangle, band) * static_cast<double>(incoming[band]));
  }
  return outgoing;
}

}

#endif
