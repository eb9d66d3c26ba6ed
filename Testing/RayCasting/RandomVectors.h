// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Vector.h"

#include <Eigen/Geometry>

#include <random>

namespace irradiance::test
{

struct RandomVectors
{
  explicit RandomVectors(unsigned seed)
    : engine(seed)
  {
  }
  double uniform(double lower = -1.0, double upper = 1.0)
  {
    return std::uniform_real_distribution<double>(lower, upper)(engine);
  }
  /// 2^x with x uniform: as often between 1 and 2 as between 16 and 32.
  double powerOfTwo(double lowest, double highest) { return std::exp2(uniform(lowest, highest)); }
  Vector3 inCube()
  {
    const double x = uniform();
    const double y = uniform();
    return { x, y, uniform() };
  }
  Vector3 direction()
  {
    Vector3 x = inCube();
    while (!(x.squaredNorm() <= 1.0 && x.squaredNorm() > 1e-6))
    {
      x = inCube();
    }
    return x.normalized();
  }
  Matrix3 rotation()
  {
    const Vector3 axis = direction();
    return Eigen::AngleAxisd(uniform(-3.14159, 3.14159), axis).toRotationMatrix();
  }
  std::mt19937_64 engine;
};

}
