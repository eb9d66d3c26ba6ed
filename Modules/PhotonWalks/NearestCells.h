// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_NearestCells_h
#define irradiance_NearestCells_h

#include "Execution/Execution.h"
#include "Photons/NearestEstimate.h"
#include "Tally/CellSums.h"

#include <limits>
#include <vector>

namespace irradiance
{

/**
 * The irradiance of small cells from the photons nearest to their middles (section 4.1 of the paper).
 * A cell that received as many photons by itself is left to its sum. Photons come from at most some
 * twice as far as the scene has them on the average, so that dark places do not draw on light from
 * elsewhere.
 *
 * After a motion, cells are estimated anew if photons came or went, or objects moved, within the sphere
 * that their photons are from. All others would get the same bits.
 */
class NearestCells
{
public:
  /// Notes photons that left and came before the next update.
  void note(const PhotonChanges& changes);
  /// To a frame. `count`: photons for an estimate, at least 2. `photon`: quanta of one, in all bands
  /// together. Since the last update no material has changed, and no photon except those noted. Throws
  /// Interrupted; then nothing is known.
  void update(const NearestPhotons& photons, const CellSums& sums, std::uint32_t count,
    double photon, Execution& execution);

  /// Photons for an estimate; 0 if there are none.
  std::uint32_t count() const { return count_; }
  /// Quanta per m2 on a side of a cell, as in CellSums; NaN if that is to come from its sum.
  double density(const CellSide& cell, int band) const;
  /// How many sides of cells the last update estimated.
  std::size_t numberOfEstimates() const { return numberOfEstimates_; }

private:
  class Changes;

  /// Of a cell, in the world.
  struct Middle
  {
    Vector3 position; ///< the mean over its triangles
    Vector3 normal;   ///< unit vector, on the front
    double area;
    std::uint32_t triangle; ///< of the cell, nearest to that position; kNone: none faces as all do
    int side;               ///< of the triangle, on the cell's front
  };
  /// What one side of a cell receives.
  struct Estimate
  {
    double reach = kUnknown; ///< nothing farther away matters; NaN: there is no estimate
    Power power;             ///< over the area it is the density
    double area = 0;
  };
  /// A photon that left or came, on an object that stays.
  struct ChangedPhoton
  {
    Vector3 position, normal; ///< world; the normal of its side
  };

  static constexpr std::uint32_t kNone = 0xffffffffu;
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  static std::vector<Middle> middlesOf(
    const NearestPhotons& photons, std::uint32_t object, const Checkpoint& checkpoint);
  std::vector<char> updateMiddles(
    const NearestPhotons& photons, bool isFirst, const Checkpoint& checkpoint);
  std::vector<CellSide> findSmall(const CellSums& sums, double photon);
  std::vector<ChangedPhoton> changedPhotons(
    const NearestPhotons& photons, const std::vector<char>& isMoved) const;
  std::vector<Box> boundsOfMoved(
    const SceneObjects& objects, const std::vector<char>& isMoved) const;
  static double radiusFor(double squared);
  Foot footOf(const NearestPhotons& photons, const CellSide& cell) const;
  Estimate estimate(const NearestPhotons& photons, const Foot& foot) const;
  std::size_t slotOf(const CellSide& cell) const
  {
    return 2 * numbers_[cell] + static_cast<std::size_t>(cell.side);
  }

  std::uint32_t count_ = 0;
  int sides_ = 1;
  std::size_t numberOfEstimates_ = 0;
  double maximumRadius_ = 0;
  SceneObjects objects_;  ///< of the last update
  PhotonChanges changes_; ///< since then
  CellNumbers numbers_;
  std::vector<std::vector<Middle>> middles_; ///< by object
  std::vector<Estimate> estimates_;          ///< of the front and of the back of each cell
};

}

#endif
