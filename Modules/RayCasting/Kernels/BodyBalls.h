// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/UnitFrame.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace irradiance
{

/// Balls around bodies as floats can test them, in a frame of all.
class BodyBalls
{
public:
  struct Ball
  {
    float center[3]; ///< no coordinate is beyond 1
    /// Of the frame's centre: the square of its distance less that of the radius, widened.
    float power;
  };

  BodyBalls() = default;
  /// A ball that is not finite touches every ray.
  BodyBalls(const std::vector<Vector3>& centers, const std::vector<double>& squaredRadii)
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

  std::uint32_t size() const { return static_cast<std::uint32_t>(balls_.size()); }
  bool isEmpty() const { return balls_.empty(); }
  const Ball* data() const { return balls_.data(); }
  const UnitFrame& frame() const { return frame_; }

private:
  UnitFrame frame_;
  std::vector<Ball> balls_;
};

/// An ellipsoid as floats can test it: every point of the object is `center` + y / `scale` with
/// |roundFromScaled y| <= a radius. Documentation/Theory.md, section 3, derives what pays for
/// rounding.
struct EllipsoidFilter
{
  double center[3];
  double scale;             ///< a power of two; the longest row of the map is about 1 then
  float roundFromScaled[9]; ///< row by row
  float squaredRadius;      ///< widened
  float byDistance;         ///< more of it, per squared distance of the ray's origin
};

/// Some of the rays that follow each other, from `first` on, whose lines may touch the ball of a
/// body.
struct NearRays
{
  static constexpr std::uint32_t kLeastLanes = 4; ///< rays that are tested together

  std::uint32_t first;
  std::uint16_t body;
  std::uint16_t lanes; ///< a bit for each ray
};

}
