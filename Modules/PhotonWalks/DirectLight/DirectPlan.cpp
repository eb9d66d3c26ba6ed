// SPDX-License-Identifier: BSD-3-Clause
#include "DirectLight/DirectPlan.h"

#include <stdexcept>

namespace irradiance
{

namespace
{

bool mayBeLit(const CellShape& cell)
{
  return cell.area > 0 && !(cell.isFrontDark && cell.isBackDark);
}

}

DirectPlan::DirectPlan(const CellShapes& cells, const LampPieces& lamps, const Settings& settings,
  const CancelPoint& cancelPoint)
  : replicates_(settings.replicates)
  , walksPerSample_(settings.walksPerSample)
  , fewest_(settings.fewest)
{
  LampChoice choice(lamps);
  fewest_.small = fewestOfSmall(cells, settings);
  const double walksPerWatt = settings.walks / lamps.lights().flux();
  firsts_ = { 0 };
  ThrottledCancelPoint pace(cancelPoint);
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
  {
    const CellShape& shape = cells[cell];
    const double mirrored = settings.startsPerWalk * shape.mirrored;
    std::uint32_t samples = mayBeLit(shape) ? numberFor(0) : 0;
    if (samples > 0 && numberFor(choice.mostPower(shape) * walksPerWatt, mirrored) > samples)
    {
      samples = numberFor(choice.expectedPower(shape) * walksPerWatt, mirrored);
    }
    if (firsts_.back() + samples < firsts_.back())
    {
      throw std::length_error("there are more cells than can gather direct light");
    }
    firsts_.push_back(firsts_.back() + samples);
    pace.step();
  }
}

/// Few cells have more, for a share of what the walks take: else the edges of shadows are the
/// larger noise of small cells.
std::uint32_t DirectPlan::fewestOfSmall(const CellShapes& cells, const Settings& settings)
{
  constexpr double kSamplesOfWalk = 0.25;
  double lit = 0;
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
  {
    lit += mayBeLit(cells[cell]) ? 1 : 0;
  }
  const FewestSamples& usual = settings.fewest;
  const double share =
    std::min<double>(usual.mostOfSmall, kSamplesOfWalk * settings.walks / std::max(1.0, lit));
  std::uint32_t fewest = usual.small;
  while (2.0 * fewest <= share)
  {
    fewest *= 2;
  }
  return fewest;
}

std::uint32_t DirectPlan::numberFor(double walks, double mirrored) const
{
  const bool isLarge = walks >= 4.0 * fewest_.small;
  const double usual =
    std::max<double>(isLarge ? fewest_.large : fewest_.small, walks / walksPerSample_);
  // A mirror throws all walks of a sample the same way: so each has a sample of its own.
  const double ofMirror = mirrored > 0 ? std::min(walks * mirrored, kMostOfMirror) : 0;
  const double samples = std::max(std::min(usual, kMost), ofMirror);
  std::uint32_t number = replicates_;
  while (number < samples)
  {
    number *= 2;
  }
  return number;
}

}
