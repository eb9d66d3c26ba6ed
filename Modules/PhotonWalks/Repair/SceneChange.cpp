// SPDX-License-Identifier: BSD-3-Clause
#include "Repair/SceneChange.h"

#include <algorithm>

namespace irradiance
{

namespace
{

bool hasSameCells(const SceneObject& now, const SceneObject& before)
{
  return now.lampCells == before.lampCells &&
    now.body->mesh().size() == before.body->mesh().size() &&
    now.material->hasCellsOf(*before.material);
}

/// Whether both frames have the same number of objects, and `isSame` holds for each pair.
template <class Function>
bool isSameForAll(const SceneObjects& now, const SceneObjects& before, const Function& isSame)
{
  bool same = now.size() == before.size();
  for (std::uint32_t i = 0; same && i < now.size(); ++i)
  {
    same = isSame(now[i], before[i]);
  }
  return same;
}

}

bool areLightsUnchanged(const SceneObjects& now, const SceneObjects& before)
{
  // Which lights are near static cells is known of them as well, and how many walks start where
  // they are gathered.
  return now.staticObject.body == before.staticObject.body &&
    now.staticObject.material == before.staticObject.material && now.sky == before.sky &&
    isSameForAll(now, before, [](const SceneObject& a, const SceneObject& b) {
      return !(a.emits() || b.emits()) || (isSameThing(a, b) && !hasMoved(a, b));
    });
}

SceneObjects withAsMany(SceneObjects before, const SceneObjects& now)
{
  before.dynamicObjects.resize(std::min(now.dynamicObjects.size(), before.dynamicObjects.size()));
  for (std::uint32_t i = before.size(); i < now.size(); ++i)
  {
    before.dynamicObjects.push_back(now[i]);
    before.dynamicObjects.back().isPresent = false;
  }
  return before;
}

bool hasAllCells(const SceneObjects& now, const SceneObjects& before)
{
  return isSameForAll(now, before, [&](const SceneObject& a, const SceneObject& b) {
    // No stored walk has hit an absent object.
    const bool mayDiffer = !b.isPresent || (&b == &before.staticObject && a.body != b.body);
    return mayDiffer || hasSameCells(a, b);
  });
}

bool hasReplaced(const SceneObjects& now, const SceneObjects& before)
{
  return !isSameForAll(now, before, hasSameCells);
}

Repainted findRepainted(const SceneObjects& now, const SceneObjects& before)
{
  Repainted repainted(now.size());
  bool isAny = false;
  for (std::uint32_t i = 0; i < now.size(); ++i)
  {
    if (now[i].material != before[i].material && hasSameCells(now[i], before[i]) &&
      (i > 0 || now[0].body == before[0].body))
    {
      repainted[i] = before[i].material;
      isAny = true;
    }
  }
  return isAny ? repainted : Repainted();
}

std::vector<bool> findMoved(const SceneObjects& now, const SceneObjects& before)
{
  std::vector<bool> moved;
  for (std::size_t i = 0; i < now.dynamicObjects.size(); ++i)
  {
    moved.push_back(hasMoved(now.dynamicObjects[i], before.dynamicObjects[i]));
  }
  return moved;
}

}
