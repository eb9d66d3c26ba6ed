// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_BallLanes_h
#define irradiance_BallLanes_h

#include "Geometry/Ray.h"
#include "Geometry/VectorLanes.h"

namespace irradiance
{

/// A ball around an object.
struct Ball
{
  Vector3 center;
  double squaredRadius;
};

/// Tests eight rays against the ball around an object at once: most rays miss most objects.
struct BallLanes
{
  static constexpr unsigned kSize = 8;

  VectorLanes<kSize> origin, direction;

  void set(unsigned lane, const Ray& ray)
  {
    origin.set(lane, ray.origin);
    direction.set(lane, ray.direction);
  }

  /// The rays that pass the ball, one bit each, wherever they end. Is compiled once for each
  /// instruction set.
  __attribute__((always_inline)) unsigned passing(const Ball& ball) const
  {
    // Some ten roundings, each of 2^-53.
    constexpr double kCancelled = 0x1p-48;
    const double centerX = ball.center[0], centerY = ball.center[1], centerZ = ball.center[2];
    alignas(64) double gap[kSize];
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      const double x = centerX - origin.x[lane], y = centerY - origin.y[lane],
                   z = centerZ - origin.z[lane];
      const double dx = direction.x[lane], dy = direction.y[lane], dz = direction.z[lane];
      const double towards = x * dx + y * dy + z * dz;
      const double along = towards > 0 ? towards : 0;
      const double distance = x * x + y * y + z * z, length = dx * dx + dy * dy + dz * dz;
      // By Pythagoras, times the length: without a division or a root, but with cancellation.
      gap[lane] =
        (distance * length - along * along) - (ball.squaredRadius + kCancelled * distance) * length;
    }
    unsigned bits = 0;
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      bits |= (gap[lane] > 0 ? 0u : 1u) << lane; // NaN passes
    }
    return bits;
  }
};

/// BallLanes::passing() with the best instructions of the machine.
unsigned passingOf(const BallLanes& lanes, const Ball& ball);
unsigned passingOfPlain(const BallLanes& lanes, const Ball& ball);
unsigned passingOfAvx2(const BallLanes& lanes, const Ball& ball);
unsigned passingOfAvx512(const BallLanes& lanes, const Ball& ball);

}

#endif
