// SPDX-License-Identifier: BSD-3-Clause
#include "Trees/KdEvents.h"

#include <algorithm>
#include <cmath>

namespace irradiance
{

void KdEvents::Sequence::sort()
{
  std::sort(places.begin(), places.end());
  position = 0;
}

void KdEvents::Sequence::lower(float& x) const
{
  if (!isFinished() && places[position] < x)
  {
    x = places[position];
  }
}

/// Passes the events at x and returns their number. No event before x may be left.
std::uint32_t KdEvents::Sequence::pass(float x)
{
  const std::size_t first = position;
  while (!isFinished() && places[position] == x)
  {
    ++position;
  }
  return static_cast<std::uint32_t>(position - first);
}

void KdEvents::clear()
{
  begins_.places.clear();
  ends_.places.clear();
  flats_.places.clear();
}

void KdEvents::sort()
{
  begins_.sort();
  ends_.sort();
  flats_.sort();
}

bool KdEvents::next(Step& step)
{
  if (begins_.isFinished() && ends_.isFinished() && flats_.isFinished())
  {
    return false;
  }
  step.x = HUGE_VALF;
  begins_.lower(step.x);
  ends_.lower(step.x);
  flats_.lower(step.x);
  step.ending = ends_.pass(step.x);
  step.lying = flats_.pass(step.x);
  step.beginning = begins_.pass(step.x);
  return true;
}

}
