// SPDX-License-Identifier: BSD-3-Clause
#include "Input/PointFacets.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>

namespace irradiance
{

namespace
{

/// Part of a cell's width that sensors lie from its edges.
constexpr double kInwards = 1e-4;

/// The cells of a facet at a point, or one of them.
struct Corners
{
  vtkIdType point;
  Vector3 normal; ///< times the angle
  /// From one edge of the facet to the other, as unit vectors from the point: a quarter turn about
  /// the normal makes it point inwards. It is zero where cells surround the point.
  Vector3 along;
  double angle;
  double width; ///< of the narrowest cell
  bool isFrontDark, isBackDark;
};

/// Calls visit(cell, number of points, their ids) for all polygons, and for the triangles of
/// strips.
template <class Visit>
void forEachPolygon(vtkPolyData* surface, const Visit& visit)
{
  vtkIdType cell = surface->GetNumberOfVerts() + surface->GetNumberOfLines(); // these come first
  forEachCell(
    surface->GetPolys(), [&](vtkIdType size, const vtkIdType* ids) { visit(cell++, size, ids); });
  forEachCell(surface->GetStrips(), [&](vtkIdType size, const vtkIdType* ids) {
    for (vtkIdType i = 0; i + 2 < size; ++i)
    {
      // Every second one is turned over.
      const vtkIdType triangle[3] = { ids[i], ids[i + 1 + i % 2], ids[i + 2 - i % 2] };
      visit(cell, 3, triangle);
    }
    ++cell;
  });
}

/// A polygon, to look at its corners.
class Polygon
{
public:
  Polygon(vtkPolyData* surface, vtkIdType size, const vtkIdType* ids)
    : corners_(static_cast<std::size_t>(size))
  {
    for (std::size_t i = 0; i < corners_.size(); ++i)
    {
      surface->GetPoint(ids[i], corners_[i].data());
    }
    Vector3 area = Vector3::Zero();
    double around = 0;
    for (std::size_t i = 0; i < corners_.size(); ++i)
    {
      const Vector3 next = corners_[(i + 1) % corners_.size()];
      area += (corners_[i] - corners_[0]).cross(next - corners_[0]) / 2;
      around += (next - corners_[i]).stableNorm();
    }
    normal_ = area.stableNormalized();
    width_ = around > 0 ? 2 * area.stableNorm() / around : 0;
  }

  /// Turns the front to the other side.
  void turnOver()
  {
    std::reverse(corners_.begin(), corners_.end());
    normal_ = -normal_;
  }
  bool hasArea() const { return normal_.squaredNorm() > 0; }
  Corners at(std::size_t i, vtkIdType point, const CellShape& shape) const
  {
    const Vector3 next = edge(i, 1), previous = edge(i, corners_.size() - 1);
    const double turn = std::atan2(normal_.dot(next.cross(previous)), next.dot(previous));
    const double angle = turn < 0 ? turn + 2 * M_PI : turn;
    return { point, angle * normal_, next - previous, angle, width_, shape.isFrontDark,
      shape.isBackDark };
  }

private:
  /// To the nearest corner that lies elsewhere, going so many steps at a time; a unit vector.
  Vector3 edge(std::size_t from, std::size_t step) const
  {
    const std::size_t size = corners_.size();
    Vector3 away = Vector3::Zero();
    for (std::size_t i = 1; i < size && away.isZero(0); ++i)
    {
      away = corners_[(from + i * step) % size] - corners_[from];
    }
    return away.stableNormalized();
  }

  std::vector<Vector3> corners_;
  Vector3 normal_;
  double width_;
};

/// Of all cells, sorted by point.
std::vector<Corners> cornersOf(vtkPolyData* surface, bool isMirrored, const PartCells& cells,
  const CellShapes& shapes, const CancelPoint& cancelPoint)
{
  std::vector<Corners> corners;
  ThrottledCancelPoint pace(cancelPoint);
  forEachPolygon(surface, [&](vtkIdType cell, vtkIdType size, const vtkIdType* ids) {
    Polygon polygon(surface, size, ids);
    const CellShape& shape = shapes[shapes.numbers()[cells[cell]]];
    if (isMirrored)
    {
      polygon.turnOver();
    }
    for (vtkIdType i = 0; i < size && polygon.hasArea(); ++i)
    {
      const vtkIdType id = ids[isMirrored ? size - 1 - i : i];
      corners.push_back(polygon.at(static_cast<std::size_t>(i), id, shape));
    }
    pace.step(static_cast<std::size_t>(size));
  });
  std::stable_sort(corners.begin(), corners.end(),
    [](const Corners& a, const Corners& b) { return a.point < b.point; });
  return corners;
}

/// Whether a cell belongs to a facet. `leastCosine`: of their normals.
bool meetSmoothly(const Corners& facet, const Corners& cell, double leastCosine)
{
  return facet.point == cell.point &&
    facet.normal.dot(cell.normal) >= leastCosine * facet.normal.norm() * cell.normal.norm();
}

void add(const Corners& cell, Corners& facet)
{
  facet.normal += cell.normal;
  facet.along += cell.along;
  facet.angle += cell.angle;
  facet.width = std::min(facet.width, cell.width);
  facet.isFrontDark = facet.isFrontDark && cell.isFrontDark;
  facet.isBackDark = facet.isBackDark && cell.isBackDark;
}

/// A normal of length 0, or one that is not finite, counts as none.
Vector3 normalOf(const Corners& facet, vtkDataArray* normals)
{
  Vector3 given = Vector3::Zero();
  if (normals)
  {
    normals->GetTuple(facet.point, given.data());
  }
  if (!given.allFinite() || given.isZero(0))
  {
    return facet.normal.stableNormalized();
  }
  return (given.dot(facet.normal) < 0 ? -1 : 1) * given.stableNormalized();
}

PointFacet facetOf(
  vtkPolyData* surface, const Corners& corners, vtkDataArray* normals, double rounding)
{
  PointFacet facet{ corners.point, {}, corners.angle, corners.isFrontDark, corners.isBackDark };
  surface->GetPoint(corners.point, facet.front.position.data());
  facet.front.normal = normalOf(corners, normals);
  const Vector3 inwards = facet.front.normal.cross(corners.along);
  constexpr double kSurrounded = 1e-3; // edges of less are those of needles, or rounding
  if (const double length = inwards.norm(); length > kSurrounded)
  {
    const double step = std::min(kInwards * corners.width + rounding, corners.width / 4);
    facet.front.position += step / length * inwards;
  }
  return facet;
}

}

std::vector<PointFacet> pointFacetsOf(vtkPolyData* surface, bool isMirrored, double featureAngle,
  double rounding, const PartCells& cells, const CellShapes& shapes, const CancelPoint& cancelPoint)
{
  vtkDataArray* normals = surface->GetPointData()->GetNormals();
  normals = normals && normals->GetNumberOfComponents() == 3 ? normals : nullptr;
  constexpr double kAll = -2;
  const double leastCosine = normals ? kAll : std::cos(featureAngle);
  std::vector<Corners> facets;
  std::size_t first = 0; // of the point
  for (const Corners& cell : cornersOf(surface, isMirrored, cells, shapes, cancelPoint))
  {
    first = first < facets.size() && facets[first].point == cell.point ? first : facets.size();
    const auto facet = std::find_if(facets.begin() + static_cast<std::ptrdiff_t>(first),
      facets.end(), [&](const Corners& other) { return meetSmoothly(other, cell, leastCosine); });
    facet == facets.end() ? facets.push_back(cell) : add(cell, *facet);
  }
  std::vector<PointFacet> found;
  found.reserve(facets.size());
  for (const Corners& facet : facets)
  {
    found.push_back(facetOf(surface, facet, normals, rounding));
  }
  return found;
}

}
