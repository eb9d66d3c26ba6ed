// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_BallLanes_h
#define irradiance_BallLanes_h

#include "Geometry/Ray.h"

namespace irradiance
{

/// A ball around an object.
struct Ball
{
  Vector3 center;
  double squaredRadius;
};

/// Eight rays that are held beside balls, side by side: most rays miss most objects.
class BallLanes
{
public:
  static constexpr unsigned kSize = 8;

  BallLanes()
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      origin_[axis].setZero();
      direction_[axis].setZero();
    }
  }

  void set(unsigned lane, const Ray& ray)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      origin_[axis][lane] = ray.origin[axis];
      direction_[axis][lane] = ray.direction[axis];
    }
  }
  /// The rays that pass the ball, one bit each, wherever they end.
  unsigned passing(const Ball& ball) const
  {
    const Numbers x = ball.center[0] - origin_[0], y = ball.center[1] - origin_[1],
                  z = ball.center[2] - origin_[2];
    const Numbers along = x * direction_[0] + y * direction_[1] + z * direction_[2];
    const Numbers distance = x.square() + y.square() + z.square();
    const Numbers length = direction_[0].square() + direction_[1].square() + direction_[2].square();
    // By Pythagoras, times the length: without a division or a root, but with cancellation.
    const Numbers gap = (distance * length - along.max(0.0).square()) -
      (ball.squaredRadius + kCancelled * distance) * length;
    unsigned passing = 0;
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      passing |= (gap[lane] > 0 ? 0u : 1u) << lane; // NaN passes
    }
    return passing;
  }

private:
  using Numbers = Eigen::Array<double, kSize, 1>;

  static constexpr double kCancelled = 0x1p-48; ///< some ten roundings, each of 2^-53

  Numbers origin_[3], direction_[3];
};

}

#endif
