// SPDX-License-Identifier: BSD-3-Clause
#ifndef CellSensor_h
#define CellSensor_h

#include "Light/SceneObjects.h"
#include "Sensor.h"

#include <map>
#include <utility>
#include <vector>

namespace pathtracedroom
{

/// A cell of the scene: object 0 is the static one.
struct CellId
{
  std::uint32_t object;
  std::size_t cell;

  friend bool operator<(const CellId& a, const CellId& b)
  {
    return std::tie(a.object, a.cell) < std::tie(b.object, b.cell);
  }
};

/// Cells that measure their irradiance, W/m2, both sides summed. A bin is a cell, in the order given.
class CellSensor : public Sensor
{
public:
  /// `objects` must outlive it. Throws std::invalid_argument for a cell without area.
  CellSensor(const irradiance::SceneObjects& objects, const std::vector<CellId>& cells);

  std::size_t numberOfBins() const override { return cells_.size(); }
  Departure start(std::size_t bin, Random& random) const override;
  int sharedEyeVertices() const override { return 0; }
  std::optional<Place> placeOf(const PathVertex& lightVertex) const override;

private:
  struct Cell
  {
    std::vector<TriangleId> triangles;
    std::vector<double> cumulativeArea; ///< m2, up to and including each triangle
  };

  irradiance::Triangle worldTriangle(const TriangleId& id) const;
  /// The vertex as the eye subpath that starts there would have it.
  PathVertex sensorAt(const PathVertex& vertex, const Cell& cell) const;

  const irradiance::SceneObjects& objects_;
  std::vector<Cell> cells_;
  std::map<CellId, std::size_t> binOfCell_;
};

}

#endif
