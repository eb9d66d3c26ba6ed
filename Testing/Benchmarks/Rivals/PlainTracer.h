// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rivals/AliasTable.h"
#include "Rivals/PlainEmbree.h"

#include <vector>

/**
 * What one writes in an afternoon with Embree, and what users would really take: it shoots some
 * thousand walks side by side, bounce by bounce, and adds 1 to a cell for each hit. A walk survives
 * a hit with probability = reflectance, so all photons have the same power and none is carried
 * along. Everything is in floats, random numbers are xorshift, nothing is stored, and a scene in
 * which something has moved is shot again.
 */
class PlainTracer
{
public:
  enum class Packets
  {
    Best, ///< rtcIntersect16 where Embree has it in instructions of the machine, else rtcIntersect8
    Of8   ///< rtcIntersect8
  };

  explicit PlainTracer(const PlainScene& scene, Packets packets = Packets::Best);

  struct Tally
  {
    std::vector<double> hits; ///< of each cell
    std::int64_t segments = 0;
  };
  Tally shoot(std::uint32_t walks, std::uint64_t seed) const;

  /// Rays that Embree is given at once.
  int width() const { return width_; }

private:
  template <class Packet>
  friend class PlainWavefront;

  std::vector<PlainScene::Surface>
    surfaces_; ///< one more than triangles: what a ray hits that escapes
  std::size_t numberOfCells_;
  std::vector<PlainSource> sources_;
  AliasTable choice_; ///< of sources, by flux
  float offset_;      ///< m, see PlainScene::offset()
  PlainEmbree embree_;
  int width_;
};
