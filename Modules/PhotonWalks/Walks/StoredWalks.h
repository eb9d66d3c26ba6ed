// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_StoredWalks_h
#define irradiance_StoredWalks_h

#include "Walks/WalkSets.h"

#include <algorithm>
#include <deque>
#include <iterator>

namespace irradiance
{

/// Reads the stored walks of all sets in a frame.
class StoredWalks
{
public:
  /// The arguments, and what the space refers to, must outlive it.
  StoredWalks(const WalkSets& sets, const Frame& frame)
  {
    for (const WalkSet& set : sets.sets())
    {
      readers_.emplace_back(set, frame);
    }
  }

  /// The set to which a walk belongs.
  const WalkSet& setOf(std::uint32_t walk) const { return readerOf(walk).set; }
  const WalkHistory& historyOf(std::uint32_t walk) const { return setOf(walk).history(); }
  /// What a walk does where it starts and at its hits.
  const WalkStages& stages(std::uint32_t walk) const { return readerOf(walk).tracer.stages(); }
  /// See StoredRays; segments of any sets.
  void raysOf(const std::vector<SegmentRef>& segments, Ray* rays) const
  {
    StoredRays stored;
    for (auto begin = segments.begin(); begin != segments.end();)
    {
      const Reader& reader = readerOf(begin->walk);
      const auto end = std::find_if(begin, segments.end(),
        [&](const SegmentRef& segment) { return &readerOf(segment.walk) != &reader; });
      stored.find(reader.tracer, reader.set.history(), { begin, end }, rays);
      rays += end - begin;
      begin = end;
    }
  }

private:
  /// Of one set.
  struct Reader
  {
    Reader(const WalkSet& walks, const Frame& frame)
      : set(walks)
      , samples(walks.samples())
      , tracer(walks.tracer(frame, samples))
    {
    }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    const WalkSet& set;
    SobolSequence samples;
    WalkTracer tracer; ///< refers to samples
  };

  const Reader& readerOf(std::uint32_t walk) const
  {
    return *std::find_if(readers_.begin(), std::prev(readers_.end()),
      [walk](const Reader& reader) { return walk < reader.set.plan().endWalk(); });
  }

  std::deque<Reader> readers_;
};

}

#endif
