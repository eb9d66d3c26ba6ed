// SPDX-License-Identifier: BSD-3-Clause
#include "Estimates/CellNeighbours.h"

#include "Meshes/MeshEdges.h"

namespace irradiance
{

namespace
{

/// Two triangles that continue each other across an edge.
struct SmoothEdge
{
  std::array<std::uint32_t, 2> triangles;
  std::array<int, 2> corners; ///< where either triangle's edge begins
  bool isTurned;
};

/// The shape of a cell.
struct SmoothCell
{
  /// A way in the cell, and what the normal turns on it, times `normalLength`.
  Eigen::Matrix<double, 6, 1> way(const Vector3& from, const Vector3& to, double normalLength) const
  {
    Eigen::Matrix<double, 6, 1> both;
    both << to - from, normalLength * (turning * (to - from));
    return both;
  }

  double area = 0;
  Vector3 middle = Vector3::Zero();  ///< centre of mass
  Matrix3 turning = Matrix3::Zero(); ///< the gradient of the normal: turn = turning * way
};

class SmoothSurface
{
public:
  SmoothSurface(const std::vector<Triangle>& triangles,
    const std::vector<std::uint32_t>& cellOfTriangle, const CancelPoint& cancelPoint)
    : triangles_(triangles)
    , cellOfTriangle_(cellOfTriangle)
    , pace_(cancelPoint)
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
    findShapes(numberOfCells);
    std::vector<CellNeighbours> neighbours;
    for (const SmoothEdge& edge : edges_)
    {
      const std::array<std::uint32_t, 2> cells{ cellOfTriangle_[edge.triangles[0]],
        cellOfTriangle_[edge.triangles[1]] };
      if (cells[0] != cells[1])
      {
        double length = 0, distance = 0; // of both cells together
        for (const std::size_t side : { 0u, 1u })
        {
          const SmoothCell& shape = shapes_[cells[side]];
          const Triangle& triangle = triangles_[edge.triangles[side]];
          const Vector3 &from = cornerOf(triangle, edge.corners[side]),
                        &to = cornerOf(triangle, edge.corners[side] + 1);
          const auto along = shape.way(from, to, normalLength),
                     way = shape.way(from, shape.middle, normalLength);
          length += along.norm();
          distance += (way - way.dot(along) / along.squaredNorm() * along).norm();
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

  /// Half-way to the next triangle the normal has made half of the turn. With that, Green and Gauss
  /// give the mean gradient over the cell.
  void findShapes(std::size_t numberOfCells)
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
      pace_.step();
    }
    shapes_.resize(numberOfCells);
    for (const std::uint32_t i : chosen_)
    {
      const Triangle& t = triangles_[i];
      SmoothCell& shape = shapes_[cellOfTriangle_[i]];
      const double area = t.area();
      shape.area += area;
      shape.middle += area / 3 * (t.a + t.b + t.c);
      for (int k = 0; k < 3; ++k)
      {
        const Vector3 outward = (cornerOf(t, k + 1) - cornerOf(t, k)).cross(normals_[i]);
        shape.turning += 0.5 * turns[i][static_cast<std::size_t>(k)] * outward.transpose();
      }
      pace_.step();
    }
    for (SmoothCell& shape : shapes_)
    {
      shape.middle /= shape.area;
      shape.turning /= shape.area;
      pace_.step();
    }
  }

  const std::vector<Triangle>& triangles_;
  const std::vector<std::uint32_t>& cellOfTriangle_;
  ThrottledCancelPoint pace_;
  std::vector<Vector3> normals_;
  std::vector<std::uint32_t> chosen_; ///< triangles that have an area
  std::vector<SmoothEdge> edges_;
  std::vector<SmoothCell> shapes_; ///< of cells; of one without area nothing
};

}

std::vector<CellNeighbours> cellNeighbours(const std::vector<Triangle>& triangles,
  const std::vector<std::uint32_t>& cellOfTriangle, std::size_t numberOfCells, double normalLength,
  const CancelPoint& cancelPoint)
{
  return SmoothSurface(triangles, cellOfTriangle, cancelPoint)
    .neighbours(numberOfCells, normalLength);
}

}
