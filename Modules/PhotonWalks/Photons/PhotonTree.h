// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "History/WalkHistory.h"
#include "Simd/Prefetch.h"
#include "Trees/LeafQuery.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

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
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          position_[axis][lane] = photon.position[axis];
        }
        walk_[lane] = photon.walk;
        bounceAndSide_[lane] = photon.bounceAndSide;
        triangle_[lane] = photon.triangle;
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

  float position_[3][kSize];
  std::uint32_t walk_[kSize];
  std::uint32_t bounceAndSide_[kSize];
  std::uint32_t triangle_[kSize];
};

/**
 * The photons of one leaf of a triangle tree, in a kd-tree of their own whose ends are packs. A
 * leaf may hold a million. A full pack is cut in two; all is built again when the packs have become
 * too empty, or the planes too many in a row. The photons are a set: how they are cut depends on
 * what came and went before, what a search finds does not.
 */
class PhotonTree
{
public:
  std::size_t size() const { return size_; }
  /// In any order.
  std::vector<LeafPhoton> photons() const;
  std::size_t bytes() const
  {
    return nodes_.capacity() * sizeof(Node) + packs_.capacity() * sizeof(PhotonPack);
  }

  /// All photons leave; the memory stays.
  void empty()
  {
    nodes_.clear();
    packs_.clear();
    size_ = 0;
  }
  /// Photons leave, placed as they were when they arrived, then others arrive. False if one that is
  /// to leave is not here.
  bool change(const std::vector<LeafPhoton>& gone, const std::vector<LeafPhoton>& arrived);

  /// Calls visit(pack) for all packs that may hold photons within some distance of a point, those
  /// nearby first. squaredLimit() is that distance, squared, in the unit frame; it may shrink from
  /// one pack to the next. Rounding errors are up to the caller: 2^-22 of the squares.
  template <class Limit, class Visit>
  void visitNear(const UnitPoint& point, const Limit& squaredLimit, const Visit& visit) const
  {
    if (size_ == 0)
    {
      return;
    }
    struct Pending
    {
      std::size_t node;
      std::array<float, 3> outside; ///< how far the point lies outside of the node's cell

      float squaredDistance() const
      {
        return outside[0] * outside[0] + outside[1] * outside[1] + outside[2] * outside[2];
      }
    };
    std::array<Pending, kDeepest + 1> pending;
    std::size_t count = 0;
    pending[count++] = { 0, {} };
    while (count > 0)
    {
      Pending at = pending[--count];
      if (at.squaredDistance() > squaredLimit())
      {
        continue;
      }
      while (!nodes_[at.node].isEnd())
      {
        const Node& node = nodes_[at.node];
        const float beyond = point[node.axis()] - node.value;
        const std::size_t isRight = beyond < 0 ? 0 : 1;
        Pending& far = pending[count++] = at;
        far.node = node.first() + 1 - isRight;
        far.outside[node.axis()] = beyond;
        at.node = node.first() + isRight;
      }
      const Node& end = nodes_[at.node];
      for (std::size_t i = 0; i < end.packs(); ++i)
      {
        visit(packs_[end.first() + i]);
      }
    }
  }

private:
  static constexpr int kDeepest = 64; ///< planes in a row
  static constexpr std::size_t kNoPack = ~std::size_t{};

  /// A plane with the nodes on its two sides, the right one behind the left one; or an end with its
  /// packs, which are several only if all photons were in one place, or they are few.
  struct Node
  {
    static constexpr std::uint32_t kEnd = 3;

    float value = 0;           ///< where the plane is; at an end the number of packs
    std::uint32_t link = kEnd; ///< the axis, or kEnd; above two bits the left node, or first pack

    bool isEnd() const { return (link & kEnd) == kEnd; }
    std::size_t axis() const { return link & kEnd; }
    std::size_t first() const { return link >> 2; }
    std::size_t packs() const { return static_cast<std::size_t>(value); }
  };
  using Photons = std::vector<LeafPhoton>;

  /// A node, and the number of planes above it.
  struct Place
  {
    std::size_t node = 0;
    int depth = 0;
  };

  /// The end where a photon belongs, below a node where it belongs.
  Place endOf(const LeafPhoton& photon, Place place) const;
  /// The ends where photons belong. Calls prefetch(pack) for the first pack of each.
  template <class Prefetch>
  std::vector<Place> endsOf(const Photons& photons, const Prefetch& prefetch) const;
  /// Returns the number of planes above the deepest.
  int insert(const Photons& photons);
  bool remove(const Photons& photons);
  Photons photonsExcept(const Photons& gone) const;
  void addTo(Photons& photons, const Node& end) const;
  /// Calls take(pack) for the packs of an end until one returns true; false if none does.
  template <class Take>
  bool anyPack(const Node& end, const Take& take)
  {
    PhotonPack* const first = packs_.data() + end.first();
    return std::any_of(first, first + end.packs(), take);
  }
  /// From nothing.
  void build(Photons photons);
  /// `spare`: a pack that is free to be used, or kNoPack.
  void build(std::size_t node, Photons::iterator begin, Photons::iterator end, std::size_t& spare);
  void makeEnd(
    std::size_t node, Photons::const_iterator begin, std::size_t size, std::size_t& spare);

  std::vector<Node> nodes_; ///< the root comes first
  std::vector<PhotonPack> packs_;
  std::size_t size_ = 0;
};

}
