// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "TestScenes.h"

/// Choices.
namespace RandomModels
{

using namespace TestScenes;

inline bool Chance(RandomNumbers& random, int oneIn)
{
  return random.Below(oneIn) == 0;
}

template <class T>
T& Pick(RandomNumbers& random, std::vector<T>& from)
{
  return from[static_cast<std::size_t>(random.Below(static_cast<int>(from.size())))];
}

inline Vector RandomPlace(RandomNumbers& random)
{
  return { random.Between(-0.2, 3.2), random.Between(-0.2, 3.2), random.Between(-0.2, 3.2) };
}

}
