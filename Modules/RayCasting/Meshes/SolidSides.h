// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Meshes/TriangleMesh.h"
#include "Progress/CancelPoint.h"

#include <cstdint>
#include <vector>

namespace irradiance
{

/// The side of a triangle where there is solid matter, hence no light.
enum class SolidSide : std::int8_t
{
  None,   ///< a sheet
  Behind, ///< behind the front
  InFront
};

/// A connected surface.
struct Shell
{
  Box bounds;
  double area = 0;
  double volume = 0; ///< that it encloses, if it is closed
  bool isClosed = false;
  bool isTurned = false;    ///< its triangles, as given, have their fronts inside
  bool isRoom = false;      ///< it is closed, and solid outside; else a closed one is a body
  bool isSimple = false;    ///< proven not to cross itself, see markSimpleShells()
  bool isOutermost = false; ///< it is closed, holds all of the mesh, and is no body with cavities
};

struct SolidSides
{
  std::vector<SolidSide> of;          ///< for each triangle
  std::vector<std::uint32_t> shellOf; ///< for each triangle, its place among the shells
  std::vector<Shell> shells;

  const Shell& shell(std::uint32_t triangle) const { return shells[shellOf[triangle]]; }
};

/**
 * Finds the solid sides of the triangles of a mesh. A closed surface belongs to a body, solid
 * inside; everything else is a sheet. Triangles whose edges have exactly the same two corners are
 * connected; the order of their corners does not matter.
 *
 * A closed surface with its front inside that lies in the solid of a body is the wall of a cavity,
 * solid outside.
 *
 * With `mayHoldRooms`, a closed surface may also belong to a room, solid outside. It is one if two
 * of these hold: its front is inside; it holds all of the mesh; it holds another surface that
 * spans less of it than a whole side. A wall of a cavity, and what is in the cavity, do not count.
 *
 * Both given arrays have one entry per triangle. `partOf`: its part of the mesh; parts are joined
 * only where they are not closed alone. `isLamp`: lamps belong to a surface only if it does not
 * close without them.
 */
SolidSides solidSides(const std::vector<Triangle>& triangles,
  const std::vector<std::uint32_t>& partOf, const std::vector<bool>& isLamp, bool mayHoldRooms,
  const CancelPoint& cancelPoint);

}
