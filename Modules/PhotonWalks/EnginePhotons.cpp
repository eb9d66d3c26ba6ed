// SPDX-License-Identifier: BSD-3-Clause
#include "IrradianceEngine.h"

#include <cassert>
#include <memory>
#include <utility>

/// How the engine hands out photons, and keeps their stores up to date.
namespace irradiance
{

const SpecularPhotons& IrradianceEngine::specularPhotons(Execution& execution)
{
  assert(isValid_ && keepsPhotons());
  if (!specularPhotons_)
  {
    auto photons = std::make_unique<SpecularPhotons>(objects_);
    photons->add(this->photons(), 0, history_.size(), execution);
    specularPhotons_ = std::move(photons);
  }
  return *specularPhotons_;
}

void IrradianceEngine::updatePhotonStores(const PhotonChanges& changes, Execution& execution)
{
  if (specularPhotons_)
  {
    specularPhotons_->apply(changes, execution);
  }
}

}
