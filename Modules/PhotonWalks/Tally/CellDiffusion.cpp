// SPDX-License-Identifier: BSD-3-Clause
#include "Tally/CellDiffusion.h"

#include <algorithm>
#include <cmath>

namespace irradiance
{

namespace
{

/// How long power diffuses so that a cell draws on `width`; in the unit of areas. A point becomes a
/// Gaussian of the effective area 8 pi t in the time t. The rest comes from squares in a grid, where
/// the area is that of a square / (exp(-x) I0(x))^2, x = 4 t / square, to within a tenth.
double diffusionTime(double area, double width)
{
  return std::max(0.0, std::min(2.2 * (width - area), width + M_PI / 2 * area)) / (8 * M_PI);
}

/// As many as the edges need, except a few between very small cells; and enough to be like a flow
/// without steps.
int chooseSteps(std::vector<double> stepsNeeded)
{
  constexpr double kServed = 0.9, kFewest = 4, kMost = 256;
  if (stepsNeeded.empty())
  {
    return 0;
  }
  const auto served =
    static_cast<std::ptrdiff_t>(kServed * static_cast<double>(stepsNeeded.size() - 1));
  std::nth_element(stepsNeeded.begin(), stepsNeeded.begin() + served, stepsNeeded.end());
  return static_cast<int>(
    std::clamp(std::ceil(stepsNeeded[static_cast<std::size_t>(served)]), kFewest, kMost));
}

}

CellDiffusion::CellDiffusion(const std::vector<double>& areas,
  const std::vector<CellNeighbours>& neighbours, int sides, double width)
{
  struct Flow
  {
    const CellNeighbours* between;
    double whole; // of all steps, as w in the class comment
  };
  std::vector<Flow> flows;
  std::vector<int> degrees(areas.size(), 0);
  for (const CellNeighbours& pair : neighbours)
  {
    const double time = 0.5 *
      (diffusionTime(areas[pair.cells[0]], width) + diffusionTime(areas[pair.cells[1]], width));
    if (time > 0 && pair.conductance > 0) // not NaN, as slivers may have
    {
      flows.push_back({ &pair, time * pair.conductance });
      ++degrees[pair.cells[0]];
      ++degrees[pair.cells[1]];
    }
  }
  constexpr double kMostOfAll = 0.75; // of what is in a cell; its edges share it evenly
  const auto most = [&](const CellNeighbours& pair) {
    return kMostOfAll *
      std::min(areas[pair.cells[0]] / degrees[pair.cells[0]],
        areas[pair.cells[1]] / degrees[pair.cells[1]]);
  };
  std::vector<double> stepsNeeded;
  std::transform(flows.begin(), flows.end(), std::back_inserter(stepsNeeded),
    [&](const Flow& flow) { return flow.whole / most(*flow.between); });
  steps_ = chooseSteps(std::move(stepsNeeded));
  for (const Flow& flow : flows)
  {
    const auto [a, b] = flow.between->cells;
    const double w = std::min(flow.whole / steps_, most(*flow.between));
    for (int side = 0; side < sides; ++side)
    {
      const int other = flow.between->isTurned ? sides - 1 - side : side;
      links_.push_back({ a * static_cast<std::uint32_t>(sides) + static_cast<std::uint32_t>(side),
        b * static_cast<std::uint32_t>(sides) + static_cast<std::uint32_t>(other), w / areas[a],
        w / areas[b] });
    }
  }
}

void CellDiffusion::step(std::vector<std::int64_t>& quanta) const
{
  const std::vector<double> before(quanta.begin(), quanta.end());
  for (const Link& link : links_)
  {
    const auto flow =
      static_cast<std::int64_t>(link.shareOfA * before[link.a] - link.shareOfB * before[link.b]);
    quanta[link.a] -= flow;
    quanta[link.b] += flow;
  }
}

}
