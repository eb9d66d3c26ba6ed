// SPDX-License-Identifier: BSD-3-Clause
#ifdef __x86_64__

#include "Kernels/PrepareLanes.h"
#include "Sampling/DirectionSampling.h"
#include "Shooting/FrontLoops.h"
#include "Simd/Prefetch.h"
#include "Simd/SimdTarget.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <immintrin.h>

namespace irradiance
{
namespace
{

/// For each mask of eight lanes those that it chooses, in order.
alignas(64) constexpr auto kChosen = [] {
  std::array<std::array<std::uint8_t, 8>, 256> chosen{};
  for (unsigned mask = 0; mask < 256; ++mask)
  {
    unsigned kept = 0;
    for (unsigned lane = 0; lane < 8; ++lane)
    {
      if ((mask >> lane & 1u) != 0)
      {
        chosen[mask][kept++] = static_cast<std::uint8_t>(lane);
      }
    }
  }
  return chosen;
}();

}
}

IRRADIANCE_TARGET_BEGIN(IRRADIANCE_AVX2)

#include "Shooting/FrontLoops.inl"

namespace irradiance
{
namespace
{

struct Avx2Lanes
{
  static std::uint32_t maskOf(const std::uint32_t* flags)
  {
    return eight(flags) | eight(flags + 8) << 8 | eight(flags + 16) << 16 | eight(flags + 24) << 24;
  }

  static void transpose(const double* const (&rows)[4], double* const (&columns)[4])
  {
    transpose4(rows, columns);
  }

  class Packing
  {
  public:
    explicit Packing(unsigned mask)
    {
      for (unsigned i = 0; i < 2; ++i)
      {
        const unsigned lanes = mask >> 8 * i & 0xffu;
        bytes_[i] = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(kChosen[lanes].data()));
        words_[i] = _mm256_cvtepu8_epi32(bytes_[i]);
      }
      for (unsigned i = 0; i < 4; ++i)
      {
        const unsigned lanes = mask >> 4 * i & 0xfu;
        const __m256i lane = _mm256_cvtepu8_epi64(
          _mm_loadl_epi64(reinterpret_cast<const __m128i*>(kChosen[lanes].data())));
        // A double is two words: 2 lane and 2 lane + 1.
        doubles_[i] = _mm256_or_si256(_mm256_slli_epi64(lane, 1),
          _mm256_add_epi64(_mm256_slli_epi64(lane, 33), _mm256_set1_epi64x(0x100000000)));
        quarters_[i] = __builtin_popcount(lanes);
      }
    }

    /// Values of one word or two.
    template <class Value>
    void operator()(const Value* from, Value* to) const
    {
      constexpr bool isWord = sizeof(Value) == 4;
      constexpr std::size_t kLanes = isWord ? 8 : 4;
      for (std::size_t i = 0; i < kPacked / kLanes; ++i)
      {
        const __m256i all = _mm256_load_si256(reinterpret_cast<const __m256i*>(from + kLanes * i));
        const __m256i kept = _mm256_permutevar8x32_epi32(all, isWord ? words_[i] : doubles_[i]);
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), kept);
        to += isWord ? quarters_[0] + quarters_[1] : quarters_[i];
      }
    }
    void operator()(const std::uint8_t* from, std::uint8_t* to) const
    {
      for (unsigned i = 0; i < 2; ++i)
      {
        const __m128i all =
          _mm_loadl_epi64(reinterpret_cast<const __m128i*>(from + std::size_t{ 8 } * i));
        _mm_storel_epi64(reinterpret_cast<__m128i*>(to), _mm_shuffle_epi8(all, bytes_[i]));
        to += quarters_[0] + quarters_[1];
      }
    }

  private:
    __m128i bytes_[2];
    __m256i words_[2], doubles_[4];
    int quarters_[4]; ///< how many stay of four lanes
  };

private:
  static std::uint32_t eight(const std::uint32_t* flags)
  {
    const __m256i all = _mm256_load_si256(reinterpret_cast<const __m256i*>(flags));
    return static_cast<std::uint32_t>(
      _mm256_movemask_ps(_mm256_castsi256_ps(_mm256_slli_epi32(all, 31))));
  }
};

}

const FrontLoops& frontLoopsAvx2()
{
  return kLoops<Avx2Lanes>;
}

}

IRRADIANCE_TARGET_END

#endif
