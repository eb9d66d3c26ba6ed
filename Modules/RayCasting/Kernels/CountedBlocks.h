// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace irradiance
{

/// Where the searches of this thread count the blocks of eight triangles that they test in float;
/// null, the initial value, if they do not. Only tests are built so that they can: the kernels
/// exist twice then.
#ifdef VTKIRRADIANCE_COUNT_QUERIES
inline std::uint64_t*& countedBlocks()
{
  static thread_local std::uint64_t* count = nullptr;
  return count;
}
#else
constexpr std::uint64_t* countedBlocks()
{
  return nullptr;
}
#endif

}
