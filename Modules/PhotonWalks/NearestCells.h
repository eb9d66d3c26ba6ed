// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_NearestCells_h
#define irradiance_NearestCells_h

#include "Execution/Execution.h"
#include "Photons/NearestEstimate.h"
#include "Tally/CellSums.h"

#include <vector>

namespace irradiance
{

/**
 * The irradiance of small cells from the photons nearest to their middles (section 4.1 of the paper).
 * A cell that received as many photons by itself is left to its sum. Photons come from at most twice
 * as far as the scene has them on the average, so that dark places do not draw on light from elsewhere.
 */
class NearestCells
{
public:
  NearestCells() = default;
  /// In a frame. `count`: photons for an estimate, at least 2. `photon`: quanta of one, in all bands
  /// together. Throws Interrupted.
  NearestCells(const NearestPhotons& photons, const CellSums& sums, std::uint32_t count,
    double photon, Execution& execution);

  /// Photons for an estimate; 0 if there are none.
  std::uint32_t count() const { return count_; }
  /// Quanta per m2 on a side of a cell, as in CellSums; NaN if that is to come from its sum.
  double density(std::uint32_t object, std::size_t cell, int side, int band) const
  {
    return densities_[((firstCell_[object] + cell) * sides_ + static_cast<std::size_t>(side)) *
        bands_ +
      static_cast<std::size_t>(band)];
  }

private:
  /// Of an object, by cell: sums over its triangles in the world.
  struct Middles
  {
    std::vector<Vector3> positions; ///< times area
    std::vector<Vector3> normals;   ///< area vectors
    std::vector<double> areas;
  };
  static Middles middlesOf(const SceneObject& object, const Checkpoint& checkpoint);
  void estimate(const NearestPhotons& photons, const Sensor& sensor, double* densities) const;

  std::uint32_t count_ = 0;
  std::size_t sides_ = 1, bands_ = 1;
  double maximumRadius_ = 0;
  std::vector<std::size_t> firstCell_;
  std::vector<double> densities_;
};

}

#endif
