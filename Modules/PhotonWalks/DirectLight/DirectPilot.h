// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "DirectLight/LampPieces.h"
#include "Surfaces/SceneObjects.h"

#include <utility>

namespace irradiance
{

/**
 * How noisy it is to look for the light of some lamps, from samples of a few static cells. It
 * depends on the static object and the lights alone.
 *
 * Theory.md, 1.3 derives what follows from it.
 */
class DirectPilot
{
public:
  /// For each sample.
  static constexpr double kFewestWalks = 1, kMostWalks = 36;

  DirectPilot(const SceneObjects& objects, const LampPieces& lamps);

  /// The power, in walks, that a cell may receive for each of its samples, with the least noise of
  /// direct and indirect light together for the time they take; and what that costs: noise x time
  /// beside walks that start at the lamps; if less than 1 gathering pays. `arrived`: the part of
  /// the flux that reaches static cells. `returned`: the part of that which arrives again.
  /// `powerOfStart`: of a walk that starts at a cell, in walks.
  std::pair<double, double> best(double arrived, double returned, double powerOfStart) const;

  /// Of one sample that stands for as much power as a walk, beside the walk's: small of a panel,
  /// large of light that may be hidden, or comes from lamps that are told apart badly.
  double variance() const { return variance_; }

private:
  double variance_ = 1;
  double asked_ = 1; ///< power for which samples ask, for all that arrives
};

}
