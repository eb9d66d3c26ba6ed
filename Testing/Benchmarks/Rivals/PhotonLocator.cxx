// SPDX-License-Identifier: BSD-3-Clause
#include "Rivals/PhotonLocator.h"

#include "../../PhotonWalks/CountedSurface.h"
#include "../../PhotonWalks/HistoryPhotons.h"
#include "Photons/NearestPhotons.h"
#include "Rivals/PhotonMapField.h"

#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkStaticPointLocator.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>

using namespace irradiance;

namespace
{

std::array<float, 3> inFloats(const Vector3& point)
{
  return { static_cast<float>(point[0]), static_cast<float>(point[1]),
    static_cast<float>(point[2]) };
}

/// It finds photons of all surfaces, near in any direction.
class PointLocator : public PhotonLocator
{
public:
  explicit PointLocator(const IrradianceEngine& engine)
    : photons_(mapPhotonsOf(engine))
  {
  }

  std::vector<double> allSquaredDistances(const Sensor& sensor) const override
  {
    std::vector<double> distances;
    for (const PhotonMap::Photon& photon : photons_)
    {
      const auto& [x, y, z] = photon.position;
      distances.push_back((Vector3(x, y, z) - sensor.position).squaredNorm());
    }
    return distances;
  }

protected:
  std::vector<PhotonMap::Photon> photons_;
};

/// Jensen's.
class PhotonMapLocator : public PointLocator
{
public:
  using PointLocator::PointLocator;

  void build() override { map_.emplace(photons_); }

  void find(const Sensor& sensor, std::size_t count) override
  {
    map_->findNearest(inFloats(sensor.position), count, found_);
  }

  std::vector<double> squaredDistances() const override
  {
    std::vector<double> distances;
    std::transform(found_.begin(), found_.end(), std::back_inserter(distances),
      [](const PhotonMap::Neighbour& neighbour) { return neighbour.squaredDistance; });
    return distances;
  }

private:
  std::optional<PhotonMap> map_;
  std::vector<PhotonMap::Neighbour> found_;
};

class VtkLocator : public PointLocator
{
public:
  explicit VtkLocator(const IrradianceEngine& engine)
    : PointLocator(engine)
  {
    vtkNew<vtkPoints> own; // in floats
    for (const PhotonMap::Photon& photon : photons_)
    {
      own->InsertNextPoint(photon.position.data());
    }
    points_->SetPoints(own);
    locator_->SetDataSet(points_);
  }

  void build() override
  {
    points_->Modified(); // else it would stay as it is
    vtkSMPTools::LocalScope(
      vtkSMPTools::Config{ 1, "Sequential", false }, [this] { locator_->BuildLocator(); });
  }

  void find(const Sensor& sensor, std::size_t count) override
  {
    point_ = sensor.position;
    locator_->FindClosestNPoints(static_cast<int>(count), point_.data(), found_);
  }

  std::vector<double> squaredDistances() const override
  {
    std::vector<double> distances;
    for (vtkIdType i = 0; i < found_->GetNumberOfIds(); ++i)
    {
      Vector3 photon;
      points_->GetPoint(found_->GetId(i), photon.data());
      distances.push_back((photon - point_).squaredNorm());
    }
    return distances;
  }

private:
  vtkNew<vtkPolyData> points_;
  vtkNew<vtkStaticPointLocator> locator_;
  vtkNew<vtkIdList> found_;
  Vector3 point_;
};

class LeafLocator : public PhotonLocator
{
public:
  LeafLocator(IrradianceEngine& engine, IrradianceEngine& other)
    : engines_{ &engine, &other }
  {
    for (IrradianceEngine* each : engines_)
    {
      each->collectPhotons(execution_); // finds the sides of all photons
      photons_.push_back(test::photonsOf(test::onlySet(*each).history()));
    }
    changes_ = { test::changesBetween(photons_[1], photons_[0]),
      test::changesBetween(photons_[0], photons_[1]) };
    leaves_ = LeafPhotons(engine.objects());
    leaves_.add(history(), 0, history().size(), execution_);
    surfaces_.update(engine.objects());
    search_.emplace(leaves_, surfaces_, engine.objects(), WalkHistories{ &history() });
  }

  void build() override
  {
    frame_ = 1 - frame_;
    leaves_.apply(objects(), { &history() }, changes_[frame_], execution_);
    surfaces_.update(objects());
    search_.emplace(leaves_, surfaces_, objects(), WalkHistories{ &history() });
  }

  void find(const Sensor& sensor, std::size_t count) override
  {
    const Foot foot = search_->footOf(sensor).value();
    sensor_ = foot.sensor;
    found_ = search_->find(foot, count);
  }

  std::vector<double> squaredDistances() const override
  {
    std::vector<double> distances;
    for (const SegmentRef& photon : found_.photons)
    {
      distances.push_back(search_->squaredDistance(sensor_, photon));
    }
    return distances;
  }

  std::vector<double> allSquaredDistances(const Sensor& sensor) const override
  {
    const test::CountedSurface surface(objects());
    const Foot foot = surface.footOf(sensor).value();
    std::vector<double> distances;
    for (const Photon& photon : photons_[frame_])
    {
      if (surface.counts(foot, photon.id, photon.isFront ? 1 : -1))
      {
        distances.push_back(search_->squaredDistance(foot.sensor, photon.reference));
      }
    }
    return distances;
  }

private:
  const SceneObjects& objects() const { return engines_[frame_]->objects(); }
  const WalkHistory& history() const { return test::onlySet(*engines_[frame_]).history(); }

  Execution execution_;
  std::array<IrradianceEngine*, 2> engines_;
  std::vector<std::vector<Photon>> photons_; ///< by frame
  std::array<PhotonChanges, 2> changes_;     ///< that lead to this frame
  std::size_t frame_ = 0;
  LeafPhotons leaves_;
  Surfaces surfaces_;
  std::optional<NearestPhotons> search_;
  Sensor sensor_; ///< on its foot
  NearPhotons found_;
};

}

std::unique_ptr<PhotonLocator> makePhotonMapLocator(const IrradianceEngine& engine)
{
  return std::make_unique<PhotonMapLocator>(engine);
}

std::unique_ptr<PhotonLocator> makeVtkLocator(const IrradianceEngine& engine)
{
  return std::make_unique<VtkLocator>(engine);
}

std::unique_ptr<PhotonLocator> makeLeafLocator(IrradianceEngine& engine, IrradianceEngine& other)
{
  return std::make_unique<LeafLocator>(engine, other);
}
