// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IrradianceEngine.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <tuple>
#include <vector>

namespace irradiance::test
{

/// The set of walks of an engine with one group of lights.
inline const WalkSet& onlySet(const IrradianceEngine& engine)
{
  assert(engine.walks().sets().size() == 1);
  return engine.walks().sets().front();
}

/// All photons, in the order of their references.
inline std::vector<Photon> photonsOf(const WalkHistory& history)
{
  std::vector<Photon> photons;
  for (std::size_t block = 0; block < history.size(); ++block)
  {
    history.forEachPhoton(block, [&](const Photon& photon) { photons.push_back(photon); });
  }
  std::sort(photons.begin(), photons.end(),
    [](const Photon& a, const Photon& b) { return a.reference < b.reference; });
  return photons;
}

/// What differs between two frames.
inline PhotonChanges changesBetween(
  const std::vector<Photon>& before, const std::vector<Photon>& after)
{
  const auto key = [](const Photon& p) {
    return std::make_tuple(
      p.reference.walk, p.reference.bounce, p.id.object, p.id.triangle, p.weights, p.isFront);
  };
  const auto comesFirst = [&](const Photon& a, const Photon& b) { return key(a) < key(b); };
  PhotonChanges changes;
  std::set_difference(before.begin(), before.end(), after.begin(), after.end(),
    std::back_inserter(changes.gone), comesFirst);
  std::set_difference(after.begin(), after.end(), before.begin(), before.end(),
    std::back_inserter(changes.arrived), comesFirst);
  return changes;
}

}
