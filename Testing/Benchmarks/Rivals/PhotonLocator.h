// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IrradianceEngine.h"
#include "Photons/Sensor.h"

#include <cstddef>
#include <memory>
#include <vector>

/// What finds the photons nearest to a sensor. It is given all of them when it is made.
class PhotonLocator
{
public:
  virtual ~PhotonLocator() = default;

  /// Makes ready what is searched, as is done in each frame.
  virtual void build() = 0;
  virtual void find(const irradiance::Sensor& sensor, std::size_t count) = 0;
  /// From the sensor of the last search to what it found, in any order, m2.
  virtual std::vector<double> squaredDistances() const = 0;
  /// From a sensor to all photons that it may find, by a look at each of them.
  virtual std::vector<double> allSquaredDistances(const irradiance::Sensor& sensor) const = 0;
};

/// Jensen's photon map, see PhotonMap, of an engine that keeps photons.
std::unique_ptr<PhotonLocator> makePhotonMapLocator(const irradiance::IrradianceEngine& engine);

/// vtkStaticPointLocator on one thread.
std::unique_ptr<PhotonLocator> makeVtkLocator(const irradiance::IrradianceEngine& engine);

/// Photons in the leaf cells of the ray-casting trees. Nothing is built again: a frame is a step
/// from one engine's scene to the other's, or back, and only the photons that differ are moved. The
/// engines have shot the same walks, and keep their sides known; they must outlive the locator.
std::unique_ptr<PhotonLocator> makeLeafLocator(
  irradiance::IrradianceEngine& engine, irradiance::IrradianceEngine& other);
