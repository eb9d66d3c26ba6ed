// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_GatherOn_h
#define irradiance_GatherOn_h

namespace irradiance
{

/// Which cells look for their indirect light themselves.
enum class GatherOn
{
  Small,   ///< those that expect few photons for each ray
  Dynamic, ///< these, and all of dynamic objects
  All
};

}

#endif
