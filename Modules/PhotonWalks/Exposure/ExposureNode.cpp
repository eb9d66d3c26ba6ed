// SPDX-License-Identifier: BSD-3-Clause
#include "Exposure/ExposureNode.h"

#include <algorithm>
#include <utility>

namespace irradiance
{

namespace
{

/// How two trapezoids between three times differ from one: a weighted sum of the values at these
/// times.
std::array<double, 3> differenceWeights(double start, double middle, double end)
{
  const double length = end - start, before = middle - start, after = end - middle;
  // As large as the error can be if something appears anywhere between the times.
  const double scale = 0.5 * length * std::max(before / after, after / before);
  return { -scale * after / length, scale, -scale * before / length };
}

}

ExposureNode::ExposureNode(double time, const std::vector<std::vector<Side>>& sides,
  const std::vector<ExposureBlock>& blocks)
  : time_(time)
{
  for (std::size_t i = 0; i < sides.size(); ++i)
  {
    leaves_.push_back({ sides[i] });
    for (const Side& side : sides[i])
    {
      leaves_[i].power += powerOf(side, blocks[i].areas);
    }
  }
}

double ExposureNode::powerOf(const Side& side, const std::vector<double>& areas)
{
  double power = 0;
  for (std::size_t i = 0; i < areas.size() * side.bands; ++i)
  {
    power += areas[i / side.bands] * side.irradiance.get()[i];
  }
  return power;
}

std::vector<IntervalMeasure> ExposureNode::measure(
  const Three& nodes, const std::vector<ExposureBlock>& blocks)
{
  const double start = nodes[0]->time_, middle = nodes[1]->time_, end = nodes[2]->time_;
  const std::array<double, 3> weights = differenceWeights(start, middle, end);
  const std::array<double, 3> parts{ middle - start, end - start, end - middle };
  std::vector<IntervalMeasure> measures(blocks.size());
  for (std::size_t leaf = 0; leaf < blocks.size(); ++leaf)
  {
    std::size_t sides = 0;
    for (std::size_t node = 0; node < nodes.size(); ++node)
    {
      measures[leaf].energy += 0.5 * parts[node] * nodes[node]->leaves_[leaf].power;
      sides = std::max(sides, nodes[node]->leaves_[leaf].sides.size());
    }
    for (std::size_t side = 0; side < sides; ++side)
    {
      const NoisyDifference difference =
        differenceOf(nodes, weights, leaf, side, blocks[leaf].areas);
      measures[leaf].error += difference.signal;
      measures[leaf].noise += difference.noise;
    }
  }
  return measures;
}

NoisyDifference ExposureNode::differenceOf(const Three& nodes, const std::array<double, 3>& weights,
  std::size_t leaf, std::size_t side, const std::vector<double>& areas)
{
  std::vector<double> differences, variances;
  for (std::size_t node = 0; node < nodes.size(); ++node)
  {
    if (side >= nodes[node]->leaves_[leaf].sides.size())
    {
      continue; // no cells, so no irradiance
    }
    const Side& values = nodes[node]->leaves_[leaf].sides[side];
    const std::size_t bands = values.bands;
    const double* irradiance = values.irradiance.get();
    const double* photon = values.photon.get();
    differences.resize(areas.size() * bands);
    variances.resize(areas.size() * bands);
    for (std::size_t i = 0; i < areas.size() * bands; ++i)
    {
      const std::size_t value =
        i % bands * areas.size() + i / bands; // bands apart, as cells are neighbours
      const double weight = weights[node] * areas[i / bands];
      differences[value] += weight * irradiance[i];
      // n photons vary by sqrt(n).
      variances[value] += photon ? weight * weight * irradiance[i] * photon[i] : 0;
    }
  }
  return splitDifference(std::move(differences), std::move(variances));
}

}
