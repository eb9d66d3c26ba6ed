// SPDX-License-Identifier: BSD-3-Clause
#include "BidirectionalTracer.h"

#include <algorithm>

namespace pathtracedroom
{

using namespace irradiance;

BidirectionalTracer::BidirectionalTracer(
  const SceneObjects& objects, const Sensor& sensor, const Config& config)
  : objects_(objects)
  , sensor_(sensor)
  , seed_(config.seed)
  , lamps_(objects)
  , strategies_{ config.isUsed, sensor.sharedEyeVertices(),
    static_cast<double>(sensor.numberOfBins()) }
{
  Box points = lamps_.pointBounds();
  points.add(sensor.pointBounds());
  scene_.setPointSources(points);
  scene_.setTraversalMode(config.traversal);
  scene_.setStatic(objects.staticObject.body);
  scene_.setDynamic(objects.dynamicBodies());
  scene_.commit({});
}

/// Threads take blocks of pairs. Their contributions are added in the order of the blocks, a slice
/// at a time, because a sum of doubles depends on the order.
std::vector<Spectrum> BidirectionalTracer::trace(
  std::uint64_t pass, std::uint32_t samples, Execution& execution) const
{
  constexpr std::size_t kPairsInBlock = 512, kBlocksInSlice = 64;
  using Contributions = std::vector<PathBatch::Contribution>;
  std::vector<Spectrum> bins(sensor_.numberOfBins(), Spectrum::Zero());
  const std::size_t pairs = lamps_.isEmpty() ? 0 : bins.size() * samples;
  const Tracing tracing{ objects_, scene_, lamps_, sensor_, strategies_, seed_ };
  for (std::size_t first = 0; first < pairs; first += kPairsInBlock * kBlocksInSlice)
  {
    const std::size_t blocks =
      std::min(kBlocksInSlice, (pairs - first + kPairsInBlock - 1) / kPairsInBlock);
    std::vector<Contributions> ofBlocks(blocks);
    execution.parallelFor(blocks, [&](std::size_t begin, std::size_t end) {
      PathBatch batch(tracing);
      for (std::size_t block = begin; block < end; ++block)
      {
        const std::size_t pair = first + block * kPairsInBlock;
        batch.trace(pass, pair, std::min(pair + kPairsInBlock, pairs), ofBlocks[block]);
      }
    });
    for (const Contributions& contributions : ofBlocks)
    {
      for (const PathBatch::Contribution& contribution : contributions)
      {
        bins[contribution.bin] += contribution.value / samples;
      }
    }
    if (!execution.reportProgress(static_cast<double>(first) / static_cast<double>(pairs)))
    {
      throw Interrupted();
    }
  }
  return bins;
}

Estimates measure(const SceneObjects& objects, const Sensor& sensor,
  const BidirectionalTracer::Config& config, int passes, std::uint32_t samples,
  Execution& execution)
{
  const BidirectionalTracer tracer(objects, sensor, config);
  Estimates estimates(sensor.numberOfBins());
  for (int pass = 0; pass < passes; ++pass)
  {
    estimates.add(tracer.trace(static_cast<std::uint64_t>(pass), samples, execution));
  }
  return estimates;
}

Estimates irradianceAt(const SceneObjects& objects, const std::vector<CellId>& cells,
  const BidirectionalTracer::Config& config, int passes, std::uint32_t samples,
  Execution& execution)
{
  return measure(objects, CellIrradiance(objects, cells), config, passes, samples, execution);
}

}
