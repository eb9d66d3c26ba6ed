// SPDX-License-Identifier: BSD-3-Clause
#include "Estimates/NearestPhotonEstimator.h"

#include "Execution/SlicedPass.h"
#include "Geometry/Pi.h"
#include "Photons/PhotonTree.h"
#include "Trees/BoxQuery.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

namespace irradiance
{

/// Where photons left or came, and where objects moved.
class NearestPhotonEstimator::Changes
{
public:
  Changes(const Box& scene, std::vector<ChangedPhoton> photons, std::vector<Box> moved)
    : frame_(scene)
    , photons_(std::move(photons))
    , moved_(std::move(moved))
    , tree_(moved_, 0, {})
  {
    std::vector<LeafPhoton> leaf;
    leaf.reserve(photons_.size());
    for (std::uint32_t i = 0; i < photons_.size(); ++i)
    {
      leaf.emplace_back(unitPoint(frame_, photons_[i].position), SegmentRef{}, true, i);
    }
    leaf_.change({}, leaf);
  }

  /// Whether there are some within a sphere around a foot.
  bool touch(const Foot& foot, double radius) const
  {
    Box box{ foot.sensor.position, foot.sensor.position };
    box.inflate(radius);
    const std::vector<std::uint32_t> near = trianglesNear(tree_, box);
    return hasPhotons(foot.sensor, radius) ||
      std::any_of(near.begin(), near.end(),
        [&](std::uint32_t i) { return !moved_[i].intersection(box).isEmpty(); });
  }

private:
  bool hasPhotons(const Sensor& sensor, double radius) const
  {
    constexpr float kRounding = 0x1p-18F;
    const auto unitRadius = static_cast<float>(radius * frame_.scale) + kRounding;
    float limit = unitRadius * unitRadius;
    leaf_.visitNear(
      unitPoint(frame_, sensor.position), [&] { return limit; },
      [&](const PhotonPack& pack) {
        for (unsigned lane = 0; lane < PhotonPack::kSize; ++lane)
        {
          if (pack.isUsed(lane) && isNear(photons_[pack.triangle(lane)], sensor, radius))
          {
            limit = -1;
          }
        }
      });
    return limit < 0;
  }
  static bool isNear(const ChangedPhoton& photon, const Sensor& sensor, double radius)
  {
    constexpr double kRounding = 0x1p-20;
    return sensor.squaredDistance(photon.position) <= radius * radius * (1 + kRounding) &&
      sensor.normal.dot(photon.normal) >= Facing::kLeastCosine - kRounding;
  }

  UnitFrame frame_;
  std::vector<ChangedPhoton> photons_;
  std::vector<Box> moved_;
  TriangleTree tree_; ///< over those
  PhotonTree leaf_;
};

void NearestPhotonEstimator::note(const PhotonChanges& changes)
{
  if (isKnown_)
  {
    changes_.add(changes);
  }
}

void NearestPhotonEstimator::forgetPhotons()
{
  isKnown_ = false;
  changes_ = {};
}

bool NearestPhotonEstimator::isUpToDate() const
{
  const SceneObjects& objects = source().space.objects;
  bool isSame = isKnown_ && changes_.gone.empty() && changes_.arrived.empty();
  for (std::uint32_t i = 0; isSame && i < objects.size(); ++i)
  {
    isSame = !hasMoved(objects[i], objects_[i]);
  }
  return isSame;
}

std::vector<NearestPhotonEstimator::Centroid> NearestPhotonEstimator::centroidsOf(
  const NearestPhotons& photons, std::uint32_t number, const CancelPoint& cancelPoint)
{
  const SceneObject& object = photons.objects()[number];
  const Centroid none{ Vector3::Zero(), Vector3::Zero(), 0, kNone, 0 };
  std::vector<Centroid> centroids(object.material->numberOfCells, none);
  const TriangleMesh& mesh = object.mesh();
  ThrottledCancelPoint pace(cancelPoint);
  for (std::size_t i = 0; i < mesh.size(); ++i)
  {
    const Triangle triangle = transformed(object.worldFromObject, mesh[i]);
    Centroid& centroid = centroids[object.material->cellOfTriangle[i]];
    const double area = triangle.area();
    centroid.position += area * (triangle.a + triangle.b + triangle.c) / 3;
    centroid.normal += triangle.areaVector();
    centroid.area += area;
    pace.step();
  }
  for (Centroid& centroid : centroids)
  {
    // NaN where there is none; no triangle faces that way.
    centroid.position /= centroid.area;
    centroid.normal /= centroid.normal.norm();
  }
  std::vector<double> nearest(centroids.size(), kInfinity);
  for (std::uint32_t i = 0; i < mesh.size(); ++i)
  {
    const std::uint32_t cell = object.material->cellOfTriangle[i];
    Centroid& centroid = centroids[cell];
    const Sensor sensor{ centroid.position, centroid.normal };
    const int side = photons.sideFacing(sensor, { number, i });
    const double distance = side == 0 ? kInfinity : photons.distance(sensor, { number, i });
    if (distance < nearest[cell])
    {
      nearest[cell] = distance;
      centroid.triangle = i;
      centroid.side = side;
    }
    pace.step();
  }
  return centroids;
}

/// Rounded up to one of four for each doubling, so that not each photon more or less changes what
/// dark cells see. Scaling by a power of two scales it.
double NearestPhotonEstimator::radiusFor(double squared)
{
  int exponent;
  const double mantissa = std::frexp(std::sqrt(squared), &exponent);
  for (const double step : { 0.59375, 0.703125, 0.84375 })
  {
    if (mantissa <= step)
    {
      return std::ldexp(step, exponent);
    }
  }
  return std::ldexp(1.0, exponent);
}

/// Returns what has moved since the last update.
std::vector<char> NearestPhotonEstimator::updateCentroids(
  const NearestPhotons& photons, const CancelPoint& cancelPoint)
{
  const SceneObjects& objects = photons.objects();
  std::vector<char> isMoved;
  centroids_.resize(objects.size());
  numbers_ = CellNumbers(objects);
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    isMoved.push_back(!isKnown_ || hasMoved(objects[i], objects_[i]) ? 1 : 0);
    if (isMoved.back() != 0)
    {
      centroids_[i] = centroidsOf(photons, i, cancelPoint);
    }
  }
  return isMoved;
}

/// Returns the sides of cells that received few photons themselves, and sets the largest radius.
std::vector<CellSide> NearestPhotonEstimator::findSmall()
{
  const CellSums& sums = source().walks.sums();
  const auto quantaPerWalk =
    static_cast<double>(source().walks.quantaPerWalk()); // in all bands together
  std::vector<CellSide> small;
  double area = 0, received = 0; // m2, photons
  numbers_.forEach([&](const SceneCell& cell) {
    const Centroid& centroid = centroids_[cell.object][cell.cell];
    area += centroid.area;
    for (int side = 0; side < 2; ++side)
    {
      double power = 0;
      for (int band = 0; band < sums.bands(); ++band)
      {
        power +=
          static_cast<double>(sums.shot({ cell, std::min(side, sides_ - 1) }, band, sums.rounds()));
      }
      received += side < sides_ ? power / quantaPerWalk : 0;
      if (power / quantaPerWalk < count_ && centroid.triangle != kNone)
      {
        small.push_back({ cell, side });
      }
    }
  });
  maximumRadius_ = received > 0 ? radiusFor(4 * count_ * area / received / kPi) : 0;
  return small;
}

/// Leaves out photons on moved objects: these count by their bounds.
std::vector<NearestPhotonEstimator::ChangedPhoton> NearestPhotonEstimator::changedPhotons(
  const NearestPhotons& photons, const std::vector<char>& isMoved) const
{
  std::vector<ChangedPhoton> changed;
  for (const std::vector<Photon>* list : { &changes_.gone, &changes_.arrived })
  {
    for (const Photon& photon : *list)
    {
      if (isMoved[photon.id.object] == 0)
      {
        changed.push_back({ photons.position(photon.id, photon.weights),
          (photon.isFront ? 1.0 : -1.0) * photons.front(photon.id) });
      }
    }
  }
  return changed;
}

/// Before and now.
std::vector<Box> NearestPhotonEstimator::boundsOfMoved(
  const SceneObjects& objects, const std::vector<char>& isMoved) const
{
  std::vector<Box> bounds;
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    for (const SceneObject* object : { &objects[i], &objects_[i] })
    {
      if (isMoved[i] != 0 && !object->isEmpty())
      {
        bounds.push_back(object->worldBounds());
      }
    }
  }
  return bounds;
}

void NearestPhotonEstimator::update(const EstimateRounds& rounds, Execution& execution)
{
  SumEstimator::update(rounds, execution);
  numberOfEstimates_ = 0;
  if (!isUpToDate())
  {
    const EstimateSource& from = source();
    estimateSmallCells(
      NearestPhotons(from.photons.get(), from.surfaces, from.space.objects, from.walks.histories()),
      execution);
  }
}

void NearestPhotonEstimator::estimateSmallCells(const NearestPhotons& photons, Execution& execution)
{
  const SceneObjects& objects = photons.objects();
  const bool isFirst = !isKnown_;
  sides_ = source().walks.sums().sides();
  const std::vector<char> isMoved = updateCentroids(photons, cancelPointOf(execution, 0));
  isKnown_ = false; // until the end is reached
  const double radius = maximumRadius_;
  const std::vector<CellSide> small = findSmall();
  const Changes changes(photons.bounds(), changedPhotons(photons, isMoved),
    isFirst ? std::vector<Box>() : boundsOfMoved(objects, isMoved));
  const bool isAll = isFirst || radius != maximumRadius_;
  estimates_.resize(2 * numbers_.size());
  std::vector<Estimate> before(estimates_.size());
  before.swap(estimates_);
  std::atomic<std::size_t> estimated{ 0 };
  constexpr std::size_t kUnit = 32;
  SlicedPass pass{ maximumRadius_ > 0 ? (small.size() + kUnit - 1) / kUnit : 0, {} };
  pass.work = [&](std::size_t unit, const Deadline&) {
    for (std::size_t i = unit * kUnit; i < std::min((unit + 1) * kUnit, small.size()); ++i)
    {
      const Foot foot = footOf(photons, small[i]);
      const Estimate& old = before[slotOf(small[i])];
      const bool isOld = !isAll && isMoved[small[i].object] == 0 && !std::isnan(old.reach) &&
        !changes.touch(foot, old.reach);
      estimates_[slotOf(small[i])] = isOld ? old : estimate(photons, foot);
      estimated += isOld ? 0 : 1;
    }
    return true;
  };
  pass.run(execution);
  numberOfEstimates_ = estimated;
  objects_ = objects;
  changes_ = {};
  isKnown_ = true;
}

Foot NearestPhotonEstimator::footOf(const NearestPhotons& photons, const CellSide& cell) const
{
  const Centroid& centroid = centroids_[cell.object][cell.cell];
  const int sign = cell.side == 0 ? 1 : -1;
  return photons.footOn({ centroid.position, sign * centroid.normal },
    { cell.object, centroid.triangle }, sign * centroid.side);
}

NearestPhotonEstimator::Estimate NearestPhotonEstimator::estimate(
  const NearestPhotons& photons, const Foot& foot) const
{
  const NearestEstimate estimate = nearestEstimate(photons, foot, count_, maximumRadius_);
  return { estimate.radius, estimate.power, estimate.area };
}

double NearestPhotonEstimator::irradiance(const CellSide& cell, int band) const
{
  const double density = this->density(cell, band);
  if (std::isnan(density))
  {
    return SumEstimator::irradiance(cell, band);
  }
  const CellSums& sums = source().walks.sums();
  return perArea(sums.gathered(cell, band, sums.rounds()), cell) + source().walks.watts(density);
}

double NearestPhotonEstimator::density(const CellSide& cell, int band) const
{
  const auto onSide = [&](int side) {
    const Estimate& estimate = estimates_[slotOf({ cell, side })];
    return std::isnan(estimate.reach) || !(estimate.area > 0)
      ? kUnknown
      : static_cast<double>(estimate.power[band]) / estimate.area;
  };
  if (sides_ == 2)
  {
    return onSide(cell.side);
  }
  const double back = onSide(1);
  return onSide(0) + (std::isnan(back) ? 0 : back);
}

}
