// SPDX-License-Identifier: BSD-3-Clause
/** A box whose sides are cut into small, nearly square cells: a room, a plinth, a lamp. */
#ifndef GridBox_h
#define GridBox_h

#include "Box.h"

#include <vtkSmartPointer.h>

#include <array>
#include <optional>

class vtkPolyData;

namespace movingteapot
{

enum class Facing
{
  Inward,
  Outward
};

/** Diffuse reflectance (0..1) of the sides -x, +x, -y, +y, -z, +z; a side without is left out. */
using SideReflectances = std::array<std::optional<double>, 6>;

/**
 * The sides as quads no longer than `cellSize` (m), with a cell array `DiffuseReflectance`.
 * Sides that meet share their points, so that no light gets through an edge.
 */
vtkSmartPointer<vtkPolyData> MakeGridBox(
  const Box& box, double cellSize, Facing facing, const SideReflectances& reflectances);

}

#endif
