// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "DirectLight/CellSampler.h"
#include "Execution/Execution.h"
#include "Sampling/WalkPlan.h"
#include "Simd/LargePages.h"
#include "Tally/CellSums.h"

#include <cstdint>
#include <vector>

namespace irradiance
{

/**
 * The light that comes straight from the lights of a table to the cells of a frame, gathered by
 * each cell with the samples of a plan.
 */
class DirectLight
{
public:
  using Samples = std::vector<DirectSample, LargePages<DirectSample>>;

  /// All but the numbers must outlive it.
  DirectLight(const CellShapes& cells, const LampPieces& lamps, const DirectPlan& plan,
    std::uint64_t seed, double quantaPerWatt);

  /// Makes all samples, and looks which of them see their lights.
  void gather(const Frame& frame, Execution& execution);
  /// A sample to which another part of the light comes than before.
  struct Change
  {
    std::uint32_t sample;
    double passed; ///< before
  };
  /// Follows a motion of objects that have none of the cells and lights. Looks again at the samples
  /// that what moved may hide now, or hid before, and at those whose light or cell a dynamic object
  /// touches. Returns what changed, in order.
  std::vector<Change> follow(const Frame& frame, Execution& execution);

  const DirectPlan& plan() const { return plan_; }
  /// By number; those of a cell that is not there are none.
  const Samples& samples() const { return samples_; }
  std::size_t bytes() const
  {
    return samples_.capacity() * (sizeof(DirectSample) + sizeof(View)) +
      passed_.capacity() * sizeof(float) + units_.capacity() * (sizeof(double) + sizeof(Bands));
  }
  /// The part of the light that comes to a sample, see ClearSheets; 0 if something hides it.
  double passedTo(std::uint32_t sample) const
  {
    return !isFree(views_[sample]) ? 0 : passed_.empty() ? 1 : passed_[sample];
  }
  /// Of what all cells receive, by band, W2: from the scatter of the samples of each cell, or of
  /// its replicates. As these are nets, it is rather too large.
  Bands variance() const;
  /// What a sample brings if it sees its light.
  Bands quantaOf(const DirectSample& sample) const;
  /// Adds what a sample of a cell brings to a round if this part of the light passes, or with `sign`
  /// -1 takes it away, to the last bit: see units_. Returns it in whole quanta. No other thread may
  /// add meanwhile.
  Power add(std::uint32_t sample, double passed, std::size_t number, const SceneCell& cell,
    int sign, CellSums& sums, std::size_t round) const;
  /// Likewise what the samples of these cells bring that see their lights.
  Power addTo(CellSums& sums, std::size_t round, int sign, const DealtBlocks& cells,
    const CancelPoint& cancelPoint) const;

private:
  /// What stands between a sample and its light: the number of a dynamic object, or one of those
  /// below.
  using View = std::uint32_t;
  static constexpr View kNever = 0;            ///< static objects, for ever; or no light can come
  static constexpr View kFree = 0xffffffffu;   ///< nothing but clear sheets that never move
  static constexpr View kSheets = 0xfffffffdu; ///< clear sheets, of which some are dynamic
  static constexpr View kTouch =
    0xfffffffeu; ///< what touches either end, which may end with any motion
  static bool isFree(View view) { return view == kFree || view == kSheets; }

  void gatherCells(const Frame& frame, std::size_t first, std::size_t end);
  Bands varianceOf(std::size_t cell) const;
  double unitOf(std::size_t cell) const;
  /// Whether a motion may change the view of a sample. `boxes`: of what moved.
  bool mayChange(const Frame& frame, const std::vector<Box>& boxes, bool sheetsMoved,
    std::uint32_t sample) const;
  /// For passed_, once there is a sheet.
  void makeRoom(const Frame& frame);
  /// Looks at samples again.
  void look(const Frame& frame, const std::vector<std::uint32_t>& samples);

  const CellShapes& cells_;
  const LampPieces& lamps_;
  const DirectPlan& plan_;
  std::uint64_t seed_;
  double quantaPerWatt_;
  Samples samples_;
  /// By cell, quanta: a power of two, of which all that its samples bring together is less than
  /// 2^53. What each brings is rounded to it, so no sum of these is rounded, in whatever order.
  std::vector<double> units_;
  std::vector<View> views_;      ///< by sample
  std::vector<float> passed_;    ///< see passedTo(), by sample; empty: no object has sheets
  std::vector<Bands> variances_; ///< by cell, W2
};

}
