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
  std::int64_t segments = 0;
  double received = 0; ///< by all cells in all bands; shows an overflow before it happens

  PowerBalance& operator+=(const PowerBalance& other);
};

/// Adds up the balances of all ranks.
void sumOver(Ranks& ranks, PowerBalance& balance);

/// Throws std::overflow_error when cell sums might overflow.
void checkReceived(const PowerBalance& balance);

/// A balance to which several threads add.
class SharedBalance
{
public:
  /// `total` must outlive this.
  explicit SharedBalance(PowerBalance& total)
    : total_(total)
  {
  }

  /// Throws as checkReceived() does.
  void add(const PowerBalance& part);

private:
  PowerBalance& total_;
  std::mutex mutex_;
};

}

#endif
