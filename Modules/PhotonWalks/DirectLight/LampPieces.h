// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_LampPieces_h
#define irradiance_LampPieces_h

#include "DirectLight/LampTree.h"
#include "Lights/LightTable.h"
#include "Surfaces/Contacts.h"

#include <optional>
#include <vector>

namespace irradiance
{

/**
 * The lights of a table as cells look for them. Long triangles are cut: of a strip along a wall a
 * cell is to find the near end, not the middle.
 */
class LampPieces
{
public:
  explicit LampPieces(LightTable lights);

  const LightTable& lights() const { return lights_; }
  void setQuantaPerWalk(std::int64_t quanta) { lights_.setQuantaPerWalk(quanta); }
  std::size_t size() const { return pieces_.size(); }
  const LampPiece& operator[](std::size_t piece) const { return pieces_[piece]; }
  const LampTree& tree() const { return tree_; }
  /// Of the centers.
  const Box& centers() const { return centers_; }
  /// The light of a triangle, if it is one of the table.
  std::optional<std::uint32_t> lightOn(const TriangleId& triangle) const;
  /// Those lights of the table that coincide with a triangle.
  std::vector<std::uint32_t> lightsAt(const Contacts& contacts, const TriangleId& triangle) const;
  /// The piece of a light on which a place of its triangle lies.
  std::uint32_t pieceAt(std::uint32_t light, const Vector3& place) const;

private:
  LightTable lights_;
  std::vector<LampPiece> pieces_;
  LampTree tree_;
  Box centers_;
  std::vector<std::uint32_t> areas_; ///< the lights on triangles, which a table has in order
};

}

#endif
