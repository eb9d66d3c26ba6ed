// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/**
 * Functions between IRRADIANCE_TARGET_BEGIN and IRRADIANCE_TARGET_END may use the instructions
 * named, whichever machine compiles them. Include all other headers first: what they define must
 * run on every machine. Such functions belong in an unnamed namespace, so that the linker never
 * substitutes one of them for a plain one.
 */
#define IRRADIANCE_PRAGMA(text) _Pragma(#text)
#ifdef __clang__
#define IRRADIANCE_TARGET_BEGIN(list)                                                              \
  IRRADIANCE_PRAGMA(clang attribute push(__attribute__((target(list))), apply_to = function))
#define IRRADIANCE_TARGET_END IRRADIANCE_PRAGMA(clang attribute pop)
#else
#define IRRADIANCE_TARGET_BEGIN(list)                                                              \
  IRRADIANCE_PRAGMA(GCC push_options) IRRADIANCE_PRAGMA(GCC target(list))
#define IRRADIANCE_TARGET_END IRRADIANCE_PRAGMA(GCC pop_options)
#endif

#define IRRADIANCE_AVX2 "avx2,fma,bmi,bmi2,popcnt,lzcnt"
#define IRRADIANCE_AVX512 "avx512f,avx512vl,avx512bw,avx512dq," IRRADIANCE_AVX2
