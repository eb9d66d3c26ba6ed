// SPDX-License-Identifier: BSD-3-Clause
#include "Kernels/FrontStages.h"

#include "Simd/SimdLevel.h"

namespace irradiance
{

const FrontStages& frontStages()
{
  return IRRADIANCE_CALL_BEST(frontStages, );
}

}
