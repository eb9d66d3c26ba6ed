// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_ScatterLanes_h
#define irradiance_ScatterLanes_h

#include "Geometry/Triangle.h"
#include "Geometry/VectorLanes.h"
#include "Meshes/SurfaceFormula.h"
#include "Sampling/DirectionSampling.h"
#include "Sampling/SampleLanes.h"

namespace irradiance
{

/// Rays that leave triangles diffusely, side by side.
struct ScatterLanes
{
  static constexpr unsigned kSize = SampleLanes::kSize;

  struct Vectors : VectorLanes<kSize>
  {
    __attribute__((always_inline)) SurfaceFormula::Point operator[](unsigned lane) const
    {
      return { x[lane], y[lane], z[lane] };
    }
  };

  Vectors a, b, c;     ///< corners in world space
  Vectors weights;     ///< barycentric
  Vectors incoming;    ///< direction of the ray that came; matters only where `side` is 0
  SampleLanes samples; ///< of the directions
  /// The side that is left: 1 front, -1 back. On input 0 stands for that from which `incoming` came.
  alignas(64) double side[kSize] = {};
  Vectors origin, direction; ///< of the rays

  void setTriangle(unsigned lane, const Triangle& triangle)
  {
    a.set(lane, triangle.a);
    b.set(lane, triangle.b);
    c.set(lane, triangle.c);
  }

  /// Is compiled once for each instruction set.
  __attribute__((always_inline)) void leave()
  {
    samples.draw();
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      const SurfaceFormula point(a[lane], b[lane], c[lane], weights[lane]);
      const double with = incoming.x[lane] * point.normal.x + incoming.y[lane] * point.normal.y +
        incoming.z[lane] * point.normal.z;
      const double facing = with <= 0 ? 1.0 : -1.0;
      const double turned = side[lane] == 0 ? facing : side[lane];
      const double x = turned * point.normal.x, y = turned * point.normal.y,
                   z = turned * point.normal.z;
      const CosineDirection leaving(x, y, z, samples.x[lane], samples.y[lane]);
      side[lane] = turned;
      origin.x[lane] = point.position.x + point.clearance * x;
      origin.y[lane] = point.position.y + point.clearance * y;
      origin.z[lane] = point.position.z + point.clearance * z;
      direction.x[lane] = leaving.x;
      direction.y[lane] = leaving.y;
      direction.z[lane] = leaving.z;
    }
  }
};

}

#endif
