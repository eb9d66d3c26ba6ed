// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_StaleFront_h
#define irradiance_StaleFront_h

#include "History/HiddenHits.h"
#include "Shooting/WalkFront.h"

#include <vector>

namespace irradiance
{

/// The first stale segments of walks, block by block, with their rays and their hits in the new
/// frame. Slots and blocks are those in which the old segments are stored.
struct StaleFront
{
  explicit StaleFront(WalkFront& memory)
    : rows(memory)
  {
  }

  WalkFront& rows;
  /// Of each row, if static hits are cached: the one that a dynamic object hides in the new frame.
  std::vector<HiddenHit> hidden;
};

}

#endif
