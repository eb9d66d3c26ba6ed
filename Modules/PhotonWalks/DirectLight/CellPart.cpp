// SPDX-License-Identifier: BSD-3-Clause
#include "DirectLight/CellPart.h"

#include <algorithm>

namespace irradiance
{

namespace
{

constexpr std::size_t kMostDynamic = 8;

/// Of the sums of all dynamic parts together.
constexpr std::size_t kMostCells = std::size_t{ 1 } << 19;

}

std::vector<CellPart> cellParts(const SceneObjects& objects)
{
  std::size_t cells = 1;
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    cells += objects[i].material->numberOfCells;
  }
  const std::size_t dynamic = objects.dynamicObjects.size();
  const std::size_t parts =
    std::min({ dynamic, kMostDynamic, std::max<std::size_t>(1, kMostCells / cells) });
  std::vector<CellPart> all(1);
  for (std::size_t i = 0; i < parts; ++i)
  {
    all.push_back({ static_cast<std::uint32_t>(1 + i * dynamic / parts),
      static_cast<std::uint32_t>(1 + (i + 1) * dynamic / parts) });
  }
  return all;
}

}
