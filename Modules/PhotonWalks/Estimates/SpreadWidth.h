// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SpreadWidth_h
#define irradiance_SpreadWidth_h

#include "Estimates/CellDiffusion.h"

namespace irradiance
{

/// The width of a CellDiffusion after which small cells draw on `photons` photons, on average, of
/// `received` that arrived on `area`; in the unit of the area. 0 if none arrived. It comes in steps
/// of an eighth, so that a diffusion serves as long as about as many arrive.
double spreadWidth(double photons, double area, double received);

/// How power flows over a surface; nothing flows if no cell is smaller than `width`. `areas`: of
/// its cells.
CellDiffusion surfaceDiffusion(const std::vector<double>& areas,
  const std::vector<Triangle>& triangles, const std::vector<std::uint32_t>& cellOfTriangle,
  int sides, double width, const CancelPoint& cancelPoint = {});

}

#endif
