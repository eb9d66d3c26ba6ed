// SPDX-License-Identifier: BSD-3-Clause
#include "Tally/CellNeighbours.h"

#include "Meshes/MeshEdges.h"

namespace irradiance
{

namespace
{

/// A place and a normal, see cellNeighbours().
using Point = Eigen::Matrix<double, 6, 1>;

/// Two triangles that continue each other across an edge.
struct SmoothEdge
{
  std::array<std::uint32_t, 2> triangles;
  std::array<int, 2> corners; ///< where either triangle's edge begins
  bool isTurned;
};

double distanceToLine(const Point& point, const Point& from, const Point& to)
{
  const Point along = to - from, way = point - from;
  return (way - way.dot(along) / along.squaredNorm() * along).norm();
}

class SmoothSurface
{
public:
  SmoothSurface(const std::vector<Triangle>& triangles,
    const std::vector<std::uint32_t>& cellOfTriangle, const Checkpoint& checkpoint)
    : triangles_(triangles)
    , cellOfTriangle_(cellOfTriangle)
    , pace_(checkpoint)
  {
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
    {
      normals_.push_back(triangles[i].areaVector().stableNormalized());
      if (triangles[i].area() > 0)
      {
        chosen_.push_back(i);
      }
      pace_.step();
    }
    findEdges();
  }

  std::vector<CellNeighbours> neighbours(std::size_t numberOfCells, double normalLength)
  {
    findPoints(normalLength);
    findMiddles(numberOfCells);
    std::vector<CellNeighbours> neighbours;
    for (const SmoothEdge& edge : edges_)
    {
      const std::array<std::uint32_t, 2> cells{ cellOfTriangle_[edge.triangles[0]],
        cellOfTriangle_[edge.triangles[1]] };
      if (cells[0] != cells[1])
      {
        double length = 0, distance = 0; // of both sides of the edge together
        for (const std::size_t i : { 0u, 1u })
        {
          const std::array<Point, 3>& points = points_[edge.triangles[i]];
          const auto k = static_cast<std::size_t>(edge.corners[i]);
          const Point &from = points[k], &to = points[(k + 1) % 3];
          length += (to - from).norm();
          distance += distanceToLine(middles_[cells[i]], from, to);
        }
        neighbours.push_back({ cells, edge.isTurned, 0.5 * length / distance });
      }
      pace_.step();
    }
    return neighbours;
  }

private:
  void findEdges()
  {
    const std::vector<MeshEdge> edges = meshEdges(triangles_, chosen_, {}, pace_);
    for (std::size_t i = 0, end = 0; i < edges.size(); i = end)
    {
      for (end = i + 1; end < edges.size() && edges[end].corners == edges[i].corners;)
      {
        ++end;
      }
      pace_.step(end - i);
      if (end - i == 2)
      {
        const MeshEdge &one = edges[i], &other = edges[i + 1];
        const SmoothEdge edge{ { chosen_[one.triangle], chosen_[other.triangle] },
          { one.corner, other.corner }, one.isForward == other.isForward };
        if (normals_[edge.triangles[0]].dot(normalBeyond(edge, 0)) >= kCosineOfMostFold)
        {
          edges_.push_back(edge);
        }
      }
    }
  }

  /// The normal of the triangle on the other side of an edge, to the front of this one.
  Vector3 normalBeyond(const SmoothEdge& edge, std::size_t side) const
  {
    return (edge.isTurned ? -1.0 : 1.0) * normals_[edge.triangles[1 - side]];
  }

  /// The corners of each triangle. If normals change evenly over a regular mesh, that of a corner is
  /// the triangle's own plus what the two edges that meet there add to it.
  void findPoints(double normalLength)
  {
    std::vector<std::array<Vector3, 3>> turns(
      triangles_.size(), { Vector3::Zero(), Vector3::Zero(), Vector3::Zero() }); // at each edge
    for (const SmoothEdge& edge : edges_)
    {
      for (const std::size_t side : { 0u, 1u })
      {
        const std::uint32_t triangle = edge.triangles[side];
        turns[triangle][static_cast<std::size_t>(edge.corners[side])] =
          normalBeyond(edge, side) - normals_[triangle];
      }
    }
    points_.resize(triangles_.size());
    for (std::size_t i = 0; i < triangles_.size(); ++i)
    {
      for (std::size_t k = 0; k < 3; ++k)
      {
        const Vector3 normal = normals_[i] + (turns[i][k] + turns[i][(k + 2) % 3]);
        points_[i][k] << cornerOf(triangles_[i], static_cast<int>(k)), normalLength * normal;
      }
    }
  }

  /// The centre of mass of each cell; of those without area nothing.
  void findMiddles(std::size_t numberOfCells)
  {
    middles_.assign(numberOfCells, Point::Zero());
    std::vector<double> areas(numberOfCells, 0.0);
    for (const std::uint32_t i : chosen_)
    {
      const double area = triangles_[i].area();
      areas[cellOfTriangle_[i]] += area;
      middles_[cellOfTriangle_[i]] += area / 3 * (points_[i][0] + points_[i][1] + points_[i][2]);
    }
    for (std::size_t cell = 0; cell < numberOfCells; ++cell)
    {
      middles_[cell] /= areas[cell];
    }
  }

  const std::vector<Triangle>& triangles_;
  const std::vector<std::uint32_t>& cellOfTriangle_;
  CheckpointPace pace_;
  std::vector<Vector3> normals_;
  std::vector<std::uint32_t> chosen_; ///< triangles that have an area
  std::vector<SmoothEdge> edges_;
  std::vector<std::array<Point, 3>> points_; ///< the corners of each triangle
  std::vector<Point> middles_;               ///< of cells
};

}

std::vector<CellNeighbours> cellNeighbours(const std::vector<Triangle>& triangles,
  const std::vector<std::uint32_t>& cellOfTriangle, std::size_t numberOfCells, double normalLength,
  const Checkpoint& checkpoint)
{
  return SmoothSurface(triangles, cellOfTriangle, checkpoint)
    .neighbours(numberOfCells, normalLength);
}

}
