// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_NearestPhotonEstimator_h
#define irradiance_NearestPhotonEstimator_h

#include "Estimates/SumEstimator.h"
#include "Photons/NearestEstimate.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace irradiance
{

/**
 * The irradiance of small cells from the photons nearest to their centroids (section 4.1 of the
 * paper). A cell that received as many photons keeps its sum. Photons come from at most some twice
 * as far as the scene has them on the average, so that dark places do not draw on light from
 * elsewhere. Direct light that cells gathered is no photons: it is added to what the photons say.
 *
 * After a motion, cells are estimated again if photons came or went, or objects moved, within the
 * sphere that their photons are from. All others would get the same bits.
 */
class NearestPhotonEstimator : public SumEstimator
{
public:
  /// `photons`: for an estimate; at least 2 are taken.
  NearestPhotonEstimator(const EstimateSource& source, double photons)
    : SumEstimator(source)
    , count_(static_cast<std::uint32_t>(std::max(photons, 2.0)))
  {
  }

  /// Does nothing if no object has moved since the last one and no photons were noted.
  void update(const EstimateRounds& rounds, Execution& execution) override;
  void note(const PhotonChanges& changes) override;
  void forgetPhotons() override;
  double irradiance(const CellSide& cell, int band) const override;
  /// How many sides of cells the last update estimated.
  std::size_t numberOfEstimates() const { return numberOfEstimates_; }

private:
  class Changes;

  /// Of a cell, in the world.
  struct Centroid
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
    double reach =
      kUnknown;  ///< radius of the sphere on which the estimate depends; NaN: there is none
    Power power; ///< over the area it is the density
    double area = 0;
  };
  /// A photon that left or came, on an object that stays.
  struct ChangedPhoton
  {
    Vector3 position, normal; ///< world; the normal of its side
  };

  static constexpr std::uint32_t kNone = 0xffffffffu;
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  bool isUpToDate() const;
  void estimateSmallCells(const NearestPhotons& photons, Execution& execution);
  /// Quanta per m2 that photons bring to a side of a cell, as in CellSums; NaN if that is to come
  /// from its sum.
  double density(const CellSide& cell, int band) const;
  static std::vector<Centroid> centroidsOf(
    const NearestPhotons& photons, std::uint32_t object, const CancelPoint& cancelPoint);
  std::vector<char> updateCentroids(const NearestPhotons& photons, const CancelPoint& cancelPoint);
  std::vector<CellSide> findSmall();
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

  std::uint32_t count_;
  bool isKnown_ = false; ///< the state below is complete
  int sides_ = 1;
  std::size_t numberOfEstimates_ = 0;
  double maximumRadius_ = 0;
  SceneObjects objects_;  ///< of the last update
  PhotonChanges changes_; ///< since then
  CellNumbers numbers_;
  std::vector<std::vector<Centroid>> centroids_; ///< by object
  std::vector<Estimate> estimates_;              ///< of the front and of the back of each cell
};

}

#endif
