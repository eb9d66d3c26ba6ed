// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Transpose4_h
#define irradiance_Transpose4_h

#include <cstring>

namespace irradiance
{

/// Turns four rows of four numbers into four columns. Is compiled once for each instruction set.
template <class Number>
__attribute__((always_inline)) inline void transpose4(
  const Number* const (&rows)[4], Number* const (&columns)[4])
{
  typedef Number Four __attribute__((vector_size(4 * sizeof(Number))));
  Four a, b, c, d;
  std::memcpy(&a, rows[0], sizeof(Four));
  std::memcpy(&b, rows[1], sizeof(Four));
  std::memcpy(&c, rows[2], sizeof(Four));
  std::memcpy(&d, rows[3], sizeof(Four));
  // Within halves of two, then by halves: both are cheap in all instruction sets.
  const Four evenAb = __builtin_shufflevector(a, b, 0, 4, 2, 6);
  const Four oddAb = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Four evenCd = __builtin_shufflevector(c, d, 0, 4, 2, 6);
  const Four oddCd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  const Four first = __builtin_shufflevector(evenAb, evenCd, 0, 1, 4, 5);
  const Four second = __builtin_shufflevector(oddAb, oddCd, 0, 1, 4, 5);
  const Four third = __builtin_shufflevector(evenAb, evenCd, 2, 3, 6, 7);
  const Four fourth = __builtin_shufflevector(oddAb, oddCd, 2, 3, 6, 7);
  std::memcpy(columns[0], &first, sizeof(Four));
  std::memcpy(columns[1], &second, sizeof(Four));
  std::memcpy(columns[2], &third, sizeof(Four));
  std::memcpy(columns[3], &fourth, sizeof(Four));
}

}

#endif
