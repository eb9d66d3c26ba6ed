// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_NearestEstimate_h
#define irradiance_NearestEstimate_h

#include "Photons/NearestPhotons.h"

namespace irradiance
{

/**
 * Power over area is the irradiance at a sensor: the power of the photons nearest to its foot, over
 * the surface that counts within the sphere through the farthest of them, in the flattened world of
 * the sensor. As only surface that is there counts, nothing is lost at edges and in corners; and as
 * the same surface counts for photons and for area, what does not count leaves no bias.
 *
 * The farthest photon sets the radius and is not counted itself: of k photons scattered evenly over
 * surface, k - 1 over the area that reaches to the k-th has their density as its mean, k over that
 * area k / (k - 1) times as much (Loftsgaarden and Quesenberry 1965).
 */
struct NearestEstimate
{
  /// Where there are fewer photons than asked for, all count, and the sphere has the largest radius
  /// that is allowed.
  Power power;
  /// World; if it is 0, there is no surface and nothing is known. Infinite if the power is 0, which
  /// is then the irradiance, however large the area is.
  double area;
  double radius;       ///< in the flattened world
  std::uint32_t found; ///< photons, at most those asked for
};

/// `count`: >= 2.
NearestEstimate nearestEstimate(const NearestPhotons& photons, const Foot& foot,
  std::uint32_t count, double maximumRadius = kInfinity);

/// The world area of all surface that counts for a sensor within a sphere around its foot in its
/// flattened world.
double countedArea(const NearestPhotons& photons, const Foot& foot, double radius);

/// The largest radius if the user sets none: four times the one that `count` photons fill
/// on the average of the scene, at most a quarter of the scene's largest extent. World.
double usualRadius(const NearestPhotons& photons, std::uint32_t count);
/// How far from a surface a sensor may lie and still counts as on it, if the user sets no distance.
/// World.
double usualDistance(const NearestPhotons& photons);

}

#endif
