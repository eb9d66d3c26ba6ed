// SPDX-License-Identifier: BSD-3-Clause
#include "Execution/SlicedPass.h"
#include "IrradianceEngine.h"

#include <algorithm>
#include <cassert>
#include <memory>
#include <utility>
#include <vector>

/// How the engine hands out photons, and keeps their stores up to date.
namespace irradiance
{

/// Those that walks leave are stored anyway.
void IrradianceEngine::findSides(Execution& execution)
{
  if (hasSides_)
  {
    return;
  }
  const SobolSequence samples = this->samples();
  const WalkShooter shooter = this->shooter(samples);
  SlicedPass pass{ history_.size(), {} };
  pass.work = [&](std::size_t i, const Deadline&) {
    WalkBlock& block = history_.block(i);
    std::vector<SegmentRef> ends;
    for (std::uint32_t walk = block.firstWalk(); walk < block.endWalk(); ++walk)
    {
      if (block.size(walk) > 0 && block.hit({ walk, block.size(walk) - 1 }))
      {
        ends.push_back({ walk, block.size(walk) - 1 });
      }
    }
    std::vector<Ray> rays(ends.size());
    shooter.raysOf(history_, ends, rays.data());
    for (std::size_t k = 0; k < ends.size(); ++k)
    {
      block.setSide(ends[k], shooter.rules().hitsFront(rays[k], block.hit(ends[k]).id));
    }
    return true;
  };
  pass.run(execution);
  hasSides_ = true;
}

const SpecularPhotons& IrradianceEngine::specularPhotons(Execution& execution)
{
  assert(keepsPhotons());
  if (!specularPhotons_)
  {
    findSides(execution);
    auto photons = std::make_unique<SpecularPhotons>(objects_);
    photons->add(history_, 0, history_.size(), execution);
    specularPhotons_ = std::move(photons);
  }
  return *specularPhotons_;
}

const LeafPhotons& IrradianceEngine::leafPhotons(Execution& execution)
{
  assert(keepsPhotons());
  if (!leafPhotons_)
  {
    findSides(execution);
    auto photons = std::make_unique<LeafPhotons>(objects_);
    photons->add(history_, 0, history_.size(), execution);
    leafPhotons_ = std::move(photons);
  }
  return *leafPhotons_;
}

void IrradianceEngine::estimateNearest(bool isSame, Execution& execution)
{
  const bool isAsked = settings_.cellEstimate == CellEstimate::Nearest;
  const auto count = static_cast<std::uint32_t>(std::max(settings_.spreadPhotons, 2.0));
  if (isAsked && isSame && nearestCells_.count() == count)
  {
    return;
  }
  if (!isAsked)
  {
    nearestCells_ = {};
    return;
  }
  const LeafPhotons& leaves = leafPhotons(execution);
  const NearestPhotons nearest(leaves, surfaces(execution), objects_, history_);
  nearestCells_.update(nearest, sums_, count, static_cast<double>(emitters_.photon()), execution);
}

const Surfaces& IrradianceEngine::surfaces(Execution& execution)
{
  surfaces_.update(objects_, checkpointOf(execution, 0));
  return surfaces_;
}

void IrradianceEngine::updatePhotonStores(const PhotonChanges& changes, Execution& execution)
{
  if (specularPhotons_)
  {
    specularPhotons_->apply(changes, execution);
  }
  if (leafPhotons_)
  {
    leafPhotons_->apply(objects_, history_, changes, execution);
    nearestCells_.note(changes);
  }
}

}
