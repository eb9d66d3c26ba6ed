// SPDX-License-Identifier: BSD-3-Clause
#include "Estimates/CellDiffusion.h"

#include "Simd/SimdLevel.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "Estimates/CellDiffusion.inl"

namespace irradiance
{

namespace
{

/// How long power diffuses so that a cell draws on `width`; in the unit of areas. A point becomes a
/// Gaussian of the effective area 8 pi t in the time t. The rest comes from squares in a grid,
/// where the area is a square's / (exp(-x) I0(x))^2, x = 4 t / square, to within a tenth.
double diffusionTime(double area, double width)
{
  return std::max(0.0, std::min(2.2 * (width - area), width + kPi / 2 * area)) / (8 * kPi);
}

constexpr int kFewest = 4, kMost = 256; // steps, powers of two

/// The power of two that is not below, within limits.
int powerNotBelow(double number, int most)
{
  int power = kFewest;
  while (power < number && power < most)
  {
    power *= 2;
  }
  return power;
}

/// As many as the edges need, except a few between very small cells; and enough to be like a flow
/// without steps.
int chooseSteps(std::vector<double> stepsNeeded)
{
  constexpr double kServed = 0.9;
  if (stepsNeeded.empty())
  {
    return 0;
  }
  const auto served =
    static_cast<std::ptrdiff_t>(kServed * static_cast<double>(stepsNeeded.size() - 1));
  std::nth_element(stepsNeeded.begin(), stepsNeeded.begin() + served, stepsNeeded.end());
  return powerNotBelow(stepsNeeded[static_cast<std::size_t>(served)], kMost);
}

}

struct CellDiffusion::Flow
{
  const CellNeighbours* between;
  double whole; ///< of all steps, as w in the class comment
  double most;  ///< of a step
};

std::vector<CellDiffusion::Flow> CellDiffusion::flowsBetween(
  const std::vector<double>& areas, const std::vector<CellNeighbours>& neighbours, double width)
{
  std::vector<Flow> flows;
  std::vector<int> degrees(areas.size(), 0);
  for (const CellNeighbours& pair : neighbours)
  {
    const double time = 0.5 *
      (diffusionTime(areas[pair.cells[0]], width) + diffusionTime(areas[pair.cells[1]], width));
    if (time > 0 && pair.conductance > 0) // not NaN, as slivers may have
    {
      flows.push_back({ &pair, time * pair.conductance, 0 });
      ++degrees[pair.cells[0]];
      ++degrees[pair.cells[1]];
    }
  }
  constexpr double kMostOfAll = 0.75; // of what is in a cell; its edges share it evenly
  for (Flow& flow : flows)
  {
    const auto [a, b] = flow.between->cells;
    flow.most = kMostOfAll * std::min(areas[a] / degrees[a], areas[b] / degrees[b]);
  }
  return flows;
}

CellDiffusion::CellDiffusion(const std::vector<double>& areas,
  const std::vector<CellNeighbours>& neighbours, int sides, double width)
{
  const std::vector<Flow> flows = flowsBetween(areas, neighbours, width);
  std::vector<double> stepsNeeded;
  std::transform(flows.begin(), flows.end(), std::back_inserter(stepsNeeded),
    [](const Flow& flow) { return flow.whole / flow.most; });
  steps_ = chooseSteps(stepsNeeded);
  std::vector<Link> links;
  std::vector<int> periods;
  for (std::size_t i = 0; i < flows.size(); ++i)
  {
    const CellNeighbours& between = *flows[i].between;
    const auto [a, b] = between.cells;
    const int taken = powerNotBelow(stepsNeeded[i], steps_);
    const double w = std::min(flows[i].whole / taken, flows[i].most);
    for (int side = 0; side < sides; ++side)
    {
      const int other = between.isTurned ? sides - 1 - side : side;
      links.push_back({ a * static_cast<std::uint32_t>(sides) + static_cast<std::uint32_t>(side),
        b * static_cast<std::uint32_t>(sides) + static_cast<std::uint32_t>(other), w / areas[a],
        w / areas[b] });
      periods.push_back(steps_ / taken);
    }
  }
  place(std::move(links), periods, areas.size() * static_cast<std::size_t>(sides));
}

/// Sorts links and nodes by period, so that what takes part in a step stands in a row.
void CellDiffusion::place(
  std::vector<Link> links, const std::vector<int>& periods, std::size_t nodes)
{
  if (links.empty())
  {
    return;
  }
  const int never = 2 * steps_;
  std::vector<int> periodsOfNodes(nodes, never);
  for (std::size_t i = 0; i < links.size(); ++i)
  {
    for (const std::uint32_t node : { links[i].a, links[i].b })
    {
      periodsOfNodes[node] = std::min(periodsOfNodes[node], periods[i]);
    }
  }
  std::vector<std::uint32_t> order(nodes);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
    [&](std::uint32_t i, std::uint32_t j) { return periodsOfNodes[i] < periodsOfNodes[j]; });
  places_.resize(nodes);
  for (std::uint32_t place = 0; place < nodes; ++place)
  {
    places_[order[place]] = place;
  }
  std::vector<std::tuple<int, std::uint32_t, std::uint32_t, std::size_t>> sorted;
  for (std::size_t i = 0; i < links.size(); ++i)
  {
    Link& link = links[i];
    link = { places_[link.a], places_[link.b], link.shareOfA, link.shareOfB };
    sorted.emplace_back(periods[i], std::min(link.a, link.b), std::max(link.a, link.b), i);
  }
  std::sort(sorted.begin(), sorted.end());
  std::transform(sorted.begin(), sorted.end(), std::back_inserter(links_),
    [&](const auto& key) { return links[std::get<3>(key)]; });
  for (int period = 1; period <= steps_ / kFewest; period *= 2)
  {
    linkEnds_.push_back(static_cast<std::size_t>(
      std::count_if(periods.begin(), periods.end(), [&](int other) { return other <= period; })));
    placeEnds_.push_back(static_cast<std::size_t>(std::count_if(
      periodsOfNodes.begin(), periodsOfNodes.end(), [&](int other) { return other <= period; })));
  }
}

void CellDiffusion::step(
  int number, unsigned fields, std::vector<double>& quanta, std::vector<double>& before) const
{
  std::size_t level = 0; // the steps of the period 2^level
  while (level + 1 < linkEnds_.size() && (number + 1) % (2 << level) == 0)
  {
    ++level;
  }
  before.resize(quanta.size());
  std::copy_n(quanta.begin(), placeEnds_[level] * fields, before.begin());
#ifdef __x86_64__
  if (simdLevel() != SimdLevel::Plain)
  {
    flowAvx2(links_.data(), linkEnds_[level], fields, before.data(), quanta.data());
    return;
  }
#endif
  flowBy<double>(links_.data(), linkEnds_[level], fields, before.data(), quanta.data());
}

}
