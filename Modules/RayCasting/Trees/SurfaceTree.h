// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/UnitFrame.h"
#include "Meshes/SolidSides.h"

#include <cstdint>
#include <vector>

namespace irradiance
{

/// Some triangles near each other, in the unit frame.
struct SurfaceNode
{
  Vector3 center;
  double radius;    ///< of a ball around the center that holds all of them
  Vector3 axis;     ///< unit vector; the axis of a cone that holds the normals of their fronts
  double thickness; ///< no point is farther from the center along the axis
  double cosine;    ///< of the angle between the axis and the wall of the cone; <= 0: any normal
  double sine;
  double area;
  std::uint32_t begin, end; ///< in the order of the tree
  std::uint32_t right;      ///< its second child, the first follows the node; 0 if it has none
  std::uint8_t solidSides;  ///< the solid sides that occur among its triangles; see maskOf()

  bool isLeaf() const { return right == 0; }
  static std::uint8_t maskOf(SolidSide side)
  {
    return static_cast<std::uint8_t>(1 << static_cast<int>(side));
  }
};

/**
 * The triangles of a mesh, each once, for questions about surface in place of rays: what faces some
 * way, how near it is, and how much there is of it. Triangles without area are left out.
 *
 * Triangles are cut in two, at the median of their centroids, until few are left.
 */
class SurfaceTree
{
public:
  SurfaceTree() = default;
  /// `solidSides`: one for each triangle.
  SurfaceTree(const TriangleMesh& mesh, std::vector<SolidSide> solidSides,
    const CancelPoint& cancelPoint = {});

  bool isEmpty() const { return nodes_.empty(); }
  const UnitFrame& frame() const { return frame_; }
  /// The root comes first.
  const SurfaceNode& node(std::size_t i) const { return nodes_[i]; }
  /// The numbers of triangles in the order of the nodes.
  const std::vector<std::uint32_t>& order() const { return order_; }
  SolidSide solidSide(std::uint32_t triangle) const { return solidSides_[triangle]; }

private:
  class Builder;

  UnitFrame frame_;
  std::vector<SurfaceNode> nodes_;
  std::vector<std::uint32_t> order_;
  std::vector<SolidSide> solidSides_;
};

}
