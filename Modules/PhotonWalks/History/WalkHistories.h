// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_WalkHistories_h
#define irradiance_WalkHistories_h

#include "History/WalkHistory.h"

#include <utility>
#include <vector>

namespace irradiance
{

/// The histories of all sets of walks, ordered by the numbers of their walks.
class WalkHistories
{
public:
  /// At least one; they must outlive it.
  explicit WalkHistories(std::vector<const WalkHistory*> all)
    : all_(std::move(all))
  {
  }
  /// Of a single set.
  WalkHistories(const WalkHistory& only)
    : all_{ &only }
  {
  }

  const std::vector<const WalkHistory*>& all() const { return all_; }
  /// The history that stores a walk.
  const WalkHistory& of(std::uint32_t walk) const
  {
    std::size_t i = 0;
    while (i + 1 < all_.size() && walk >= all_[i]->plan().endWalk())
    {
      ++i;
    }
    return *all_[i];
  }
  Power power(const SegmentRef& segment) const { return of(segment.walk).power(segment); }
  /// The hit without its distance.
  Hit hit(const SegmentRef& segment) const { return of(segment.walk).hit(segment); }

private:
  std::vector<const WalkHistory*> all_;
};

}

#endif
