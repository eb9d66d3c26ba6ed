// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SolidSides_h
#define irradiance_SolidSides_h

#include "Meshes/TriangleMesh.h"
#include "Progress/Checkpoint.h"

#include <cstdint>
#include <vector>

namespace irradiance
{

/// On which side of a triangle there is solid matter, where no light can be.
enum class SolidSide : std::int8_t
{
  None,   ///< a sheet
  Behind, ///< behind the front
  InFront
};

struct SolidSides
{
  std::vector<SolidSide> of; ///< each triangle
  std::vector<bool>
    isOfOutermost; ///< whether it belongs to a closed surface that holds all of the mesh
};

/**
 * The solid sides of the triangles of a mesh. A surface that closes is that of a body, solid within;
 * everything else is a sheet. Surfaces are found by edges with the same two corners, exactly; which
 * way round their triangles run does not matter.
 *
 * With `mayHoldRooms`, a closed surface may also be that of a room, solid without. It is taken for one
 * if two of these hold: its front is within; it holds all of the mesh; it holds something that spans
 * less of it than a whole side.
 *
 * `partOf`: the part of the mesh that a triangle belongs to; parts are joined only where they do not
 * close by themselves. `isLamp`: lamps belong to a surface only if it does not close without them.
 * Both for each triangle.
 */
SolidSides solidSides(const std::vector<Triangle>& triangles,
  const std::vector<std::uint32_t>& partOf, const std::vector<bool>& isLamp, bool mayHoldRooms,
  const Checkpoint& checkpoint);

}

#endif
