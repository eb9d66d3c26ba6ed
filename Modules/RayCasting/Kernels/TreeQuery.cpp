// SPDX-License-Identifier: BSD-3-Clause
#include "Kernels/TreeQuery.h"

#include "Simd/SimdLevel.h"

namespace irradiance
{

void runQueries(QuerySource& source)
{
  IRRADIANCE_CALL_BEST(runQueries, source);
}

}
