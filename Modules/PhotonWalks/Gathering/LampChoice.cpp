// SPDX-License-Identifier: BSD-3-Clause
#include "Gathering/LampChoice.h"

#include "Gathering/WeightChoice.h"
#include "Geometry/Pi.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace irradiance
{

namespace
{

/// W that a lamp would bring to a cell.
double powerBetween(const LampPiece& lamp, const CellShape& cell)
{
  const Vector3 between = cell.center - lamp.center;
  const double leaving = lamp.normal.dot(between), arriving = cell.normal.dot(between);
  const double cosine = lamp.normal.dot(cell.normal), radius = cell.radius;
  const bool isOne = lamp.share > 0; // of several some may be in front of others
  if (isOne && leaving < 0 && leaving * leaving >= radius * radius * (1 - cosine * cosine))
  {
    return 0; // it is behind the lamp, as ceilings are behind their panels
  }
  const double size = std::max(lamp.radius, radius);
  const double squared = std::max(between.squaredNorm(), size * size);
  if (!(squared > 0))
  {
    return lamp.flux;
  }
  const double inverse = 1 / std::sqrt(squared);
  // A part of either may face the other though its center does not.
  const double slack = std::min(1.0, (lamp.radius + radius) * inverse);
  const bool isInAir = lamp.normal.isZero(0);
  const double emitted = isInAir ? 0.25 : std::clamp(leaving * inverse + slack, 0.0, 1.0);
  const double curved = 1 - std::min(1.0, cell.normal.norm()); // normals in all directions
  const double facing = cell.isBackDark ? -arriving
    : cell.isFrontDark                  ? arriving
                                        : std::abs(arriving);
  const double received = std::clamp(facing * inverse + curved + slack, 0.0, 1.0);
  return std::min(lamp.flux, lamp.flux * emitted * received * cell.area / kPi * inverse * inverse);
}

}

LampChoice::LampChoice(const LampPieces& lamps, std::size_t most)
  : tree_(lamps.tree())
  , centers_(lamps.centers())
  , most_(most)
{
}

LampChoice::Group LampChoice::groupOf(std::uint32_t node, const CellShape& cell) const
{
  const LampTree::Node& lamps = tree_.nodes()[node];
  const double power = powerBetween(lamps.lamp, cell);
  const double squared = (cell.center - lamps.lamp.center).squaredNorm();
  const double radius = lamps.lamp.radius * lamps.lamp.radius;
  const bool isWide = !lamps.isLeaf() && radius > kTogether * kTogether * squared;
  return { node, power,
    isWide ? std::max(power, kByFlux * lamps.lamp.flux) * radius / std::max(radius, squared) : 0 };
}

/// Those with the widest spread are halved first.
void LampChoice::findGroups(const CellShape& cell)
{
  if (isFew())
  {
    groups_.clear();
    for (std::uint32_t node = 0; node < tree_.nodes().size(); ++node)
    {
      if (tree_.nodes()[node].isLeaf())
      {
        groups_.push_back(groupOf(node, cell));
      }
    }
    return;
  }
  groups_.assign(1, groupOf(0, cell));
  while (groups_.size() < most_ && groups_.front().spread > 0)
  {
    std::pop_heap(groups_.begin(), groups_.end());
    const std::uint32_t children = tree_.nodes()[groups_.back().node].children;
    groups_.pop_back();
    for (const std::uint32_t child : { children, children + 1 })
    {
      groups_.push_back(groupOf(child, cell));
      std::push_heap(groups_.begin(), groups_.end());
    }
  }
}

double LampChoice::expectedPower(const CellShape& cell)
{
  findGroups(cell);
  return std::accumulate(groups_.begin(), groups_.end(), 0.0,
    [](double sum, const Group& group) { return sum + group.power; });
}

double LampChoice::mostPower(const CellShape& cell) const
{
  const Vector3 nearest = cell.center.cwiseMax(centers_.lower).cwiseMin(centers_.upper);
  return tree_.flux() * cell.area / (kPi * (cell.center - nearest).squaredNorm());
}

void LampChoice::weigh(const CellShape& cell)
{
  const double expected = expectedPower(cell);
  const double byPower = expected > 0 ? (1 - kByFlux) / expected : 0;
  const double byFlux = (expected > 0 ? kByFlux : 1) / tree_.flux();
  cumulative_.clear();
  double sum = 0;
  for (const Group& group : groups_)
  {
    sum += byPower * group.power + byFlux * tree_.nodes()[group.node].lamp.flux;
    cumulative_.push_back(sum);
  }
}

LampChoice::Choice LampChoice::choose(double sample) const
{
  const WeightChoice chosen = chooseByWeight(cumulative_, sample);
  const LampTree::Share share =
    tree_.choose(tree_.nodes()[groups_[chosen.place].node], chosen.rest);
  return { share.piece, chosen.weight / cumulative_.back() * share.probability, share.rest };
}

double LampChoice::probabilityOf(std::uint32_t piece) const
{
  double probability = 0, before = 0;
  for (std::size_t i = 0; i < groups_.size(); ++i)
  {
    const LampTree::Node& node = tree_.nodes()[groups_[i].node];
    probability +=
      (cumulative_[i] - before) / cumulative_.back() * tree_.probabilityOf(node, piece);
    before = cumulative_[i];
  }
  return probability;
}

}
