// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Surfaces/Sky.h"

#include <cmath>
#include <functional>
#include <vector>

namespace irradiance::test
{

/// W/m2/sr of a direction that points to where light comes from.
using RadianceOf = std::function<double(const Vector3& towards)>;

/// Degrees from the zenith, and from north (+y) over east.
inline Vector3 skyDirection(double polar, double azimuth)
{
  const double z = polar * M_PI / 180, a = azimuth * M_PI / 180;
  return { std::sin(z) * std::sin(a), std::sin(z) * std::cos(a), std::cos(z) };
}

inline double uniformSky(const Vector3&)
{
  return 1;
}

/// CIE's traditional overcast sky, relative to the zenith.
inline double overcastSky(const Vector3& from)
{
  return (1 + 2 * from[2]) / 3;
}

/// CIE S 011 / ISO 15469, relative to the zenith; the sun is 60 degrees high. Those types that are
/// used here; 16 is the overcast sky.
inline RadianceOf cieSky(int type, double sunAzimuth = 0)
{
  struct Parameters
  {
    double a, b, c, d, e;
  };
  const Parameters p = type == 1 ? Parameters{ 4, -0.7, 0, -1, 0 }
    : type == 5                  ? Parameters{ 0, -1, 0, -1, 0 }
    : type == 12                 ? Parameters{ -1, -0.32, 10, -3, 0.45 }
                                 : Parameters{ -1, -0.32, 16, -3, 0.3 }; // 13
  const Vector3 sun = skyDirection(30, sunAzimuth);
  const auto gradation = [p](double height) {
    return 1 + (height > 0 ? p.a * std::exp(p.b / height) : 0);
  };
  const auto indicatrix = [p](double cosine) {
    const double chi = std::acos(std::min(1.0, std::max(-1.0, cosine)));
    return 1 + p.c * (std::exp(p.d * chi) - std::exp(p.d * M_PI / 2)) + p.e * cosine * cosine;
  };
  if (type == 16)
  {
    return overcastSky;
  }
  return [=](const Vector3& from) {
    return gradation(from[2]) * indicatrix(sun.dot(from)) / (gradation(1) * indicatrix(sun[2]));
  };
}

/// A table of 2.5 degrees of what is over the horizon, and of a ground of one radiance below it.
inline Sky skyOf(const Box& lit, const RadianceOf& radiance, double ground = 0, int bands = 1)
{
  Sky sky;
  sky.lit = lit;
  sky.bandWeights.assign(static_cast<std::size_t>(bands), 1);
  for (int i = 0; i <= 36; ++i)
  {
    sky.polarAngles.push_back(2.5 * i);
  }
  if (ground > 0)
  {
    sky.polarAngles.insert(sky.polarAngles.end(), { 90, 180 });
  }
  for (int i = 0; i <= 144; ++i)
  {
    sky.azimuths.push_back(2.5 * i);
    for (std::size_t k = 0; k < sky.polarAngles.size(); ++k)
    {
      sky.radiance.push_back(
        k <= 36 ? radiance(skyDirection(sky.polarAngles[k], 2.5 * i)) : ground);
    }
  }
  return sky;
}

/// W/m2 of a parallel or wide sun, across its light.
inline Sky sunOnly(const Box& lit, const Vector3& towardsSun, double irradiance, double radius = 0)
{
  Sky sky;
  sky.lit = lit;
  sky.towardsSun = towardsSun;
  sky.sunIrradiance = { irradiance };
  sky.sunRadius = radius;
  return sky;
}

/// The integral over all directions, or those above the horizon: midpoints, `n` from pole to pole.
template <class Function>
double overDirections(const Function& function, int n = 720, bool isAbove = false)
{
  double sum = 0;
  for (int i = 0; i < (isAbove ? n / 2 : n); ++i)
  {
    const double weight = std::sin((i + 0.5) * M_PI / n) * std::pow(M_PI / n, 2);
    for (int k = 0; k < 2 * n; ++k)
    {
      sum += weight * function(skyDirection((i + 0.5) * 180 / n, (k + 0.5) * 180 / n));
    }
  }
  return sum;
}

/// Of a sky without ground, on a plane.
inline double skyIrradiance(const RadianceOf& radiance, const Vector3& normal, int n = 360)
{
  return overDirections(
    [&](const Vector3& from) { return radiance(from) * std::max(0.0, normal.dot(from)); }, n, true);
}

}
