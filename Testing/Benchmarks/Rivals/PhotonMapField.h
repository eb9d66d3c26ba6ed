// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Measuring/CellField.h"
#include "Rivals/PhotonMap.h"

/// The photons of an engine as a photon map takes them: in the world, with directions of flight.
/// The engine has one band, and keeps photons.
std::vector<PhotonMap::Photon> mapPhotonsOf(const irradiance::IrradianceEngine& engine);

/// W/m2 at the middles of all cells, towards their fronts, from the `count` nearest photons each.
CellField irradianceOf(
  const PhotonMap& map, const irradiance::SceneObjects& objects, std::size_t count);
