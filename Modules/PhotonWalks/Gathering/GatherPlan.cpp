// SPDX-License-Identifier: BSD-3-Clause
#include "Gathering/GatherPlan.h"

#include <stdexcept>

namespace irradiance
{

GatherPlan::GatherPlan(const CellShapes& cells, const LampPieces& lamps, const Settings& settings,
  const CancelPoint& cancelPoint)
  : replicates_(settings.replicates)
{
  LampChoice choice(lamps);
  const double samplesPerWatt = settings.walks / (lamps.lights().flux() * settings.walksPerSample);
  firsts_ = { 0 };
  ThrottledCancelPoint pace(cancelPoint);
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
  {
    const CellShape& shape = cells[cell];
    const bool isDark = shape.isFrontDark && shape.isBackDark;
    std::uint32_t samples = shape.area > 0 && !isDark ? numberFor(0) : 0;
    if (samples > 0 && numberFor(choice.mostPower(shape) * samplesPerWatt) > samples)
    {
      samples = numberFor(choice.expectedPower(shape) * samplesPerWatt);
    }
    if (firsts_.back() + samples < firsts_.back())
    {
      throw std::length_error("there are more cells than can gather direct light");
    }
    firsts_.push_back(firsts_.back() + samples);
    pace.step();
  }
}

std::uint32_t GatherPlan::numberFor(double samples) const
{
  std::uint32_t number = replicates_;
  while (number < kFewest || (number < samples && number < kMost))
  {
    number *= 2;
  }
  return number;
}

}
