// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_StoredWalks_h
#define irradiance_StoredWalks_h

#include "Walks/WalkSets.h"

#include <deque>

namespace irradiance
{

/// Reads the stored walks of all sets in a frame.
class StoredWalks
{
public:
  /// The arguments, and what the space refers to, must outlive it.
  StoredWalks(const WalkSets& sets, const WalkSpace& space)
    : histories_(sets.histories())
  {
    for (const WalkSet& set : sets.sets())
    {
      sources_.emplace_back(set, space);
    }
  }

  const WalkHistories& histories() const { return histories_; }
  /// What a walk does where it starts and at its hits.
  const WalkSampler& sampler(std::uint32_t walk) const { return tracer(walk).sampler(); }
  /// See WalkTracer; segments of any sets.
  void raysOf(const std::vector<SegmentRef>& segments, Ray* rays) const
  {
    forEachSet(
      segments, [&](const WalkTracer& tracer, const WalkHistory& history, const auto& some) {
        tracer.raysOf(history, some, rays);
        rays += some.size();
      });
  }
  /// Likewise.
  void arrivalsOf(
    const std::vector<SegmentRef>& segments, SurfacePoint* points, Vector3* directions) const
  {
    forEachSet(
      segments, [&](const WalkTracer& tracer, const WalkHistory& history, const auto& some) {
        tracer.arrivalsOf(history, some, points, directions);
        points += some.size();
        directions += some.size();
      });
  }

private:
  struct Source
  {
    Source(const WalkSet& set, const WalkSpace& space)
      : endWalk(set.plan().endWalk())
      , samples(set.samples())
      , tracer(set.tracer(space, samples))
    {
    }
    Source(const Source&) = delete;
    Source& operator=(const Source&) = delete;

    std::uint32_t endWalk;
    SobolSequence samples;
    WalkTracer tracer; ///< refers to samples
  };

  const WalkTracer& tracer(std::uint32_t walk) const
  {
    return std::find_if(sources_.begin(), std::prev(sources_.end()), [walk](const Source& source) {
      return walk < source.endWalk;
    })->tracer;
  }
  /// Calls visit(tracer, history, segments) for all segments in their order: those of one set together
  /// that follow each other.
  template <class Visit>
  void forEachSet(const std::vector<SegmentRef>& segments, const Visit& visit) const
  {
    for (auto begin = segments.begin(); begin != segments.end();)
    {
      const WalkHistory& history = histories_.of(begin->walk);
      const auto end = std::find_if(begin, segments.end(),
        [&](const SegmentRef& segment) { return &histories_.of(segment.walk) != &history; });
      visit(tracer(begin->walk), history, std::vector<SegmentRef>(begin, end));
      begin = end;
    }
  }

  WalkHistories histories_;
  std::deque<Source> sources_;
};

}

#endif
