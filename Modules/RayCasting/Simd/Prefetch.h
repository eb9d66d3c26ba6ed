// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Prefetch_h
#define irradiance_Prefetch_h

namespace irradiance
{

/// Has the memory bring the line of an address that will be read soon; any address will do.
__attribute__((always_inline)) inline void prefetchLine(const void* address)
{
  __builtin_prefetch(address);
  // Without this, GCC 12 takes a function that does nothing else for one without effect, and drops
  // the calls of it.
  __asm__ volatile("");
}

}

#endif
