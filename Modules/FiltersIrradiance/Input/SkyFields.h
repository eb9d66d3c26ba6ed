// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SkyFields_h
#define irradiance_SkyFields_h

#include "Surfaces/Sky.h"

#include <memory>
#include <string>

class vtkPolyData;

namespace irradiance
{

/// Whether the field data of a polydata have a sky or a sun, as vtkSunSkySource describes them.
bool hasSky(vtkPolyData* input);

/// How many bands its light has.
int bandsOfSky(vtkPolyData* input);

/// The sky and the sun; null if both are dark. Without bounds of its own it lights those of what is
/// static, with a margin. Throws InputError, naming `where`, the array and the value.
std::shared_ptr<const Sky> readSky(
  const std::string& where, vtkPolyData* input, int bands, const Box& ofStatics);

}

#endif
