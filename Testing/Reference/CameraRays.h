// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Sensor.h"

namespace pathtracedroom
{

/// A pinhole camera. A bin is a pixel, row by row from the lower left; it measures the mean
/// radiance over its square of the image plane, W/m2/sr.
class CameraRays : public Sensor
{
public:
  struct View
  {
    Vector3 position, forward, up; ///< in the world; `up` need not be perpendicular to `forward`
    double angle;                  ///< radians, from the lower to the upper edge of the picture
    int width, height;             ///< pixels
  };
  explicit CameraRays(const View& view);

  std::size_t numberOfBins() const override;
  irradiance::Box pointBounds() const override;
  Departure start(std::size_t bin, Random& random) const override;
  int sharedEyeVertices() const override { return 1; }
  std::optional<Place> placeOf(const PathVertex& lightVertex) const override;

private:
  int width_, height_;
  double pixel_;               ///< the edge of a pixel at the distance 1
  Vector3 rightward_, upward_; ///< unit vectors
  PathVertex pinhole_;
};

}
