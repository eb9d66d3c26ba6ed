#ifndef irradiance_Reflection_h
#define irradiance_Reflection_h

#include "Light/Power.h"
#include "Light/Surface.h"

namespace irradiance
{

/// What a diffuse surface sends back of `incoming`, rounded to the nearest quantum.
inline Power reflected(const Power& incoming, const Surface& surface, std::uint32_t triangle)
{
  Power outgoing;
  for (int band = 0; band < surface.bands; ++band)
  {
    outgoing[band] =
      nearestQuanta(surface.reflectanceOf(triangle, band) * static_cast<double>(incoming[band]));
  }
  return outgoing;
}

}

#endif
