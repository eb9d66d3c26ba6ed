// SPDX-License-Identifier: BSD-3-Clause
#ifdef __x86_64__

#include "Kernels/CountedBlocks.h"
#include "Kernels/FrontStages.h"
#include "Simd/SimdTarget.h"
#include "Trees/KdTreeBuilder.h"

#include <algorithm>
#include <cstring>
#include <immintrin.h>

IRRADIANCE_TARGET_BEGIN(IRRADIANCE_AVX2)

#include "Kernels/Avx2Lanes.inl"
#include "Kernels/FrontStages.inl"

namespace irradiance
{

const FrontStages& frontStagesAvx2()
{
  return kStages<Avx2Lanes, Avx2Lanes>;
}

}

IRRADIANCE_TARGET_END

#endif
