// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/KeptParts.h"

#include "Scene/TriangleNumbers.h"

#include <algorithm>
#include <numeric>

namespace irradiance
{

namespace
{

/// Of the static object: its triangles follow each other, and its cells.
struct StaticPart
{
  std::size_t firstTriangle, endTriangle, firstCell, endCell;

  bool isEmpty() const { return firstTriangle == endTriangle; }
};

std::vector<StaticPart> staticPartsOf(const SceneObject& object)
{
  const Material& material = *object.material;
  std::vector<std::size_t> firsts = material.firstCellOfPart;
  firsts.resize(std::max<std::size_t>(firsts.size(), 1));
  std::vector<StaticPart> parts;
  std::size_t triangle = 0;
  for (std::size_t i = 0; i < firsts.size(); ++i)
  {
    const std::size_t end = i + 1 < firsts.size() ? firsts[i + 1] : material.numberOfCells;
    parts.push_back({ triangle, triangle, firsts[i], end });
    while (triangle < material.cellOfTriangle.size() && material.cellOfTriangle[triangle] < end)
    {
      parts.back().endTriangle = ++triangle;
    }
  }
  return parts;
}

bool areEqual(
  const SceneObject& a, const StaticPart& of, const SceneObject& b, const StaticPart& other)
{
  bool areSame = of.endTriangle - of.firstTriangle == other.endTriangle - other.firstTriangle &&
    of.endCell - of.firstCell == other.endCell - other.firstCell;
  for (std::size_t i = 0; areSame && i < of.endTriangle - of.firstTriangle; ++i)
  {
    const std::size_t own = of.firstTriangle + i, its = other.firstTriangle + i;
    areSame = a.body->mesh()[own] == b.body->mesh()[its] &&
      a.material->cellOfTriangle[own] - of.firstCell ==
        b.material->cellOfTriangle[its] - other.firstCell;
  }
  for (std::size_t cell = of.firstCell; areSame && cell < of.endCell; ++cell)
  {
    areSame = a.material->actsAs(cell, *b.material, other.firstCell + (cell - of.firstCell));
  }
  return areSame;
}

TriangleNumbers triangleNumbersOf(const SceneObjects& objects)
{
  std::vector<std::size_t> sizes;
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    sizes.push_back(objects[i].body->mesh().size());
  }
  return TriangleNumbers(sizes);
}

Box boundsOf(const TriangleMesh& mesh, const StaticPart& part)
{
  Box bounds;
  for (std::size_t i = part.firstTriangle; i < part.endTriangle; ++i)
  {
    bounds.add(mesh[i].bounds());
  }
  return bounds;
}

/// Numbers from `first` on, in place of those from `place` on.
void number(
  std::vector<std::uint32_t>& numbers, std::size_t place, std::size_t end, std::size_t first)
{
  std::iota(numbers.begin() + static_cast<std::ptrdiff_t>(place),
    numbers.begin() + static_cast<std::ptrdiff_t>(end), static_cast<std::uint32_t>(first));
}

void keepStaticParts(const SceneObject& now, const SceneObject& before, KeptParts& kept)
{
  const std::vector<StaticPart> parts = staticPartsOf(now);
  auto next = parts.begin();
  const auto addUpTo = [&](auto end) {
    for (; next != end; ++next)
    {
      if (!next->isEmpty())
      {
        kept.added.push_back(boundsOf(now.body->mesh(), *next));
      }
    }
  };
  kept.isAnyStatic = false;
  for (const StaticPart& old : staticPartsOf(before))
  {
    const auto same = std::find_if(
      next, parts.end(), [&](const StaticPart& part) { return areEqual(now, part, before, old); });
    if (same != parts.end())
    {
      addUpTo(same);
      number(kept.triangles, old.firstTriangle, old.endTriangle, same->firstTriangle);
      number(kept.staticCells, old.firstCell, old.endCell, same->firstCell);
      kept.isAnyStatic = kept.isAnyStatic || !old.isEmpty();
      ++next;
    }
  }
  addUpTo(parts.end());
}

}

KeptParts keptParts(const SceneObjects& now, const SceneObjects& before)
{
  KeptParts kept;
  const SceneObject &staticNow = now.staticObject, &staticBefore = before.staticObject;
  if (staticNow.body == staticBefore.body && now.size() == before.size())
  {
    return kept;
  }
  const TriangleNumbers numbers = triangleNumbersOf(now), old = triangleNumbersOf(before);
  kept.triangles.resize(old.size(), KeptParts::kNone);
  kept.staticCells.resize(staticBefore.material->numberOfCells, KeptParts::kNone);
  if (staticNow.body == staticBefore.body)
  {
    number(kept.triangles, 0, old.first(1), 0);
    number(kept.staticCells, 0, kept.staticCells.size(), 0);
  }
  else
  {
    keepStaticParts(staticNow, staticBefore, kept);
  }
  for (std::uint32_t i = 1; i < std::min(now.size(), before.size()); ++i)
  {
    number(kept.triangles, old.first(i), old.first(i + 1), numbers.first(i));
  }
  return kept;
}

}
