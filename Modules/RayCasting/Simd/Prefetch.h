// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace irradiance
{

/// Prefetches the cache line of an address that will be read soon. Any address is allowed.
__attribute__((always_inline)) inline void prefetchLine(const void* address)
{
  __builtin_prefetch(address);
  // Without this, GCC 12 considers the function free of side effects and drops calls to it.
  __asm__ volatile("");
}

}
