// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_FirstHits_h
#define irradiance_FirstHits_h

#include "Lights/LightTable.h"
#include "Surfaces/SceneObjects.h"

#include <vector>

namespace irradiance
{

/**
 * Where light arrives that comes straight from the lights of a table, by a few rays from each.
 *
 * It depends on the lights and on the static object alone, so that no motion of others changes it.
 */
class FirstHits
{
public:
  FirstHits(const SceneObjects& objects, const LightTable& lights);

  /// Which lights shine mostly on static triangles so near to them that what arrives differs much from
  /// place to place: a strip along a wall, a lamp just over the floor. There walks that start at the light find
  /// the light of a cell with less work than samples of the cell do.
  const std::vector<bool>& nearLights() const { return nearLights_; }
  /// The part of what arrives at static triangles that they reflect and that arrives at some again, 0..1; 1 if
  /// nothing arrives. Roughly: a standard error of 0.1 at most.
  double returned() const { return returned_; }
  /// W that arrive at static triangles.
  double arrived() const { return arrived_; }

private:
  std::vector<bool> nearLights_;
  double returned_ = 1, arrived_ = 0;
};

}

#endif
