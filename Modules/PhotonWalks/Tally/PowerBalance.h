// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Execution/Ranks.h"
#include "Surfaces/Power.h"

#include <array>
#include <cstdint>
#include <mutex>
#include <stdexcept>

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

  PowerBalance& operator+=(const PowerBalance& other)
  {
    emitted += other.emitted;
    absorbed += other.absorbed;
    escaped += other.escaped;
    unmet += other.unmet;
    segments += other.segments;
    received += other.received;
    return *this;
  }

  /// Where all photons had as many quanta, and now have others.
  void rescale(std::int64_t quantaBefore, std::int64_t quanta)
  {
    for (Power* const power : { &emitted, &absorbed, &escaped, &unmet })
    {
      for (std::int64_t& sum : power->quanta)
      {
        sum = sum / quantaBefore * quanta;
      }
    }
    received *= static_cast<double>(quanta) / static_cast<double>(quantaBefore);
  }
};

/// Throws std::overflow_error when cell sums might overflow.
inline void checkReceived(const PowerBalance& balance)
{
  if (balance.received > 0x1p62)
  {
    throw std::overflow_error("the cells receive more than 2^16 times the emitted power: the "
                              "reflectances of a closed scene are too near 1");
  }
}

/// Adds up the balances of all ranks.
inline void sumOver(Ranks& ranks, PowerBalance& balance)
{
  for (Power* power : { &balance.emitted, &balance.absorbed, &balance.escaped, &balance.unmet })
  {
    ranks.sum(power->quanta.data(), power->quanta.size());
  }
  constexpr double kUnit = 0x1p20; // so that the sum of many ranks does not overflow
  std::array<std::int64_t, 2> counts{ balance.segments,
    static_cast<std::int64_t>(balance.received / kUnit) };
  ranks.sum(counts.data(), counts.size());
  balance.segments = counts[0];
  balance.received = kUnit * static_cast<double>(counts[1]);
  checkReceived(balance);
}

/// Adds a part to a total that threads share. Throws as checkReceived() does.
inline void addLocked(const PowerBalance& part, PowerBalance& total, std::mutex& mutex)
{
  const std::lock_guard<std::mutex> lock(mutex);
  total += part;
  checkReceived(total);
}

/// Whether more was absorbed than there is, beyond noise and rounding; W in a band. `error`: the
/// standard error of what escaped.
inline bool isExcess(double emitted, double escaped, double error)
{
  constexpr double kSure = 5, kRounding = 1e-9;
  return escaped < -kSure * error - kRounding * emitted;
}

}
