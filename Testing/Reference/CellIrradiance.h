// SPDX-License-Identifier: BSD-3-Clause
#ifndef CellIrradiance_h
#define CellIrradiance_h

#include "CellPoints.h"
#include "Sensor.h"

namespace pathtracedroom
{

/// Cells that measure their irradiance, W/m2, both sides summed. A bin is a cell.
class CellIrradiance : public Sensor
{
public:
  /// `objects` must outlive it. Throws std::invalid_argument for a cell without area.
  CellIrradiance(const irradiance::SceneObjects& objects, const std::vector<CellId>& cells)
    : points_(objects, cells)
  {
  }

  std::size_t numberOfBins() const override { return points_.numberOfCells(); }
  Departure start(std::size_t bin, Random& random) const override;
  int sharedEyeVertices() const override { return 0; }
  std::optional<Place> placeOf(const PathVertex& lightVertex) const override;

private:
  /// The vertex as the eye subpath that starts there would have it.
  PathVertex sensorAt(const PathVertex& vertex, std::size_t bin) const;

  CellPoints points_;
};

}

#endif
