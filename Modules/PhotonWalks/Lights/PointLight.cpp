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

std::vector<Vector3>::const_iterator firstBehind(
  const std::vector<Vector3>& openSides, const Vector3& direction)
{
  return std::find_if(openSides.begin(), openSides.end(),
    [&](const Vector3& side) { return side.dot(direction) < 0; });
}

constexpr int kMostMirrors = 256; // walls at an acute angle take several

Vector3 mirroredAt(const Vector3& normal, const Vector3& direction)
{
  return direction - 2 * normal.dot(direction) * normal;
}

/// Mirrors a direction at walls until it points to the open side of all; false if it never does.
bool mirrorInto(const std::vector<Vector3>& openSides, Vector3& direction)
{
  for (int i = 0; i < kMostMirrors; ++i)
  {
    const auto wall = firstBehind(openSides, direction);
    if (wall == openSides.end())
    {
      return true;
    }
    direction = mirroredAt(*wall, direction);
  }
  return false;
}

/// How many directions mirrorInto() takes to this one, itself among them.
int numberMirroredInto(
  const std::vector<Vector3>& openSides, const Vector3& direction, int mirrors = 0)
{
  int number = 1;
  for (auto wall = openSides.begin(); wall != openSides.end() && mirrors < kMostMirrors; ++wall)
  {
    const Vector3 before = mirroredAt(*wall, direction);
    if (firstBehind(openSides, before) == wall)
    {
      number += numberMirroredInto(openSides, before, mirrors + 1);
    }
  }
  return number;
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

Ray PointLight::leaving(
  const std::array<double, 2>& /*place*/, const std::array<double, 2>& direction) const
{
  Vector3 shining = sampleSphere(direction);
  mirrorInto(openSides_, shining);
  return { position_, shining, {} };
}

double PointLight::density(const Vector3& direction) const
{
  constexpr double kSphere = 4 * kPi;
  return firstBehind(openSides_, direction) == openSides_.end()
    ? numberMirroredInto(openSides_, direction) / kSphere
    : 0;
}

}
