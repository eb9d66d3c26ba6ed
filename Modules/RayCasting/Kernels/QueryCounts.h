// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_QueryCounts_h
#define irradiance_QueryCounts_h

#include <cstdint>

namespace irradiance
{

/// What searches did, in numbers.
struct QueryCounts
{
  std::uint64_t treelets = 0; ///< entered
  std::uint64_t blocks = 0;   ///< of eight triangles, tested in float

  QueryCounts& operator+=(const QueryCounts& other)
  {
    treelets += other.treelets;
    blocks += other.blocks;
    return *this;
  }
};

/// Where the searches of this thread are counted; null, the initial value, if they are not. Only
/// tests are built so that they can be: the kernels exist twice then.
#ifdef VTKIRRADIANCE_COUNT_QUERIES
inline QueryCounts*& queryCounts()
{
  static thread_local QueryCounts* counts = nullptr;
  return counts;
}
#else
constexpr QueryCounts* queryCounts()
{
  return nullptr;
}
#endif

}

#endif
