// SPDX-License-Identifier: BSD-3-Clause
#include "Gathering/GatherPlan.h"

#include <stdexcept>

namespace irradiance
{

GatherPlan::GatherPlan(const CellShapes& cells, const LampPieces& lamps, std::uint32_t walks,
  std::uint32_t replicates, const CancelPoint& cancelPoint)
  : replicates_(replicates)
{
  LampChoice choice(lamps);
  const double walksPerWatt = walks / lamps.lights().flux();
  firsts_ = { 0 };
  ThrottledCancelPoint pace(cancelPoint);
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
  {
    std::uint32_t samples = cells[cell].area > 0 ? numberFor(0) : 0;
    if (samples > 0 && numberFor(choice.mostPower(cells[cell]) * walksPerWatt) > samples)
    {
      samples = numberFor(choice.expectedPower(cells[cell]) * walksPerWatt);
    }
    if (firsts_.back() + samples < firsts_.back())
    {
      throw std::length_error("there are more cells than can gather direct light");
    }
    firsts_.push_back(firsts_.back() + samples);
    pace.step();
  }
}

std::uint32_t GatherPlan::numberFor(double walks) const
{
  std::uint32_t samples = replicates_;
  while (samples < kFewest || (samples < walks / kWalksPerSample && samples < kMost))
  {
    samples *= 2;
  }
  return samples;
}

}
