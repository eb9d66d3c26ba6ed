// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_LampPieces_h
#define irradiance_LampPieces_h

#include "Lights/LightTable.h"

#include <optional>
#include <vector>

namespace irradiance
{

/// A light, or a piece of its triangle, from afar. A light in the air has no normal and shines alike in all
/// directions.
struct LampPiece
{
  std::uint32_t light;
  double share;                             ///< of the light's area
  double flux;                              ///< W, in all bands
  Triangle triangle;                        ///< of an area light
  Vector3 center, normal = Vector3::Zero(); ///< the normal is a unit vector, or zero
  double radius = 0;                        ///< all corners are within it of the center
};

/**
 * The lights of a table as cells look for them. Long triangles are cut: of a strip along a wall a cell is to
 * find the near end, not the middle.
 */
class LampPieces
{
public:
  /// The table must outlive it.
  explicit LampPieces(const LightTable& lights);

  const LightTable& lights() const { return lights_; }
  std::size_t size() const { return pieces_.size(); }
  const LampPiece& operator[](std::size_t piece) const { return pieces_[piece]; }
  /// The light of a triangle, if it is one of the table.
  std::optional<std::uint32_t> lightOn(const TriangleId& triangle) const;

private:
  void cut(const LampPiece& piece, int times);

  const LightTable& lights_;
  std::vector<LampPiece> pieces_;
  std::vector<std::uint32_t> areas_; ///< the lights on triangles, which a table has in order
};

}

#endif
