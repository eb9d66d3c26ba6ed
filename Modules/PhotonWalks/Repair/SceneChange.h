// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SceneChange_h
#define irradiance_SceneChange_h

#include "Surfaces/Frame.h"

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

/// Whether two frames have the same lights. Cheap: it compares addresses and poses, so false does
/// not prove that they changed.
bool areLightsUnchanged(const SceneObjects& now, const SceneObjects& before);

/// The frame before with as many objects as there are now. Those that have come since were not there,
/// those that are gone are left out.
SceneObjects withAsMany(SceneObjects before, const SceneObjects& now);

/// Whether two frames differ at most in the static body, in which dynamic objects are there, in
/// their poses and in their points, in how cells reflect and emit, and in the cells of objects that
/// were not there before.
bool hasAllCells(const SceneObjects& now, const SceneObjects& before);

/// Whether an object has other cells or another number of triangles, or there are more or fewer
/// objects.
bool hasReplaced(const SceneObjects& now, const SceneObjects& before);

/// The objects with the same cells in another material, but for a static object of another body.
/// Both frames have as many objects.
Repainted findRepainted(const SceneObjects& now, const SceneObjects& before);

/// Which dynamic objects have come or gone, or have another pose or other points. Both frames have
/// as many of them.
std::vector<bool> findMoved(const SceneObjects& now, const SceneObjects& before);

}

#endif
