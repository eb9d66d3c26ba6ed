// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "History/WalkHistory.h"
#include "Shooting/WalkStages.h"
#include "Surfaces/Frame.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
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
    const SobolSequence& samples, const Repainted& before)
    : objects_(objects)
    , numbers_(numbers)
    , samples_(samples)
    , before_(before)
  {
    for (std::uint32_t object = 0; object < before.size(); ++object)
    {
      const Material& now = *objects[object].material;
      std::vector<std::uint8_t> changes(now.numberOfCells);
      for (std::size_t cell = 0; before[object] && cell < changes.size(); ++cell)
      {
        changes[cell] = now.actsAs(cell, *before[object], cell) ? 0 : 1;
      }
      isRepainted_.resize(numbers.first(object));
      std::transform(now.cellOfTriangle.begin(), now.cellOfTriangle.end(),
        std::back_inserter(isRepainted_), [&](std::uint32_t cell) { return changes[cell]; });
    }
  }

  bool isEmpty() const { return isRepainted_.empty(); }
  /// Whether the walk leaves the hit of a segment otherwise.
  bool change(const BounceBlock& block, std::uint32_t slot) const
  {
    const std::uint32_t hit = block.triangle(slot);
    return hit < isRepainted_.size() && isRepainted_[hit] != 0 && changeAt(hit, block, slot);
  }

private:
  bool changeAt(std::uint32_t hit, const BounceBlock& block, std::uint32_t slot) const
  {
    const TriangleId id = numbers_.idOf(hit);
    const Material &now = *objects_[id.object].material, &before = *before_[id.object];
    const std::uint32_t cell = now.cellOfTriangle[id.triangle];
    const Power incoming = block.power(slot);
    const double sample =
      samples_.sample(block.walkOf(slot), block.bounceOf(slot) + 1, SampleUse::Survival)[0];
    const Fate is = fateOf(incoming, now, cell, sample),
               was = fateOf(incoming, before, cell, sample);
    return !(is == was) ||
      (is.survives && is.way == Leaving::Specular &&
        now.phongExponent[cell] != before.phongExponent[cell]);
  }

  const SceneObjects& objects_;
  const TriangleNumbers& numbers_;
  const SobolSequence& samples_;
  const Repainted& before_;
  std::vector<std::uint8_t> isRepainted_; ///< by triangle; empty: none is
};

}
