// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_test_HistoryChanges_h
#define irradiance_test_HistoryChanges_h

#include "History/WalkHistory.h"
#include "IrradianceEngine.h"

#include <algorithm>
#include <iterator>
#include <tuple>
#include <vector>

namespace irradiance::test
{

/// All photons of the stored walks, in order.
inline std::vector<Photon> photonsOf(const IrradianceEngine& engine)
{
  const WalkHistory history(engine.plan(), engine.history());
  std::vector<Photon> photons;
  for (std::size_t block = 0; block < engine.history().size(); ++block)
  {
    history.forEachPhoton(block, [&](const Photon& photon) { photons.push_back(photon); });
  }
  return photons;
}

/// What leads from one list of photons, in order, to the other.
inline PhotonChanges changesBetween(const std::vector<Photon>& old, const std::vector<Photon>& now)
{
  const auto isLess = [](const Photon& a, const Photon& b) {
    const auto key = [](const Photon& photon) {
      return std::tie(photon.reference, photon.id.object, photon.id.triangle, photon.weights);
    };
    return key(a) < key(b);
  };
  PhotonChanges changes;
  std::set_difference(
    old.begin(), old.end(), now.begin(), now.end(), std::back_inserter(changes.gone), isLess);
  std::set_difference(
    now.begin(), now.end(), old.begin(), old.end(), std::back_inserter(changes.arrived), isLess);
  return changes;
}

}

#endif
