// SPDX-License-Identifier: BSD-3-Clause
#ifdef __x86_64__

#include "Estimates/CellDiffusion.h"
#include "Simd/SimdTarget.h"

#include <immintrin.h>

IRRADIANCE_TARGET_BEGIN(IRRADIANCE_AVX2)

#include "Estimates/CellDiffusion.inl"

namespace irradiance
{
namespace
{

struct Avx2Numbers
{
  using Numbers = __m256d;
  static constexpr unsigned kCount = 4;

  static Numbers all(double value) { return _mm256_set1_pd(value); }
  static Numbers load(const double* values) { return _mm256_loadu_pd(values); }
  static void store(double* values, Numbers numbers) { _mm256_storeu_pd(values, numbers); }
  static Numbers truncated(Numbers numbers)
  {
    return _mm256_round_pd(numbers, _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC);
  }
};

}

void flowAvx2(const CellDiffusion::Link* links, std::size_t count, unsigned fields,
  const double* before, double* quanta)
{
  flowBy<Avx2Numbers>(links, count, fields, before, quanta);
}

}

IRRADIANCE_TARGET_END

#endif
