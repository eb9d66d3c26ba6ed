// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_BodyBalls_h
#define irradiance_BodyBalls_h

#include "Geometry/UnitFrame.h"

#include <cstdint>
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
  BodyBalls(const std::vector<Vector3>& centers, const std::vector<double>& squaredRadii);

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

#endif
