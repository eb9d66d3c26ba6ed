// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rivals/AliasTable.h"
#include "Rivals/PlainEmbree.h"

#include <vector>

/**
 * The other program that users write with Embree, a baker of light: paths start on cells and look
 * for the lights. At each vertex a lamp is drawn by its flux and a point on it by area, and a
 * shadow ray is cast to it; a path that hits a lamp by itself counts as well, and the two are
 * weighted by the power heuristic (Veach and Guibas 1995). Point lights get shadow rays alone. A
 * sky has no shadow rays: it counts where paths escape.
 * Paths leave by the cosine and survive with probability = reflectance. Where a path starts, where
 * it leaves and its first point of a lamp are a point of Sobol's sequence, shifted for each cell;
 * all else is xorshift. Everything is in floats, some thousand paths go side by side, and nothing
 * is stored.
 */
class PlainGatherer
{
public:
  explicit PlainGatherer(const PlainScene& scene);

  struct Tally
  {
    std::vector<double> irradiance; ///< W/m2 of each of the cells, that on both sides together
    std::int64_t rays = 0;          ///< with shadow rays
  };
  /// `firstCell`, `endCell`: the cells to gather on.
  Tally gather(std::uint32_t firstCell, std::uint32_t endCell, std::uint32_t pathsPerCell,
    std::uint64_t seed) const;

private:
  template <class Packet>
  friend class GatherFront;

  /// A triangle of a cell.
  struct Piece : PlainPatch
  {
    float begin,
      scale; ///< the first number in [0, 1) that draws it; 1 / its share of the cell's area
  };
  struct Cell
  {
    std::uint32_t firstPiece, endPiece;
    bool isOpen; ///< its back is gathered on, too
  };
  /// What a ray hits.
  struct Surface
  {
    float reflectance;
    float density; ///< of a lamp, see PlainSource; else 0
  };

  void makeCells(const PlainScene& scene);

  PlainEmbree embree_;
  std::vector<Surface> surfaces_; ///< one more than triangles, for rays that escape
  std::vector<Piece> pieces_;     ///< by cell
  std::vector<Cell> cells_;
  std::vector<PlainSource> sources_;
  AliasTable choice_;                       ///< of sources, by flux
  float totalFlux_;                         ///< W
  float offset_;                            ///< m, see PlainScene::offset()
  float (*sky_)(const PlainScene::Vector&); ///< see PlainScene
};
