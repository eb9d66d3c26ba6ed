// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PhotonPack_h
#define irradiance_PhotonPack_h

#include "History/WalkHistory.h"
#include "Simd/Prefetch.h"
#include "Trees/LeafQuery.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace irradiance
{

/// A photon as a leaf of a tree keeps it.
struct LeafPhoton
{
  UnitPoint position; ///< in the unit frame of the tree
  std::uint32_t walk;
  std::uint32_t bounceAndSide; ///< twice the bounce, and 1 more if it arrived on the back
  std::uint32_t triangle;

  LeafPhoton() = default;
  LeafPhoton(const UnitPoint& at, const SegmentRef& photon, bool isFront, std::uint32_t hit)
    : position(at)
    , walk(photon.walk)
    , bounceAndSide(2 * photon.bounce + (isFront ? 0 : 1))
    , triangle(hit)
  {
  }
  SegmentRef reference() const { return { walk, bounceAndSide >> 1 }; }
  bool isFront() const { return (bounceAndSide & 1) == 0; }
};

/// Up to 16 photons near each other, as columns that a search reads side by side.
class alignas(64) PhotonPack
{
public:
  static constexpr unsigned kSize = 16;

  PhotonPack() { std::fill_n(&position_[0][0], 3 * kSize, kNone); }

  /// NaN in unused lanes, which so pass no test.
  const float* coordinates(unsigned axis) const { return position_[axis]; }
  bool isUsed(unsigned lane) const { return position_[0][lane] == position_[0][lane]; }
  SegmentRef reference(unsigned lane) const { return { walk_[lane], bounceAndSide_[lane] >> 1 }; }
  bool isFront(unsigned lane) const { return (bounceAndSide_[lane] & 1) == 0; }
  std::uint32_t triangle(unsigned lane) const { return triangle_[lane]; }
  LeafPhoton operator[](unsigned lane) const
  {
    return { { position_[0][lane], position_[1][lane], position_[2][lane] }, reference(lane),
      isFront(lane), triangle_[lane] };
  }

  /// False if there is no room.
  bool add(const LeafPhoton& photon)
  {
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      if (!isUsed(lane))
      {
        set(lane, photon);
        return true;
      }
    }
    return false;
  }
  /// False if it is not here.
  bool remove(const SegmentRef& photon)
  {
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      if (walk_[lane] == photon.walk && bounceAndSide_[lane] >> 1 == photon.bounce && isUsed(lane))
      {
        position_[0][lane] = kNone;
        return true;
      }
    }
    return false;
  }

  void prefetch() const
  {
    prefetchForRemoval();
    prefetchLine(position_[1]);
    prefetchLine(position_[2]);
    prefetchLine(triangle_);
  }
  void prefetchForRemoval() const
  {
    prefetchLine(position_[0]);
    prefetchLine(walk_);
    prefetchLine(bounceAndSide_);
  }

private:
  static constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

  void set(unsigned lane, const LeafPhoton& photon)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      position_[axis][lane] = photon.position[axis];
    }
    walk_[lane] = photon.walk;
    bounceAndSide_[lane] = photon.bounceAndSide;
    triangle_[lane] = photon.triangle;
  }

  float position_[3][kSize];
  std::uint32_t walk_[kSize];
  std::uint32_t bounceAndSide_[kSize];
  std::uint32_t triangle_[kSize];
};

}

#endif
