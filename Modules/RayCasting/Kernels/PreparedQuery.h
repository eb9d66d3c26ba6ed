// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PreparedQuery_h
#define irradiance_PreparedQuery_h

#include <cstdint>

namespace irradiance
{

/// What differs from ray to ray of a TreeQuery, in rows of four that lanes are turned into.
struct PreparedQuery
{
  float origin[3];
  float limit;
  float direction[3];
  float pad;
  float inverse[3];
  float behind;
  float originInverse[3];
  std::uint32_t skipped;
  std::uint32_t ray; ///< its place in the columns
  int behindAxis;
};
static_assert(sizeof(PreparedQuery) == 72);

}

#endif
