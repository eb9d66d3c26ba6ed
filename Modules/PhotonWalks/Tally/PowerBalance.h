// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PowerBalance_h
#define irradiance_PowerBalance_h

#include "Execution/Ranks.h"
#include "Surfaces/Power.h"

#include <cstdint>
#include <mutex>

namespace irradiance
{

/// Where the power went, in quanta. In integers, emitted = absorbed + escaped exactly: the absorbed
/// power of a hit is the incoming minus the outgoing power. In one band that is all or nothing.
struct PowerBalance
{
  Power emitted;
  Power absorbed;
  Power escaped;
  Power unmet; ///< the part of what escaped that no cell gathered; the rest walks lost
  std::int64_t segments = 0;
  double received = 0; ///< by all cells in all bands; shows an overflow before it happens

  PowerBalance& operator+=(const PowerBalance& other);
};

/// Adds up the balances of all ranks.
void sumOver(Ranks& ranks, PowerBalance& balance);

/// Throws std::overflow_error when cell sums might overflow.
void checkReceived(const PowerBalance& balance);

/// Adds a part to a total that threads share. Throws as checkReceived() does.
void addLocked(const PowerBalance& part, PowerBalance& total, std::mutex& mutex);

/// Whether more was absorbed than there is, beyond noise and rounding; W in a band. `error`: the
/// standard error of what escaped.
inline bool isExcess(double emitted, double escaped, double error)
{
  constexpr double kSure = 5, kRounding = 1e-9;
  return escaped < -kSure * error - kRounding * emitted;
}

}

#endif
