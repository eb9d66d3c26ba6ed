// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_ChangedReflections_h
#define irradiance_ChangedReflections_h

#include "History/WalkHistory.h"
#include "Shooting/WalkStages.h"
#include "Surfaces/Frame.h"

#include <cstdint>
#include <vector>

namespace irradiance
{

/// Tells which stored segments bring their walks to cells that reflect these otherwise than before.
/// What becomes of a walk at a hit is a pure function of its sample, its power and the cell; so most
/// walks go on as they did, however many hit such cells.
class ChangedReflections
{
public:
  /// `before`: see Frame::repainted. The others must outlive it.
  ChangedReflections(const SceneObjects& objects, const TriangleNumbers& numbers,
    const SobolSequence& samples, const Repainted& before);

  bool isEmpty() const { return isRepainted_.empty(); }
  /// Whether the walk leaves the hit of a segment otherwise. `hit`: the triangle of the segment.
  bool change(const BounceBlock& block, std::uint32_t slot) const
  {
    const std::uint32_t hit = block.triangle(slot);
    return hit < isRepainted_.size() && isRepainted_[hit] != 0 && changeAt(hit, block, slot);
  }

private:
  bool changeAt(std::uint32_t hit, const BounceBlock& block, std::uint32_t slot) const;

  const SceneObjects& objects_;
  const TriangleNumbers& numbers_;
  const SobolSequence& samples_;
  const Repainted& before_;
  std::vector<std::uint8_t> isRepainted_; ///< by triangle; empty: none is
};

}

#endif
