// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Sampling/ElementaryFunctions.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace irradiance
{

/// How light leaves a surface.
enum class Leaving : std::uint8_t
{
  Diffuse,        ///< on the side where it came
  Specular,       ///< along a lobe there
  DiffuseThrough, ///< on the other side of a thin sheet
  Straight        ///< there, as it came
};
constexpr std::size_t kLeavings = 4;

inline bool isThrough(Leaving way)
{
  return way >= Leaving::DiffuseThrough;
}
/// Whether the direction depends on the one in which the light came.
inline bool isSharp(Leaving way)
{
  return way == Leaving::Specular || way == Leaving::Straight;
}

/// The parts of the light that a pane reflects and lets through.
struct PaneLight
{
  double reflected, transmitted;
};

/**
 * A clear pane with smooth parallel faces in unpolarised light, with all reflections between them:
 * Fresnel's formulas, and Bouguer's law within. `internal`: what one passage at normal incidence
 * leaves, in (0, 1]. `cosine`: of incidence. Rounded to multiples of 2^-22, so that results do not
 * depend on how a compiler rounds.
 */
inline PaneLight pane(double index, double internal, double cosine)
{
  const double c = std::clamp(cosine, 0.0, 1.0);
  const double inside = std::sqrt(1 - (1 - c * c) / (index * index));
  const double passing = powUnit(internal, 1 / inside);
  const double s = (c - index * inside) / (c + index * inside),
               p = (index * c - inside) / (index * c + inside);
  PaneLight light{ 0, 0 };
  for (const double r : { s * s, p * p })
  {
    const double all = (1 - r) * (1 - r) / (1 - r * r * passing * passing);
    light.transmitted += r < 1 ? 0.5 * all * passing : 0;
    light.reflected += 0.5 * (r < 1 ? r + r * all * passing * passing : 1);
  }
  const auto rounded = [](double value) { return 0x1p-22 * std::floor(0x1p22 * value + 0.5); };
  light.reflected = std::min(rounded(light.reflected), 1.0);
  light.transmitted = std::min(rounded(light.transmitted), 1 - light.reflected);
  return light;
}

/// In light that is alike from all directions, by the midpoint rule over the cosine.
inline PaneLight paneInDiffuseLight(double index, double internal)
{
  constexpr int kPoints = 128;
  PaneLight sum{ 0, 0 };
  for (int i = 0; i < kPoints; ++i)
  {
    const double cosine = (i + 0.5) / kPoints;
    const PaneLight light = pane(index, internal, cosine);
    sum.reflected += 2 * cosine / kPoints * light.reflected;
    sum.transmitted += 2 * cosine / kPoints * light.transmitted;
  }
  return sum;
}

}
