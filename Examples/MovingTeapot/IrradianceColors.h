// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkColorTransferFunction.h>

#include <iterator>

namespace movingteapot
{

/**
 * Dark to light like glowing iron, from 0 to `brightest` W/m2; even steps in irradiance look even
 * (the "inferno" map of matplotlib, CC0).
 */
inline void SetIrradianceColors(vtkColorTransferFunction* colors, double brightest)
{
  // Not const, for VTK takes no such table.
  double stops[][3] = { { 0.001, 0.000, 0.014 }, { 0.122, 0.047, 0.282 }, { 0.341, 0.062, 0.429 },
    { 0.550, 0.135, 0.404 }, { 0.736, 0.216, 0.330 }, { 0.891, 0.350, 0.197 },
    { 0.978, 0.558, 0.035 }, { 0.976, 0.793, 0.240 }, { 0.988, 0.998, 0.645 } };
  colors->BuildFunctionFromTable(0.0, brightest, int(std::size(stops)), stops[0]);
}

}
