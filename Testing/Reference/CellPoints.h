// SPDX-License-Identifier: BSD-3-Clause
#ifndef CellPoints_h
#define CellPoints_h

#include "PathVertex.h"
#include "Random.h"
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

}

#endif
