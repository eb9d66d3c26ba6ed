// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_NearestEstimate_h
#define irradiance_NearestEstimate_h

#include "Photons/NearestPhotons.h"

namespace irradiance
{

/**
 * Power over area is the irradiance at a sensor: that of the photons nearest to it, over the surface
 * that faces as the sensor does within the sphere through the farthest of them, in the flattened world
 * of the sensor. As only surface that
 * is there counts, nothing is lost at edges and in corners.
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
  double area;         ///< world; if it is 0 there is no surface, and nothing is known
  double radius;       ///< in the flattened world
  std::uint32_t found; ///< photons, at most those asked for
};

/// `count`: >= 2. Nothing is known where the sensor is too far away, see NearestPhotons.
NearestEstimate nearestEstimate(const NearestPhotons& photons, const Sensor& sensor,
  std::uint32_t count, double maximumRadius = kInfinity);

/// The world area of all surface that faces as the sensor does within a sphere around it in its
/// flattened world.
double facingArea(const NearestPhotons& photons, const Sensor& sensor, double radius);

}

#endif
