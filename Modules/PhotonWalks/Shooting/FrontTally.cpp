// SPDX-License-Identifier: BSD-3-Clause
#include "Shooting/FrontTally.h"

#include "Shooting/FrontLoops.h"

#include <algorithm>

namespace irradiance
{

FrontTally::FrontTally(const SceneTriangles& triangles, CellSums& sums, PowerBalance& balance,
  const Power& photon, std::size_t expected)
  : triangles_(triangles)
  , sums_(sums)
  , balance_(balance)
  , photon_(photon)
  , counts_(sums, photon[0], sums.bands() == 1 ? expected : 0)
{
}

Power FrontTally::powerOf(const WalkFront& front) const
{
  if (sums_.bands() == 1)
  {
    return static_cast<std::int64_t>(front.size) * photon_;
  }
  Power all;
  for (int band = 0; band < sums_.bands(); ++band)
  {
    for (std::size_t i = 0; i < front.size; ++i)
    {
      all[band] += front.power[band][i];
    }
  }
  return all;
}

void FrontTally::change(const WalkFront& front, int sign)
{
  const Replicates& replicates = sums_.plan().replicates();
  const auto perCell = static_cast<std::uint32_t>(sums_.slotsPerCell());
  for (std::size_t first = 0; first < front.size; first += kTogether)
  {
    const std::size_t end = std::min(first + kTogether, front.size);
    frontLoops().findSlots({ SceneRows(triangles_), front, first, end, perCell, perCell / 2,
      static_cast<std::uint32_t>(sums_.bands()), replicates.count(), replicates.firstWalk(),
      counts_.escaped(), slots_ });
    for (std::size_t i = first; sums_.rounds() > 1 && i < end; ++i) // each has sums of its own
    {
      if (front.hit[i] != WalkFront::kNone)
      {
        slots_[i - first] +=
          static_cast<std::uint32_t>(sums_.plan().roundOf(front.walk[i]) * sums_.slotsPerRound());
      }
    }
    sums_.bands() == 1 ? changePhotons(front, first, end, sign)
                       : changePowers(front, first, end, sign);
  }
  balance_.segments += sign * static_cast<std::int64_t>(front.size);
}

void FrontTally::changePhotons(const WalkFront& front, std::size_t first, std::size_t end, int sign)
{
  const std::size_t count = end - first;
  counts_.add(slots_, count, sign);
  const auto escaped = static_cast<std::int64_t>(
    std::count(front.hit.data() + first, front.hit.data() + end, WalkFront::kNone));
  const Power received = sign * (static_cast<std::int64_t>(count) - escaped) * photon_;
  balance_.escaped += sign * escaped * photon_;
  balance_.absorbed += received;
  balance_.received += received.total();
}

void FrontTally::changePowers(const WalkFront& front, std::size_t first, std::size_t end, int sign)
{
  for (std::size_t i = first; i < end; ++i)
  {
    const Power carried = front.powerAt(i, sums_.bands()), added = sign * carried;
    if (front.hit[i] == WalkFront::kNone)
    {
      balance_.escaped += added;
      continue;
    }
    sums_.collect(slots_[i - first], true, carried, sign, deposits_); // the side is in the slot
    balance_.absorbed += added;
    balance_.received += added.total();
  }
}

}
