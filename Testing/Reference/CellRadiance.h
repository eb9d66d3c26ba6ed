// SPDX-License-Identifier: BSD-3-Clause
#ifndef CellRadiance_h
#define CellRadiance_h

#include "CellPoints.h"
#include "Sensor.h"

namespace pathtracedroom
{

/// Cells that measure the radiance, W/m2/sr, that they reflect towards an eye, as a mean over their
/// area; without what they emit themselves. Whether something hides them does not matter. A bin is
/// a cell.
class CellRadiance : public Sensor
{
public:
  /// `objects` must outlive it. Throws std::invalid_argument for a cell without area.
  CellRadiance(
    const irradiance::SceneObjects& objects, const std::vector<CellId>& cells, const Vector3& eye)
    : objects_(objects)
    , points_(objects, cells)
    , eye_(eye)
  {
  }

  std::size_t numberOfBins() const override { return points_.numberOfCells(); }
  Departure start(std::size_t bin, Random& random) const override;
  int sharedEyeVertices() const override { return 0; }
  std::optional<Place> placeOf(const PathVertex& lightVertex) const override;

private:
  PathVertex sensorAt(const PathVertex& vertex, std::size_t bin) const;

  const irradiance::SceneObjects& objects_;
  CellPoints points_;
  Vector3 eye_;
};

}

#endif
