// SPDX-License-Identifier: BSD-3-Clause
#include "../../PhotonWalks/CountedSurface.h"
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
      each->collectPhotons(execution_); // finds the sides of all photons
      photons_.push_back(test::photonsOf(test::onlySet(*each).history()));
    }
    changes_ = { test::changesBetween(photons_[1], photons_[0]),
      test::changesBetween(photons_[0], photons_[1]) };
    leaves_ = LeafPhotons(engine.objects());
    leaves_.add(history(), 0, history().size(), execution_);
    surfaces_.update(engine.objects());
    search_.emplace(leaves_, surfaces_, engine.objects(), history());
  }

  void build() override
  {
    frame_ = 1 - frame_;
    leaves_.apply(objects(), history(), changes_[frame_], execution_);
    surfaces_.update(objects());
    search_.emplace(leaves_, surfaces_, objects(), history());
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

std::unique_ptr<PhotonLocator> makeLeafLocator(IrradianceEngine& engine, IrradianceEngine& other)
{
  return std::make_unique<LeafLocator>(engine, other);
}
