// SPDX-License-Identifier: BSD-3-Clause
#include "Repair/WalkVerifier.h"

#include <algorithm>

namespace irradiance
{

/// Segments for which rays are cast in the same way, entry by entry.
struct WalkVerifier::Candidates
{
  std::vector<SegmentRef> segments;
  std::vector<std::size_t> blocks;
  std::vector<Ray> rays;
  std::vector<Hit> old, now;
  std::vector<std::size_t> stale; ///< entries

  void add(const SegmentRef& segment, std::size_t block, const Hit& hit)
  {
    segments.push_back(segment);
    blocks.push_back(block);
    old.push_back(hit);
  }
  void clear()
  {
    segments.clear();
    blocks.clear();
    old.clear();
    now.clear();
    stale.clear();
  }
};

struct WalkVerifier::Suspects
{
  Candidates blocked, lost, touching;
};

void WalkVerifier::find(std::size_t first, std::size_t end,
  const std::vector<const StaleMarks*>& known, std::vector<std::vector<StaleSegment>>& stale) const
{
  static thread_local std::vector<std::uint32_t> points;
  static thread_local Suspects suspects;
  Candidates* const all[] = { &suspects.blocked, &suspects.lost, &suspects.touching };
  for (Candidates* candidates : all)
  {
    candidates->clear();
  }
  for (std::size_t block = first; block < end; ++block)
  {
    scan_.find(history_.block(block), history_.block(std::min(block + 1, end - 1)), points);
    sort(block, points, known.empty() ? nullptr : known[block], suspects);
  }
  for (Candidates* candidates : all)
  {
    candidates->rays.resize(candidates->segments.size());
    tracer_.raysOf(history_, candidates->segments, candidates->rays.data());
    suspects_ += static_cast<std::int64_t>(candidates->rays.size());
  }
  castBlocked(suspects.blocked);
  castLost(suspects.lost);
  castTouching(suspects.touching);
  for (const Candidates* candidates : all)
  {
    for (const std::size_t i : candidates->stale)
    {
      stale[candidates->blocks[i]].push_back({ candidates->segments[i], candidates->rays[i],
        candidates->now[i], candidates->old[i], candidates == &suspects.touching });
    }
  }
  for (std::size_t block = first; block < end; ++block)
  {
    std::vector<StaleSegment>& found = stale[block];
    std::sort(found.begin(), found.end(),
      [](const StaleSegment& a, const StaleSegment& b) { return a.segment < b.segment; });
    found.erase(std::unique(found.begin(), found.end(),
                  [](const StaleSegment& a, const StaleSegment& b) {
                    return a.segment.walk == b.segment.walk;
                  }),
      found.end());
  }
}

/// Decides for each flagged segment of a block how to find out whether it is stale.
void WalkVerifier::sort(std::size_t number, const std::vector<std::uint32_t>& points,
  const StaleMarks* known, Suspects& suspects) const
{
  const WalkBlock& block = history_.block(number);
  // No prefetch waits for another, so many are under way at a time: first the places of the walks,
  // which lead to the hits.
  for (const std::uint32_t point : points)
  {
    block.prefetchPlaceAt(point);
  }
  for (const std::uint32_t point : points)
  {
    if (const auto segment = block.segmentAt(point))
    {
      block.prefetch(*segment);
    }
  }
  std::uint32_t stale = block.endWalk(); // a walk with a segment that is stale for certain
  for (const std::uint32_t point : points)
  {
    const auto segment = block.segmentAt(point);
    if (!segment || segment->walk == stale ||
      // It begins on a moved object, so the segment before it is stale.
      (segment->bounce > 0 && hasMoved(block.hit({ segment->walk, segment->bounce - 1 }).id)) ||
      (known && isStale(*known, *segment)))
    {
      continue;
    }
    const Hit hit = block.hit(*segment);
    const bool isLost = hasMoved(hit.id);
    stale = isLost ? segment->walk : stale;
    Candidates& candidates = tracer_.isTouching(block, *segment, hit) ? suspects.touching
      : isLost                                                        ? suspects.lost
                                                                      : suspects.blocked;
    candidates.add(*segment, number, hit);
  }
}

/// The old hit is not on a moved object. It is valid unless a moved object came in front of it.
void WalkVerifier::castBlocked(Candidates& candidates) const
{
  tracer_.scene().findDistances(
    candidates.rays.data(), candidates.rays.size(), candidates.old.data());
  candidates.now = candidates.old;
  tracer_.scene().castMoved(candidates.rays.data(), candidates.rays.size(), candidates.now.data());
  for (std::size_t i = 0; i < candidates.rays.size(); ++i)
  {
    if (candidates.now[i] != candidates.old[i])
    {
      candidates.now[i] = tracer_.resolveContact(candidates.rays[i], candidates.now[i]);
      candidates.stale.push_back(i);
    }
  }
}

/// Where objects touch, the ray is cast again. The hit may be the same and yet depend on other
/// objects than before: then it is stored again as well.
void WalkVerifier::castTouching(Candidates& candidates) const
{
  const std::size_t count = candidates.rays.size();
  candidates.now.assign(count, {});
  tracer_.cast(candidates.rays.data(), count, candidates.now.data());
  for (std::size_t i = 0; i < count; ++i)
  {
    const Hit &now = candidates.now[i], &old = candidates.old[i];
    const SegmentRef& segment = candidates.segments[i];
    if (now.id != old.id || now.weights != old.weights || hasMoved(now.id) ||
      tracer_.isContact(candidates.rays[i].start, now.id) !=
        history_.blockOf(segment.walk).isContact(segment))
    {
      candidates.stale.push_back(i);
    }
  }
}

/// The object that was hit moved, so the hit is stale even if the same triangle is found again: its
/// normal and the point on it have changed. Static geometry is known to lie behind the old hit.
void WalkVerifier::castLost(Candidates& candidates) const
{
  const Scene& scene = tracer_.scene();
  const std::size_t count = candidates.rays.size();
  candidates.now.assign(count, {});
  scene.castDynamic(candidates.rays.data(), count, candidates.now.data());
  std::vector<Ray> rays; // those that may hit static geometry instead
  std::vector<Hit> hits;
  std::vector<double> from;
  std::vector<std::size_t> which;
  for (std::size_t i = 0; i < count; ++i)
  {
    constexpr std::size_t kAhead = 16;
    if (i + kAhead < count)
    {
      const SegmentRef& later = candidates.segments[i + kAhead];
      history_.blockOf(later.walk).prefetchPoint(later);
    }
    candidates.stale.push_back(i);
    const SegmentRef& segment = candidates.segments[i];
    const WalkBlock& block = history_.blockOf(segment.walk);
    const double clear = std::max(0.0, block.shortestLength(segment) - clearance_);
    Hit& now = candidates.now[i];
    if (now.distance < clear)
    {
      continue;
    }
    if (const Hit* hidden = block.hiddenStaticHit(segment))
    {
      now = isCloser(*hidden, now) ? *hidden : now;
      continue;
    }
    rays.push_back(candidates.rays[i]);
    hits.push_back(now);
    from.push_back(clear);
    which.push_back(i);
  }
  scene.castStatic(rays.data(), rays.size(), hits.data(), from.data());
  for (std::size_t i = 0; i < which.size(); ++i)
  {
    candidates.now[which[i]] = hits[i];
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    candidates.now[i] = tracer_.resolveContact(candidates.rays[i], candidates.now[i]);
  }
}

}
