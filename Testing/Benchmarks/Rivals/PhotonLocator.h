// SPDX-License-Identifier: BSD-3-Clause
#ifndef PhotonLocator_h
#define PhotonLocator_h

#include "Geometry/Vector.h"

#include <cstddef>
#include <memory>
#include <vector>

/// Where photons are looked for: a place on a surface.
struct Sensor
{
  irradiance::Vector3 point, normal; ///< in the world, m
};

/// What finds the photons nearest to a sensor. It is given all of them when it is made.
class PhotonLocator
{
public:
  virtual ~PhotonLocator() = default;

  /// Builds the structure that is searched, as is done in each frame.
  virtual void build() = 0;
  virtual void find(const Sensor& sensor, std::size_t count) = 0;
  /// From the sensor of the last search to what it found, in any order, m2.
  virtual std::vector<double> squaredDistances() const = 0;
};

/// Jensen's photon map, see PhotonMap. `points`: of the photons, in the world.
std::unique_ptr<PhotonLocator> makePhotonMapLocator(
  const std::vector<irradiance::Vector3>& points, double power);

/// vtkStaticPointLocator on one thread.
std::unique_ptr<PhotonLocator> makeVtkLocator(const std::vector<irradiance::Vector3>& points);

#endif
