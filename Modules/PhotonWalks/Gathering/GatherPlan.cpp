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
  // The fourth is soon worth its time: a net of two knows little of a shadow.
  constexpr double kWalksOfFour = 24;
  std::uint32_t samples = replicates_;
  const double wanted = std::max(walks / kWalksPerSample, walks > kWalksOfFour ? 4.0 : 0.0);
  while (samples < kFewest || (samples < wanted && samples < kMost))
  {
    samples *= 2;
  }
  return samples;
}

}
