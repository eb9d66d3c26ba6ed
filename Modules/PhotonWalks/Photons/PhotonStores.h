// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PhotonStores_h
#define irradiance_PhotonStores_h

#include "Execution/ProgressSpan.h"
#include "History/WalkHistories.h"
#include "Photons/CellPhotonSets.h"
#include "Photons/LeafPhotons.h"

#include <cassert>
#include <memory>
#include <tuple>
#include <utility>

namespace irradiance
{

/// The photons of all stored walks, arranged for searches. A store is collected when a filter
/// needs it; from then on it follows the histories. All that changes stores throws Interrupted.
class PhotonStores
{
public:
  /// Collects a store, unless that was done before. The sides of all hits have to be known.
  template <class Store>
  void collect(const SceneObjects& objects, const WalkHistories& histories, Execution& execution)
  {
    auto& store = std::get<std::unique_ptr<Store>>(stores_);
    if (!store)
    {
      auto photons = std::make_unique<Store>(objects);
      const auto count = static_cast<double>(histories.all().size());
      double done = 0;
      for (const WalkHistory* history : histories.all())
      {
        ProgressSpan part(execution, done / count, (done + 1) / count);
        photons->add(*history, 0, history->size(), part);
        ++done;
      }
      store = std::move(photons);
    }
  }
  /// `objects` and `histories` are those after the changes.
  void apply(const SceneObjects& objects, const WalkHistories& histories,
    const PhotonChanges& changes, Execution& execution)
  {
    if (const auto& specular = std::get<0>(stores_))
    {
      specular->apply(changes, execution);
    }
    if (const auto& leaves = std::get<1>(stores_))
    {
      leaves->apply(objects, histories, changes, execution);
    }
  }
  void forgetAll() { stores_ = {}; }

  /// Whether there is no store.
  bool isEmpty() const { return !std::get<0>(stores_) && !std::get<1>(stores_); }
  /// Only if it is collected.
  template <class Store>
  const Store& get() const
  {
    const auto& store = std::get<std::unique_ptr<Store>>(stores_);
    assert(store);
    return *store;
  }

private:
  std::tuple<std::unique_ptr<CellPhotonSets>, std::unique_ptr<LeafPhotons>> stores_;
};

}

#endif
