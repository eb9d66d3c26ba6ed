#ifndef irradiance_WalkHistory_h
#define irradiance_WalkHistory_h

#include "Power.h"
#include "Ray.h"

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace irradiance
{

/// One straight piece of a walk, and the hit that ends it; the last of a walk may escape.
struct WalkSegment
{
  Vector3 origin;
  Vector3 direction; ///< unit vector
  Hit hit;
};

/// A walk, or its tail, while it is being shot.
class WalkTrace
{
public:
  void clear()
  {
    segments_.clear();
    powers_.clear();
    fronts_.clear();
  }
  void add(const WalkSegment& segment, const Power& power, bool isFront)
  {
    segments_.push_back(segment);
    powers_.push_back(power);
    fronts_.push_back(isFront);
  }
  std::uint32_t size() const { return static_cast<std::uint32_t>(segments_.size()); }
  const WalkSegment& segment(std::uint32_t i) const { return segments_[i]; }
  /// What the segment carries to its hit.
  const Power& power(std::uint32_t i) const { return powers_[i]; }
  bool isFront(std::uint32_t i) const { return fronts_[i] != 0; }

private:
  std::vector<WalkSegment> segments_;
  std::vector<Power> powers_;
  std::vector<char> fronts_;
};

/**
 * The stored walks of a run of consecutive walk numbers, at most kWalks: the unit of work of a
 * thread. Walks stand in pools one after the other; one that outgrows its place moves to the end,
 * and the holes are closed when they make up a third of the pool.
 */
class WalkBlock
{
public:
  static constexpr std::uint32_t kWalks = 1024;

  /// What of a segment is stored depends on what the scene needs: `bands` powers, and the side that
  /// was hit only `withSides`.
  WalkBlock(std::uint32_t numberOfWalks, int bands, bool withSides);

  std::uint32_t numberOfWalks() const { return static_cast<std::uint32_t>(places_.size()); }
  std::uint32_t size(std::uint32_t walk) const { return places_[walk].size; }
  const WalkSegment& segment(std::uint32_t walk, std::uint32_t bounce) const
  {
    return segments_[places_[walk].first + bounce];
  }
  Power power(std::uint32_t walk, std::uint32_t bounce) const;
  bool isFront(std::uint32_t walk, std::uint32_t bounce) const
  {
    return fronts_.empty() || fronts_[places_[walk].first + bounce] != 0;
  }

  /// Puts `tail` in the place of the segments from `bounce` on. Cached static hits behind `bounce`
  /// go with the segments.
  void replaceTail(std::uint32_t walk, std::uint32_t bounce, const WalkTrace& tail);

  /// The static hit that a dynamic object hides from the segment; null if not known.
  const Hit* hiddenStaticHit(std::uint32_t walk, std::uint32_t bounce) const;
  void rememberStaticHit(std::uint32_t walk, std::uint32_t bounce, const Hit& hit);
  void forgetStaticHit(std::uint32_t walk, std::uint32_t bounce);
  void forgetAllStaticHits() { staticHits_.clear(); }

  /// Memory held, the unused part of the pools included.
  std::size_t bytes() const;
  /// Gives back what the pools do not use.
  void shrink();

private:
  struct Place
  {
    std::uint32_t first = 0;
    std::uint32_t size = 0;
    std::uint32_t capacity = 0;
  };

  static std::uint64_t key(std::uint32_t walk, std::uint32_t bounce)
  {
    return std::uint64_t{ walk } << 32 | bounce;
  }
  void moveToEnd(std::uint32_t walk, std::uint32_t kept, std::uint32_t capacity);
  void closeHoles();
  void resizePools(std::size_t size);
  void copySegments(
    const WalkBlock& from, std::uint32_t source, std::uint32_t target, std::uint32_t count);

  int bands_;
  bool withSides_;
  std::uint32_t unused_ = 0;
  std::vector<Place> places_;
  std::vector<WalkSegment> segments_;
  std::vector<std::int64_t> powers_; ///< bands_ for each segment
  std::vector<char> fronts_;
  std::unordered_map<std::uint64_t, Hit> staticHits_;
};

}

#endif
