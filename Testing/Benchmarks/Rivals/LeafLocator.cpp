// SPDX-License-Identifier: BSD-3-Clause
#include "../../PhotonWalks/HistoryPhotons.h"
#include "Photons/NearestPhotons.h"
#include "Rivals/PhotonLocator.h"

#include <array>
#include <optional>

using namespace irradiance;

namespace
{

class LeafLocator : public PhotonLocator
{
public:
  LeafLocator(IrradianceEngine& engine, IrradianceEngine& other)
    : engines_{ &engine, &other }
  {
    for (IrradianceEngine* each : engines_)
    {
      each->leafPhotons(execution_); // finds the sides of all photons
      histories_.push_back(each->photons());
      photons_.push_back(test::photonsOf(histories_.back()));
    }
    changes_ = { test::changesBetween(photons_[1], photons_[0]),
      test::changesBetween(photons_[0], photons_[1]) };
    leaves_ = LeafPhotons(engine.objects());
    leaves_.add(histories_[0], 0, histories_[0].blocks().size(), execution_);
    search_.emplace(leaves_, engine.objects(), histories_[0]);
  }

  void build() override
  {
    frame_ = 1 - frame_;
    leaves_.apply(objects(), histories_[frame_], changes_[frame_], execution_);
    search_.emplace(leaves_, objects(), histories_[frame_]);
  }

  void find(const Sensor& sensor, std::size_t count) override
  {
    sensor_ = sensor;
    found_ = search_->find(sensor, count);
  }

  std::vector<double> squaredDistances() const override
  {
    std::vector<double> distances;
    for (const PhotonReference& photon : found_.photons)
    {
      distances.push_back(search_->squaredDistance(sensor_, photon));
    }
    return distances;
  }

  std::vector<double> allSquaredDistances(const Sensor& sensor) const override
  {
    std::vector<double> distances;
    for (const Photon& photon : photons_[frame_])
    {
      const SceneObject& object = objects()[photon.id.object];
      const Vector3 area =
        transformed(object.worldFromObject, object.body->mesh()[photon.id.triangle]).areaVector();
      if ((photon.isFront ? 1 : -1) * area.dot(sensor.normal) >= Facing::kLeastCosine * area.norm())
      {
        distances.push_back(search_->squaredDistance(sensor, photon.reference));
      }
    }
    return distances;
  }

private:
  const SceneObjects& objects() const { return engines_[frame_]->objects(); }

  Execution execution_;
  std::array<IrradianceEngine*, 2> engines_;
  std::vector<WalkHistory> histories_; ///< by frame, as those below
  std::vector<std::vector<Photon>> photons_;
  std::array<PhotonChanges, 2> changes_; ///< that lead to this frame
  std::size_t frame_ = 0;
  LeafPhotons leaves_;
  std::optional<NearestPhotons> search_;
  Sensor sensor_;
  NearPhotons found_;
};

}

std::unique_ptr<PhotonLocator> makeLeafLocator(IrradianceEngine& engine, IrradianceEngine& other)
{
  return std::make_unique<LeafLocator>(engine, other);
}
