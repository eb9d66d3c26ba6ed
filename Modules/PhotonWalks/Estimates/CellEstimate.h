// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "DirectLight/DirectPlan.h"

#include <cstdint>
#include <memory>
#include <string>

namespace irradiance
{

class CellEstimator;
class WalkSets;
struct Frame;
struct WalkSettings;

/// From which photons the irradiance of a cell is estimated. Outputs state the number.
enum class CellEstimate
{
  Sums = 0,   ///< those that arrived in it
  Spread = 1, ///< small cells: also the photons of the cells around it, see CellSpread
  Gathered =
    3 ///< small cells, or more of them: those of what their rays hit, see FinalGatherEstimator
};

struct EstimateSettings
{
  CellEstimate cellEstimate = CellEstimate::Sums;
  /// On how many photons a small cell draws if not on its sum alone, on average; > 0.
  double spreadPhotons = 250;
  /// With Gathered, of each side of a cell that gathers; a small one expects fewer than two photons
  /// for each; >= 1.
  std::uint32_t gatherRays = 32;
  std::uint32_t maximumGatherRays = 1024; ///< >= gatherRays; with a target
  bool gathersEverywhere = false;         ///< with Gathered: all cells, not only small ones
  /// With Gathered: no sums are read; paths ask the lights wherever they hit.
  bool unbiasedGather = false;
  /// Whether results tell the sides of cells apart.
  bool separateSides = false;
};

/// Whether both are met by the same estimator.
inline bool isSameEstimate(const EstimateSettings& a, const EstimateSettings& b)
{
  return a.cellEstimate == b.cellEstimate && a.spreadPhotons == b.spreadPhotons &&
    a.gatherRays == b.gatherRays && a.maximumGatherRays == b.maximumGatherRays &&
    a.gathersEverywhere == b.gathersEverywhere && a.unbiasedGather == b.unbiasedGather &&
    a.separateSides == b.separateSides;
}

/// Of a frame and its walks.
std::unique_ptr<CellEstimator> makeCellEstimator(const EstimateSettings& settings,
  const WalkSettings& walkSettings, const Frame& frame, const WalkSets& walks);

/// With how many samples cells gather direct light at least, if `asked` for so many: where they
/// gather indirect light as well, the one is not to be noisier than the other.
FewestSamples fewestSamplesOf(const EstimateSettings& settings, const FewestSamples& asked);

/// What excludes each other, in the words of the filter's properties; empty if nothing does.
std::string conflictOf(const EstimateSettings& settings, const WalkSettings& walks);

}
