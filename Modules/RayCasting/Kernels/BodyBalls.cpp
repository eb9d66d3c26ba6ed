// SPDX-License-Identifier: BSD-3-Clause
#include "Kernels/BodyBalls.h"

#include <cmath>
#include <limits>

namespace irradiance
{

BodyBalls::BodyBalls(const std::vector<Vector3>& centers, const std::vector<double>& squaredRadii)
{
  constexpr double kWider = 0x1p-16; // of the square of a radius
  const auto isFinite = [&](std::size_t i) {
    return centers[i].allFinite() && std::isfinite(squaredRadii[i]);
  };
  Box bounds;
  for (std::size_t i = 0; i < centers.size(); ++i)
  {
    if (isFinite(i))
    {
      const Vector3 radii = Vector3::Constant(std::sqrt(squaredRadii[i]));
      bounds.add(Box{ centers[i] - radii, centers[i] + radii });
    }
  }
  frame_ = UnitFrame(bounds);
  for (std::size_t i = 0; i < centers.size(); ++i)
  {
    const Vector3 center = isFinite(i) ? frame_(centers[i]) : Vector3::Zero();
    const double power = isFinite(i)
      ? center.squaredNorm() - squaredRadii[i] * frame_.scale * frame_.scale - kWider
      : -std::numeric_limits<double>::infinity();
    balls_.push_back({ { static_cast<float>(center[0]), static_cast<float>(center[1]),
                         static_cast<float>(center[2]) },
      static_cast<float>(power) });
  }
}

}
