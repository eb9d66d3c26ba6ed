// SPDX-License-Identifier: BSD-3-Clause
#include "Rivals/SobolNumbers.h"

#include <cstddef>

namespace
{

/// Of Joe and Kuo 2008, "Constructing Sobol sequences with better two-dimensional projections".
struct Dimension
{
  unsigned degree, polynomial;
  std::uint32_t first[5]; ///< direction numbers
};

constexpr Dimension kDimensions[] = { { 1, 0, { 1 } }, { 2, 1, { 1, 3 } }, { 3, 1, { 1, 3, 1 } },
  { 3, 2, { 1, 1, 1 } }, { 4, 1, { 1, 1, 3, 3 } }, { 4, 4, { 1, 3, 5, 13 } },
  { 5, 2, { 1, 1, 5, 5, 17 } } };

using Directions = std::array<std::uint32_t, 32>;

Directions directionsOf(const Dimension& dimension)
{
  const auto [degree, polynomial, first] = dimension;
  Directions directions{};
  for (unsigned i = 0; i < 32; ++i)
  {
    if (i < degree)
    {
      directions[i] = first[i] << (31 - i);
      continue;
    }
    directions[i] = directions[i - degree] ^ (directions[i - degree] >> degree);
    for (unsigned k = 1; k < degree; ++k)
    {
      directions[i] ^= (polynomial >> (degree - 1 - k)) % 2 * directions[i - k];
    }
  }
  return directions;
}

/// Radical inverses.
Directions firstDirections()
{
  Directions directions{};
  for (unsigned i = 0; i < 32; ++i)
  {
    directions[i] = 1u << (31 - i);
  }
  return directions;
}

}

SobolNumbers makeSobolNumbers(std::uint32_t count)
{
  SobolNumbers numbers(count);
  for (std::size_t d = 0; d < numbers[0].size(); ++d)
  {
    const Directions directions = d == 0 ? firstDirections() : directionsOf(kDimensions[d - 1]);
    for (std::uint32_t i = 1; i < count; ++i)
    {
      // Like the number without its lowest bit, but for the direction of that bit.
      unsigned lowest = 0;
      while ((i >> lowest) % 2 == 0)
      {
        ++lowest;
      }
      numbers[i][d] = numbers[i & (i - 1)][d] ^ directions[lowest];
    }
  }
  return numbers;
}
