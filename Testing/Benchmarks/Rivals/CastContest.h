// SPDX-License-Identifier: BSD-3-Clause
#ifndef CastContest_h
#define CastContest_h

#include "Rivals/Caster.h"

#include <cstdint>
#include <string>

/// A rival and what is asked of it.
struct Contender
{
  std::string name;
  Caster caster;
  double mostMismatches;           ///< as a share of the rays, see compete()
  std::size_t mostRays = SIZE_MAX; ///< slow ones cast every n-th ray
};

struct Performance
{
  std::vector<double> seconds; ///< a ray, for each round
  double mismatches;           ///< share of the rays
};

/**
 * Lets all cast the same rays, in turns. Their hits are compared with the hits of the first: a
 * distance that differs by more than 1e-3, or a hit that the other misses, is a mismatch. Throws
 * std::runtime_error when one has more mismatches than allowed; a single ray is always forgiven.
 * But where none is allowed, the hits have to be the same bits.
 */
std::vector<Performance> compete(
  const std::vector<Contender>& contenders, const std::vector<irradiance::Ray>& rays, int rounds);

#endif
