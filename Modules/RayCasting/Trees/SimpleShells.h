// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Meshes/SolidSides.h"
#include "Trees/TriangleTree.h"

namespace irradiance
{

/**
 * Marks the closed shells that neither cross nor touch themselves, but at common edges and corners
 * of their triangles. Such a shell parts its inside from all else. That is proven but for rounding:
 * where it is in doubt, or very many triangles lie at one place, a shell is not marked. `tree`: of
 * the triangles.
 */
void markSimpleShells(SolidSides& sides, const std::vector<Triangle>& triangles,
  const TriangleTree& tree, const CancelPoint& cancelPoint);

}
