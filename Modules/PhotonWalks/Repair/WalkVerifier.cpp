// SPDX-License-Identifier: BSD-3-Clause
#include "Repair/WalkVerifier.h"

#include <algorithm>
#include <tuple>

namespace irradiance
{

/// Segments of a block, entry by entry.
struct WalkVerifier::Candidates
{
  std::vector<WalkBlock::Place> places;
  std::vector<Ray> rays;
  std::vector<Hit> old;
  std::vector<Hit> now;
  std::vector<StaleSegment> stale;
  bool isTouching = false;

  void addStale(std::size_t i)
  {
    stale.push_back({ places[i].walk, places[i].bounce, rays[i], now[i], old[i], isTouching });
  }
  void clear()
  {
    places.clear();
    rays.clear();
    old.clear();
    now.clear();
  }
};

std::vector<StaleSegment> WalkVerifier::staleSegments(const WalkBlock& block, const WalkBlock& next,
  std::uint32_t firstWalk, const StaleMarks& known) const
{
  static thread_local std::vector<std::uint32_t> points;
  static thread_local Candidates blocked, lost, touching;
  scan_.find(block, next, points);
  blocked.clear();
  lost.clear();
  touching.clear();
  touching.isTouching = true;
  prefetch(block, points);
  for (const std::uint32_t point : points)
  {
    WalkBlock::Place place;
    if (!block.segmentAt(point, place) ||
      (place.bounce > 0 && hasMoved(block.hit(place.walk, place.bounce - 1).id)))
    {
      continue; // it begins on a moved object, so the segment before it is stale
    }
    if (isStale(known, place))
    {
      continue;
    }
    Hit hit = block.hit(place.walk, place.bounce);
    const Ray ray = shooter_.rayOf(block, place.walk, firstWalk + place.walk, place.bounce);
    const bool isTouching = block.isContact(place.walk, place.bounce) ||
      shooter_.isContact(ray.start, hit.id) || shooter_.hasContact(hit.id);
    Candidates& candidates = isTouching ? touching : hasMoved(hit.id) ? lost : blocked;
    if (hit && !hasMoved(hit.id) && !isTouching)
    {
      hit.distance = shooter_.scene().distanceTo(ray, hit.id);
    }
    candidates.places.push_back(place);
    candidates.rays.push_back(ray);
    candidates.old.push_back(hit);
  }
  suspects_ +=
    static_cast<std::int64_t>(blocked.rays.size() + lost.rays.size() + touching.rays.size());
  castBlocked(blocked);
  castLost(block, lost);
  castTouching(block, touching);

  std::vector<StaleSegment> stale;
  stale.swap(blocked.stale);
  for (Candidates* others : { &lost, &touching })
  {
    stale.insert(stale.end(), others->stale.begin(), others->stale.end());
    others->stale.clear();
  }
  const auto order = [](const StaleSegment& s) { return std::tie(s.walkInBlock, s.bounce); };
  std::sort(stale.begin(), stale.end(),
    [&](const StaleSegment& a, const StaleSegment& b) { return order(a) < order(b); });
  stale.erase(
    std::unique(stale.begin(), stale.end(),
      [](const StaleSegment& a, const StaleSegment& b) { return a.walkInBlock == b.walkInBlock; }),
    stale.end());
  return stale;
}

/// Prefetches the hits of the segments and of those before them, then their triangles. None waits
/// for another, so the memory delivers many at a time.
void WalkVerifier::prefetch(const WalkBlock& block, const std::vector<std::uint32_t>& points) const
{
  for (const std::uint32_t point : points)
  {
    block.prefetch(point);
  }
  for (const std::uint32_t point : points)
  {
    WalkBlock::Place place;
    if (block.segmentAt(point, place))
    {
      shooter_.prefetchTriangle(block.hit(place.walk, place.bounce));
      shooter_.prefetchTriangle(place.bounce > 0 ? block.hit(place.walk, place.bounce - 1) : Hit{});
    }
  }
}

/// The old hit is not on a moved object. It is valid unless a moved object came in front of it.
void WalkVerifier::castBlocked(Candidates& candidates) const
{
  candidates.now = candidates.old;
  shooter_.scene().castMoved(candidates.rays.data(), candidates.rays.size(), candidates.now.data());
  for (std::size_t i = 0; i < candidates.rays.size(); ++i)
  {
    if (candidates.now[i] != candidates.old[i])
    {
      candidates.now[i] = shooter_.settled(candidates.rays[i], candidates.now[i]);
      candidates.addStale(i);
    }
  }
}

/// Where objects touch, the ray is cast anew. The hit may be the same and yet depend on other
/// objects than before: then it is stored anew as well.
void WalkVerifier::castTouching(const WalkBlock& block, Candidates& candidates) const
{
  const std::size_t count = candidates.rays.size();
  candidates.now.assign(count, {});
  shooter_.cast(candidates.rays.data(), count, candidates.now.data());
  for (std::size_t i = 0; i < count; ++i)
  {
    const Hit &now = candidates.now[i], &old = candidates.old[i];
    const WalkBlock::Place place = candidates.places[i];
    if (now.id != old.id || now.weights != old.weights || hasMoved(now.id) ||
      shooter_.isContact(candidates.rays[i].start, now.id) !=
        block.isContact(place.walk, place.bounce))
    {
      candidates.addStale(i);
    }
  }
}

/// The object that was hit moved, so the hit is stale even if the same triangle is found again: its
/// normal and the point on it have changed. Static geometry is known to lie behind the old hit.
void WalkVerifier::castLost(const WalkBlock& block, Candidates& candidates) const
{
  const Scene& scene = shooter_.scene();
  const std::size_t count = candidates.rays.size();
  candidates.now.assign(count, {});
  scene.castDynamic(candidates.rays.data(), count, candidates.now.data());
  std::vector<Ray> rays; // those that may hit static geometry instead
  std::vector<Hit> hits;
  std::vector<double> from;
  std::vector<std::size_t> which;
  for (std::size_t i = 0; i < count; ++i)
  {
    const WalkBlock::Place place = candidates.places[i];
    const double clear = std::max(0.0, block.shortestLength(place.walk, place.bounce) - clearance_);
    Hit& now = candidates.now[i];
    if (now.distance < clear)
    {
      continue;
    }
    if (const Hit* hidden = block.hiddenStaticHit(place.walk, place.bounce))
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
    candidates.now[i] = shooter_.settled(candidates.rays[i], candidates.now[i]);
    candidates.addStale(i);
  }
}

}
