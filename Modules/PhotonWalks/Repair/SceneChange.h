// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Surfaces/Frame.h"

#include <algorithm>
#include <vector>

namespace irradiance
{

/// What the stored walks need to follow to a frame. Documentation/Theory.md, section 4, lists what
/// each change costs, and which ones take a fresh start.
struct FrameChange
{
  enum Kind
  {
    Still,   ///< nothing: no walk can have changed
    Repair,  ///< verification and repair, and another number of walks
    Replace, ///< likewise, and sums for objects of other cells; no walk has touched these
    Fresh    ///< all are shot again
  };

  Kind kind = Fresh;
  std::vector<bool> moved{}; ///< for each dynamic object, see findMoved(); empty if all is fresh
  Repainted repainted{};     ///< see findRepainted(); empty if all is fresh
  KeptParts kept{};          ///< where parts come or go
  bool resizes = false;      ///< another number of walks; those that were shot and stay are a part
};

/// Whether an object has the same cells and as many triangles.
inline bool hasSameCells(const SceneObject& now, const SceneObject& before)
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

/// Whether two frames have the same lights. Cheap: it compares addresses and poses, so false does
/// not prove that they changed.
inline bool areLightsUnchanged(const SceneObjects& now, const SceneObjects& before)
{
  // Which lights are near static cells is known of them as well, and how many walks start where
  // they are gathered.
  return now.staticObject.body == before.staticObject.body &&
    now.staticObject.material == before.staticObject.material && now.sky == before.sky &&
    isSameForAll(now, before, [](const SceneObject& a, const SceneObject& b) {
      return !(a.emits() || b.emits()) || (isSameThing(a, b) && !hasMoved(a, b));
    });
}

/// The frame before with as many objects as there are now. Those that have come since were not there,
/// those that are gone are left out.
inline SceneObjects withAsMany(SceneObjects before, const SceneObjects& now)
{
  before.dynamicObjects.resize(std::min(now.dynamicObjects.size(), before.dynamicObjects.size()));
  for (std::uint32_t i = before.size(); i < now.size(); ++i)
  {
    before.dynamicObjects.push_back(now[i]);
    before.dynamicObjects.back().isPresent = false;
  }
  return before;
}

/// Whether two frames differ at most in the static body, in which dynamic objects are there, in
/// their poses and in their points, in how cells reflect and emit, and in the cells of objects that
/// were not there before.
inline bool hasAllCells(const SceneObjects& now, const SceneObjects& before)
{
  return isSameForAll(now, before, [&](const SceneObject& a, const SceneObject& b) {
    // No stored walk has hit an absent object.
    const bool mayDiffer = !b.isPresent || (&b == &before.staticObject && a.body != b.body);
    return mayDiffer || hasSameCells(a, b);
  });
}

/// Whether an object has other cells or another number of triangles, or there are more or fewer
/// objects.
inline bool hasReplaced(const SceneObjects& now, const SceneObjects& before)
{
  return !isSameForAll(now, before, hasSameCells);
}

/// The objects with the same cells in another material, but for a static object of another body.
/// Both frames have as many objects.
inline Repainted findRepainted(const SceneObjects& now, const SceneObjects& before)
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

/// Which dynamic objects have come or gone, or have another pose or other points. Both frames have
/// as many of them.
inline std::vector<bool> findMoved(const SceneObjects& now, const SceneObjects& before)
{
  std::vector<bool> moved;
  for (std::size_t i = 0; i < now.dynamicObjects.size(); ++i)
  {
    moved.push_back(hasMoved(now.dynamicObjects[i], before.dynamicObjects[i]));
  }
  return moved;
}

}
