// SPDX-License-Identifier: BSD-3-Clause
#ifdef __x86_64__

#include "Estimates/CellDiffusion.h"
#include "Simd/SimdTarget.h"

#include <immintrin.h>

IRRADIANCE_TARGET_BEGIN(IRRADIANCE_AVX2)

namespace irradiance
{
namespace
{

using FourNumbers = double __attribute__((vector_size(32)));

inline FourNumbers truncated(FourNumbers numbers)
{
  return _mm256_round_pd(numbers, _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC);
}

}
}

#include "Estimates/CellDiffusion.inl"

namespace irradiance
{

void flowAvx2(const CellDiffusion::Link* links, std::size_t count, unsigned fields,
  const double* before, double* quanta)
{
  flowBy<FourNumbers>(links, count, fields, before, quanta);
}

}

IRRADIANCE_TARGET_END

#endif
