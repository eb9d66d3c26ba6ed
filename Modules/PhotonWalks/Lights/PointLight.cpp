// SPDX-License-Identifier: BSD-3-Clause
#include "Lights/PointLight.h"

#include "Sampling/DirectionSampling.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace irradiance
{

namespace
{

/// Mirrors a direction at walls until it points to the open side of all; false if it never does.
bool mirrorInto(const std::vector<Vector3>& openSides, Vector3& direction)
{
  constexpr int kMostMirrors = 256; // walls at an acute angle take several
  for (int i = 0; i < kMostMirrors; ++i)
  {
    const auto wall = std::find_if(openSides.begin(), openSides.end(),
      [&](const Vector3& side) { return side.dot(direction) < 0; });
    if (wall == openSides.end())
    {
      return true;
    }
    direction -= 2 * wall->dot(direction) * *wall;
  }
  return false;
}

}

PointLight::PointLight(const Vector3& position, const std::vector<Wall>& walls)
  : position_(position)
{
  for (const Wall& wall : walls)
  {
    position_ += std::max(0.0, wall.clearance - wall.distance) * wall.normal;
    openSides_.push_back(wall.normal);
  }
  Vector3 direction(0.48, 0.6, 0.64);
  if (!mirrorInto(openSides_, direction))
  {
    std::ostringstream text;
    text << "the point light at (" << position_.transpose()
         << ") lies in the planes of walls that leave it no side to shine into";
    throw std::runtime_error(text.str());
  }
}

Ray PointLight::leaving(const std::array<double, 2>& u) const
{
  Vector3 shining = sampleSphere(u);
  mirrorInto(openSides_, shining);
  return { position_, shining, {} };
}

}
