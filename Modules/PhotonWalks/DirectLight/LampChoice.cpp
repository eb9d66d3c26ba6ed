// SPDX-License-Identifier: BSD-3-Clause
#include "DirectLight/LampChoice.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace irradiance
{

namespace
{

/// W that a node of lamps would bring to a cell: on average, or else where it is nearest, which no
/// weight should miss.
double powerBetween(
  const LampPieces::Node& node, const CellShape& cell, double curved, bool isMean = false)
{
  const LampPiece& lamp = node.lamp;
  const Vector3 between = cell.center - lamp.center;
  const double size = std::max(lamp.radius, cell.radius);
  // The mean of 1 / distance^2 over what is wide is that of less than the distance of its middle.
  const double squared = std::max(between.squaredNorm() - 0.5 * size * size, size * size);
  if (!(squared > 0))
  {
    return lamp.flux;
  }
  const double inverse = 1 / std::sqrt(squared);
  const double leaving = lamp.normal.dot(between) * inverse;
  const double arriving = cell.normal.dot(between) * inverse;
  // Of flat lamps in one plane, or in planes above each other, and a flat cell: the sine between
  // their normals.
  const bool isFlat = lamp.cone.isFlat() && !(lamp.crossSection > 0) && curved < 1e-9;
  const double parallel = isFlat ? lamp.normal.dot(cell.normal) : 0;
  const double turned = isFlat ? std::sqrt(std::max(0.0, 1 - parallel * parallel)) : 1;
  const double reach = (lamp.radius + cell.radius) * inverse;
  const double facing = cell.isBackDark ? -arriving
    : cell.isFrontDark                  ? arriving
                                        : std::abs(arriving);
  double emitted = lamp.cone.leaving(leaving, isMean ? 0 : std::min(1.0, reach));
  double received = std::clamp(
    curved + (isMean ? positivePart(facing - reach, facing + reach) : facing + reach), 0.0, 1.0);
  if (isFlat)
  {
    // No place is higher over the plane of the other, and none nearer.
    const double nearest = std::max(1 - reach, 0x1p-40);
    emitted =
      std::min(emitted, (leaving + (node.depth + turned * cell.radius) * inverse) / nearest);
    received =
      std::min(received, (facing + (node.depth + turned * lamp.radius) * inverse) / nearest);
  }
  if (lamp.crossSection > 0)
  {
    emitted = LampCone::kProjected * squared / lamp.crossSection;
  }
  if (lamp.distribution && emitted > 0)
  {
    emitted = LampCone::kProjected *
      lamp.distribution->roughIntensity(between.normalized(), lamp.normal, lamp.face);
  }
  if (!(emitted > 0 && received > 0))
  {
    return 0;
  }
  return std::min(lamp.flux,
    lamp.flux * emitted * received * cell.area / LampCone::kProjected * inverse * inverse);
}

}

LampChoice::LampChoice(const LampPieces& lamps, std::size_t most)
  : lamps_(lamps)
  , most_(most)
{
}

/// The spread is what a wide node would bring if all of it were where it is nearest.
LampChoice::Group LampChoice::groupOf(std::uint32_t number) const
{
  const LampPieces::Node& node = lamps_.nodes()[number];
  const double distance = (cell_.center - node.lamp.center).norm(), radius = node.lamp.radius;
  const double nearest = std::max(distance - radius, cell_.radius);
  const double most =
    node.lamp.flux * std::min(1.0, cell_.area / (LampCone::kProjected * nearest * nearest));
  const bool isWide = !node.isLeaf() && radius > kTogether * distance;
  return { number, powerBetween(node, cell_, curved_),
    isWide ? most * std::min(1.0, radius / distance) : 0 };
}

/// Those with the widest spread are halved first.
void LampChoice::setCell(const CellShape& cell)
{
  cell_ = cell;
  curved_ = 1 - std::min(1.0, cell.normal.norm());
  groups_.clear();
  if (lamps_.nodes().size() < 2 * most_)
  {
    for (std::uint32_t node = 0; node < lamps_.nodes().size(); ++node)
    {
      if (lamps_.nodes()[node].isLeaf())
      {
        groups_.push_back(groupOf(node));
      }
    }
    return;
  }
  groups_.push_back(groupOf(0));
  while (groups_.size() < most_ && groups_.front().spread > 0)
  {
    std::pop_heap(groups_.begin(), groups_.end());
    const std::uint32_t children = lamps_.nodes()[groups_.back().node].children;
    groups_.pop_back();
    for (const std::uint32_t child : { children, children + 1 })
    {
      groups_.push_back(groupOf(child));
      std::push_heap(groups_.begin(), groups_.end());
    }
  }
}

double LampChoice::expectedPower(const CellShape& cell)
{
  setCell(cell);
  return std::accumulate(
    groups_.begin(), groups_.end(), 0.0, [this](double sum, const Group& group) {
      return sum + powerBetween(lamps_.nodes()[group.node], cell_, curved_, true);
    });
}

double LampChoice::powerFromWithin(double distance) const
{
  return std::accumulate(groups_.begin(), groups_.end(), 0.0, [&](double sum, const Group& group) {
    const LampPiece& lamp = lamps_.nodes()[group.node].lamp;
    const bool isWithin = lamp.radius < distance && (cell_.center - lamp.center).norm() < distance;
    return sum + (isWithin ? group.power : 0);
  });
}

double LampChoice::distance(const CellShape& cell) const
{
  const Box& centers = lamps_.centers();
  return (cell.center - cell.center.cwiseMax(centers.lower).cwiseMin(centers.upper)).norm();
}

double LampChoice::mostPower(const CellShape& cell) const
{
  if (!lamps_.arePlain())
  {
    return kInfinity; // a beam may be as bright as it likes
  }
  const double between = distance(cell);
  return lamps_.flux() * cell.area / (LampCone::kProjected * between * between);
}

void LampChoice::weigh(const CellShape& cell)
{
  setCell(cell);
  const double expected = std::accumulate(groups_.begin(), groups_.end(), 0.0,
    [](double sum, const Group& group) { return sum + group.power; });
  // In the order of the tree, so that samples that are near each other ask lamps that are.
  std::sort(groups_.begin(), groups_.end(), [&](const Group& a, const Group& b) {
    return lamps_.nodes()[a.node].first < lamps_.nodes()[b.node].first;
  });
  const double byPower = expected > 0 ? (1 - kByFlux) / expected : 0;
  const double byFlux = (expected > 0 ? kByFlux : 1) / lamps_.flux();
  cumulative_.clear();
  double sum = 0;
  for (const Group& group : groups_)
  {
    sum += byPower * group.power + byFlux * lamps_.nodes()[group.node].lamp.flux;
    cumulative_.push_back(sum);
  }
}

bool LampChoice::isAlike(const LampPieces::Node& node) const
{
  return node.isLeaf() ||
    (node.lamp.cone.cosine >= kAlike &&
      node.lamp.radius * node.lamp.radius <=
        kTogether * kTogether * (cell_.center - node.lamp.center).squaredNorm());
}

double LampChoice::probabilityOfFirst(const LampPieces::Node& node) const
{
  const LampPieces::Node &first = lamps_.nodes()[node.children],
                         &second = lamps_.nodes()[node.children + 1];
  const double byFlux = first.lamp.flux / node.lamp.flux;
  const double ofFirst = powerBetween(first, cell_, curved_);
  const double sum = ofFirst + powerBetween(second, cell_, curved_);
  return sum > 0 ? (1 - kByFluxBelow) * ofFirst / sum + kByFluxBelow * byFlux : byFlux;
}

WeightChoice LampChoice::choose(double sample) const
{
  const WeightChoice chosen = chooseByWeight(cumulative_, sample);
  double probability = chosen.weight / cumulative_.back(), rest = chosen.rest;
  const LampPieces::Node* node = &lamps_.nodes()[groups_[chosen.place].node];
  while (!isAlike(*node))
  {
    const double first = probabilityOfFirst(*node);
    const bool isFirst = choosesFirst(first, rest);
    probability *= isFirst ? first : 1 - first;
    node = &lamps_.nodes()[node->children + (isFirst ? 0 : 1)];
  }
  const WeightChoice below = lamps_.choose(*node, rest);
  return { below.place, probability * below.weight, below.rest };
}

double LampChoice::probabilityOf(std::uint32_t piece) const
{
  const std::uint32_t place = lamps_.placeOf(piece);
  double before = 0;
  for (std::size_t i = 0; i < groups_.size(); ++i)
  {
    const LampPieces::Node* node = &lamps_.nodes()[groups_[i].node];
    if (node->first <= place && place < node->end)
    {
      double probability = (cumulative_[i] - before) / cumulative_.back();
      while (!isAlike(*node))
      {
        const double first = probabilityOfFirst(*node);
        const LampPieces::Node& half = lamps_.nodes()[node->children];
        const bool isFirst = place < half.end;
        probability *= isFirst ? first : 1 - first;
        node = isFirst ? &half : &half + 1;
      }
      return probability * lamps_[piece].flux / node->lamp.flux;
    }
    before = cumulative_[i];
  }
  return 0;
}

}
