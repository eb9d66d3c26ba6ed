// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_WalkBlock_h
#define irradiance_WalkBlock_h

#include "Geometry/Ray.h"
#include "Geometry/UnitFrame.h"
#include "History/SegmentRef.h"
#include "Sampling/WalkPlan.h"
#include "Simd/Prefetch.h"
#include "Surfaces/Power.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

namespace irradiance
{

/// A point of a walk, in the frame of its block.
using StoredPoint = std::array<float, 3>;

inline StoredPoint storedPoint(const UnitFrame& frame, const Vector3& world)
{
  const Vector3 point = frame(world);
  return { static_cast<float>(point[0]), static_cast<float>(point[1]),
    static_cast<float>(point[2]) };
}

/// A straight segment of a walk and the hit that ends it, or none if it escapes.
struct StoredSegment
{
  StoredPoint begin;
  TriangleId id;
  std::array<float, 2> weights; ///< see Hit
  bool isFront;   ///< the side that was hit; known if a walk leaves it, else see WalkBatch
  bool isContact; ///< the hit may depend on dynamic objects that touch, see Contacts
};

/**
 * The stored walks of consecutive numbers, at most WalkPlan::kWalksPerBlock; the unit of work of a
 * thread. A block stores what cannot be computed again: the triangle hit, its side, the point on it
 * and the power. Rays and distances follow from these (WalkTracer::raysOf, Scene::distanceTo). The
 * points of a walk are also kept as floats, to be scanned for segments near moved objects.
 *
 * Walks lie one after the other in two kinds of pools: of hits, one for each segment, and of points,
 * one more for each walk: point i is where segment i begins, the last one where the walk ends. A walk
 * that outgrows its room moves to the end of the pools. The holes are closed when they make up a
 * third.
 */
class WalkBlock
{
public:
  /// An escaped segment ends this far from where it begins, in the frame of the points.
  static constexpr double kFar = 0x1p24;

  /// `frame`: of the points. `power`: of all segments, if there is one band; several have
  /// a power for each segment.
  WalkBlock(std::uint32_t firstWalk, std::uint32_t numberOfWalks, int bands, const UnitFrame& frame,
    const Power& power);

  std::uint32_t firstWalk() const { return firstWalk_; }
  std::uint32_t endWalk() const { return firstWalk_ + numberOfWalks(); }
  std::uint32_t numberOfWalks() const { return static_cast<std::uint32_t>(places_.size()); }
  /// The number of segments of a walk.
  std::uint32_t size(std::uint32_t walk) const { return rangeOf(walk).size; }
  /// The hit without its distance.
  Hit hit(const SegmentRef& segment) const;
  bool isFront(const SegmentRef& segment) const { return (tags_[pointOf(segment)] & kBack) == 0; }
  Power power(const SegmentRef& segment) const;
  /// Lower bound of a segment's length in the world, too short by some 2^-20 of its coordinates.
  double shortestLength(const SegmentRef& segment) const;

  /// Gives each walk of an empty block room for that many segments.
  void makeRoom(const std::vector<std::uint32_t>& sizes);
  /// Replaces the segments of a walk from `first` on by room for `count` new ones, each of which must
  /// then be set. Drops the cached static hits of segments after `first`.
  void replaceTail(const SegmentRef& first, std::uint32_t count);
  void setSegment(const SegmentRef& place, const StoredSegment& segment);
  void setEnd(std::uint32_t walk, const StoredPoint& end);
  void setSide(const SegmentRef& segment, bool isFront)
  {
    std::uint16_t& tag = tags_[pointOf(segment)];
    tag = static_cast<std::uint16_t>(isFront ? tag & ~kBack : tag | kBack);
  }
  /// Only if there are several bands.
  void setPower(const SegmentRef& segment, const Power& power);

  /// The static hit that a dynamic object hides from the segment; null if not known.
  const Hit* hiddenStaticHit(const SegmentRef& segment) const;
  /// To be called when another hit ends the segment. With `isCached`, a static hit that becomes
  /// hidden is kept while a dynamic object hides it (section 3.3 of the paper).
  void updateStaticHit(const SegmentRef& segment, const Hit& old, const Hit& now, bool isCached);
  void forgetAllStaticHits() { staticHits_.clear(); }

  /// The pools as a scan reads them, holes included. From point i to point i + 1 runs a segment or
  /// nothing; segmentAt() tells which.
  std::size_t numberOfPoints() const { return x_.size(); }
  const float* x() const { return x_.data(); }
  const float* y() const { return y_.data(); }
  const float* z() const { return z_.data(); }
  const std::uint16_t* tags() const { return tags_.data(); }
  /// The number in a tag that stands for the object that the segment hits: 0 for the static one and
  /// for escapes. Several dynamic objects may share a number.
  static unsigned tagOf(std::uint32_t object)
  {
    return object == 0 || object == TriangleId::kNone ? 0 : 1 + (object - 1) % (kContactTag - 1);
  }
  static constexpr unsigned kContactTag = 31; ///< replaces the number for contacts
  static constexpr unsigned kTagShift = 11;   ///< position of the number in a tag
  bool isContact(const SegmentRef& segment) const
  {
    return tags_[pointOf(segment)] >> kTagShift == kContactTag;
  }

  /// Prefetches where a walk lies; what follows reads that.
  void prefetchPlace(std::uint32_t walk) const { prefetchLine(&rangeOf(walk)); }
  void prefetchPlaceAt(std::size_t point) const
  {
    prefetchLine(&places_[tags_[point] & kWalkMask]);
  }
  /// Prefetches the hit of a segment.
  void prefetch(const SegmentRef& segment) const
  {
    const std::size_t hit = hitOf(segment);
    prefetchLine(ids_.data() + hit);
    prefetchLine(weights_.data() + hit);
  }
  /// Prefetches where a segment begins.
  void prefetchPoint(const SegmentRef& segment) const
  {
    const std::size_t point = pointOf(segment);
    prefetchLine(x_.data() + point);
    prefetchLine(y_.data() + point);
    prefetchLine(z_.data() + point);
    prefetchLine(tags_.data() + point);
  }
  /// The segment that begins at `point`, if one does.
  std::optional<SegmentRef> segmentAt(std::size_t point) const;

  /// Memory held, including the unused part of the pools.
  std::size_t bytes() const;

private:
  struct Range
  {
    std::uint32_t firstPoint = 0, firstHit = 0;
    std::uint32_t size = 0;     ///< segments
    std::uint32_t capacity = 0; ///< segments; a walk without room has no place for a point either
    std::uint32_t points() const { return capacity == 0 ? 0 : capacity + 1; }
  };

  // A tag holds the walk, counted from the first, the side of the hit, and tagOf() its object or kContactTag.
  static constexpr std::uint16_t kWalkMask = 0x3ff;
  static constexpr std::uint16_t kBack = 0x400;

  static std::uint64_t key(const SegmentRef& segment)
  {
    return std::uint64_t{ segment.walk } << 32 | segment.bounce;
  }
  const Range& rangeOf(std::uint32_t walk) const { return places_[walk - firstWalk_]; }
  Range& rangeOf(std::uint32_t walk) { return places_[walk - firstWalk_]; }
  std::size_t pointOf(const SegmentRef& segment) const
  {
    return rangeOf(segment.walk).firstPoint + std::size_t{ segment.bounce };
  }
  std::size_t hitOf(const SegmentRef& segment) const
  {
    return rangeOf(segment.walk).firstHit + std::size_t{ segment.bounce };
  }
  Vector3 point(std::size_t i) const { return { x_[i], y_[i], z_[i] }; }
  void setPoint(std::size_t i, const StoredPoint& point);
  /// Moves the segments of a walk before `end` to where there is room for `capacity`.
  void moveToEnd(const SegmentRef& end, std::uint32_t capacity);
  void closeHoles();
  void resizePools(std::size_t points, std::size_t hits);
  /// `count` segments with the point after them, if that has a place.
  void copy(const WalkBlock& from, const Range& source, const Range& target, std::uint32_t count);

  std::uint32_t firstWalk_;
  UnitFrame frame_;
  std::uint32_t unused_ = 0; ///< points that no walk owns
  std::vector<Range> places_;
  std::vector<float> x_, y_, z_;
  std::vector<std::uint16_t> tags_;
  std::vector<TriangleId> ids_;
  std::vector<std::array<float, 2>> weights_;
  Power power_;
  std::size_t storedBands_; ///< powers for each hit: none if they are all the same
  std::vector<std::int64_t> powers_;
  std::unordered_map<std::uint64_t, Hit> staticHits_;
};

}

#endif
