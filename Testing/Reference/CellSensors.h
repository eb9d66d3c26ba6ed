// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Sensor.h"
#include "Surfaces/SceneObjects.h"

#include <map>
#include <optional>
#include <tuple>
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

/// The points of some cells, numbered as they are given.
class CellPoints
{
public:
  /// `objects` must outlive it. Throws std::invalid_argument for a cell without area.
  CellPoints(const irradiance::SceneObjects& objects, const std::vector<CellId>& cells);

  std::size_t numberOfCells() const { return cells_.size(); }
  /// m2, of one side.
  double area(std::size_t cell) const { return cells_[cell].cumulativeArea.back(); }
  /// A point on the front of a cell, distributed evenly over its area.
  struct Point
  {
    TriangleId id;
    irradiance::SurfacePoint surface;
  };
  Point choose(std::size_t cell, Random& random) const;
  /// The number of the cell to which a vertex belongs, if it is one of them.
  std::optional<std::size_t> cellOf(const PathVertex& vertex) const;

private:
  struct Cell
  {
    std::vector<TriangleId> triangles;
    std::vector<double> cumulativeArea; ///< m2, up to and including each triangle
  };

  irradiance::Triangle worldTriangle(const TriangleId& id) const;

  const irradiance::SceneObjects& objects_;
  std::vector<Cell> cells_;
  std::map<CellId, std::size_t> numbers_;
};

/// Cells that measure something. A bin is a cell.
class CellSensor : public Sensor
{
public:
  std::size_t numberOfBins() const override { return points_.numberOfCells(); }
  int sharedEyeVertices() const override { return 0; }

protected:
  /// `objects` must outlive it. Throws std::invalid_argument for a cell without area.
  CellSensor(const irradiance::SceneObjects& objects, const std::vector<CellId>& cells)
    : points_(objects, cells)
  {
  }

  CellPoints points_;
};

/// Cells that measure their irradiance, W/m2, both sides summed.
class CellIrradiance : public CellSensor
{
public:
  /// As CellSensor.
  CellIrradiance(const irradiance::SceneObjects& objects, const std::vector<CellId>& cells)
    : CellSensor(objects, cells)
  {
  }

  Departure start(std::size_t bin, Random& random) const override;
  std::optional<Place> placeOf(const PathVertex& lightVertex) const override;

private:
  /// The vertex as the eye subpath that starts there would have it.
  PathVertex sensorAt(const PathVertex& vertex, std::size_t bin) const;
};

/// Cells that measure the radiance, W/m2/sr, that they reflect towards an eye, as a mean over their
/// area; without what they emit themselves. Whether something hides them does not matter.
class CellRadiance : public CellSensor
{
public:
  /// As CellSensor.
  CellRadiance(
    const irradiance::SceneObjects& objects, const std::vector<CellId>& cells, const Vector3& eye)
    : CellSensor(objects, cells)
    , objects_(objects)
    , eye_(eye)
  {
  }

  Departure start(std::size_t bin, Random& random) const override;
  std::optional<Place> placeOf(const PathVertex& lightVertex) const override;

private:
  PathVertex sensorAt(const PathVertex& vertex, std::size_t bin) const;

  const irradiance::SceneObjects& objects_;
  Vector3 eye_;
};

}
