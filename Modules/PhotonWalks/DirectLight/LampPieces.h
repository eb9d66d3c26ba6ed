// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Lights/LampPiece.h"
#include "Lights/LightTable.h"
#include "Sampling/WeightChoice.h"
#include "Surfaces/Contacts.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace irradiance
{

/**
 * The lights of a table as cells look for them. Long triangles are cut: of a strip along a wall a
 * cell is to find the near end, not the middle.
 *
 * Over the pieces is a binary tree. A node stands for all pieces below it, which follow each other
 * in an order of the tree; seen from afar it is one lamp with a cone of normals. So a cell looks at
 * few nodes, however many lamps there are.
 */
class LampPieces
{
public:
  struct Node
  {
    LampPiece lamp;   ///< the piece of a leaf; else what stands for all below, of the share 0
    double depth = 0; ///< m, of places of the lamp behind its center, along its normal
    std::uint32_t first = 0, end = 0; ///< of its pieces, by the order of the tree
    std::uint32_t children = 0;       ///< the number of the first of two; 0 for a leaf

    bool isLeaf() const { return children == 0; }
  };

  explicit LampPieces(LightTable lights);

  const LightTable& lights() const { return lights_; }
  void setQuantaPerWalk(std::int64_t quanta) { lights_.setQuantaPerWalk(quanta); }
  std::size_t size() const { return pieces_.size(); }
  const LampPiece& operator[](std::size_t piece) const { return pieces_[piece]; }
  /// Whether all shine diffusely, or to all sides alike, and from places.
  bool arePlain() const { return arePlain_; }
  /// Of the centers.
  const Box& centers() const { return centers_; }
  /// The light of a triangle, if it is one of the table.
  std::optional<std::uint32_t> lightOn(const TriangleId& triangle) const;
  /// Those lights of the table that coincide with a triangle.
  std::vector<std::uint32_t> lightsAt(const Contacts& contacts, const TriangleId& triangle) const;
  /// The piece of a light on which a place of its triangle lies.
  std::uint32_t pieceAt(std::uint32_t light, const Vector3& place) const;

  /// At least one node, the root, if there are pieces.
  const std::vector<Node>& nodes() const { return nodes_; }
  /// W, of all pieces.
  double flux() const { return nodes_.empty() ? 0 : nodes_.front().lamp.flux; }
  /// Of a piece in the order of the tree.
  std::uint32_t placeOf(std::uint32_t piece) const { return places_[piece]; }
  /// The piece on which a part, in [0, 1), of the flux of a node falls, with its probability.
  WeightChoice choose(const Node& node, double part) const;

private:
  void split(std::uint32_t number);
  /// Of the pieces [first, end) of the order.
  Node nodeOf(std::uint32_t first, std::uint32_t end) const;

  LightTable lights_;
  std::vector<LampPiece> pieces_;
  bool arePlain_ = true;
  Box centers_;
  std::vector<std::uint32_t> areas_; ///< the lights on triangles, which a table has in order
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_, places_; ///< pieces; the place of each
};

}
