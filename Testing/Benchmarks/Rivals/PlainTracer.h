// SPDX-License-Identifier: BSD-3-Clause
#ifndef PlainTracer_h
#define PlainTracer_h

#include "Rivals/AliasTable.h"
#include "Rivals/PlainScene.h"

#include <embree3/rtcore.h>

#include <vector>

/**
 * What one writes in an afternoon with Embree, and what users would really take: it shoots some thousand
 * walks side by side, bounce by bounce, and adds 1 to a cell for each hit. A walk survives a hit with
 * probability = reflectance, so all photons have the same power and none is carried along. Everything is
 * in floats, random numbers are xorshift, nothing is stored, and a scene in which something has moved is
 * shot again.
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
  ~PlainTracer();
  PlainTracer(const PlainTracer&) = delete;
  PlainTracer& operator=(const PlainTracer&) = delete;

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

  /// A triangle from which walks start: origin + s u + t v for 0 <= t <= s <= 1.
  struct Source
  {
    PlainScene::Vector origin; ///< the first corner, a little off the surface
    PlainScene::Vector u, v;   ///< from the first corner to the second, from there to the third
    PlainScene::Vector normal; ///< to the front, of unit length
  };

  Source makeSource(const PlainScene::Light& light) const;

  std::vector<PlainScene::Surface>
    surfaces_; ///< one more than triangles: what a ray hits that escapes
  std::size_t numberOfCells_;
  std::vector<Source> sources_;
  AliasTable choice_; ///< of sources, by flux
  float offset_; ///< m, from a surface to the origin of a ray that leaves it, to not hit it again
  RTCDevice device_;
  RTCScene embree_;
  int width_;
};

#endif
