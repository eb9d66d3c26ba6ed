// SPDX-License-Identifier: BSD-3-Clause
#include "FinalGather/AreaPoints.h"

#include "Sampling/DirectionSampling.h"

#include <algorithm>

namespace irradiance
{

AreaPoints::AreaPoints(const CellShapes& shapes, const SceneTriangles& triangles, std::size_t cell)
{
  std::for_each(shapes.begin(cell), shapes.end(cell), [&](std::uint32_t number) {
    const Triangle triangle = triangleOf(triangles, number);
    parts_.push_back({ triangle, triangle.area(), triangles.idOf(number) });
    area_ += parts_.back().area;
  });
}

std::pair<SurfacePoint, TriangleId> AreaPoints::at(std::array<double, 2> u) const
{
  double before = u[0] * area_;
  auto part = parts_.begin();
  while (before >= part->area && part + 1 != parts_.end())
  {
    before -= part->area;
    ++part;
  }
  // What the choice left of it. Rounding may lead to a last triangle without area.
  u[0] = part->area > 0 ? std::clamp(before / part->area, 0x1p-53, 1 - 0x1p-53) : 0.5;
  return { surfacePoint(part->triangle, sampleTriangle(u)), part->id };
}

}
