// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_KeptPhotons_h
#define irradiance_KeptPhotons_h

#include "Execution/ProgressSpan.h"
#include "History/WalkHistory.h"
#include "Photons/LeafPhotons.h"

#include <cassert>
#include <memory>
#include <utility>

namespace irradiance
{

/// The photons of all stored walks, arranged for searches. They are collected when a filter needs
/// them; from then on they follow the histories. All that changes them throws Interrupted.
class KeptPhotons
{
public:
  /// Unless that was done before. The sides of all hits have to be known.
  void collect(const SceneObjects& objects, const WalkHistories& histories, Execution& execution)
  {
    if (photons_)
    {
      return;
    }
    auto photons = std::make_unique<LeafPhotons>(objects);
    const auto count = static_cast<double>(histories.all().size());
    double done = 0;
    for (const WalkHistory* history : histories.all())
    {
      ProgressSpan part(execution, done / count, (done + 1) / count);
      photons->add(*history, 0, history->size(), part);
      ++done;
    }
    photons_ = std::move(photons);
  }
  /// `objects` and `histories` are those after the changes.
  void apply(const SceneObjects& objects, const WalkHistories& histories,
    const PhotonChanges& changes, Execution& execution)
  {
    if (photons_)
    {
      photons_->apply(objects, histories, changes, execution);
    }
  }
  void forget() { photons_.reset(); }

  bool areCollected() const { return photons_ != nullptr; }
  /// Only if they are collected.
  const LeafPhotons& get() const
  {
    assert(photons_);
    return *photons_;
  }

private:
  std::unique_ptr<LeafPhotons> photons_;
};

}

#endif
