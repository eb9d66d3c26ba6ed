// SPDX-License-Identifier: BSD-3-Clause
#include "Kernels/QueryCounts.h"

namespace irradiance
{

QueryCounts*& queryCounts()
{
  static thread_local QueryCounts* counts = nullptr;
  return counts;
}

}
