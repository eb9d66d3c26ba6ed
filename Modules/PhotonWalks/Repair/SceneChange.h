// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SceneChange_h
#define irradiance_SceneChange_h

#include "Surfaces/SceneObjects.h"

#include <vector>

namespace irradiance
{

/// What the stored walks need to follow to a frame.
struct FrameChange
{
  enum Kind
  {
    Still,   ///< nothing: no walk can have changed
    Motion,  ///< verification and repair
    Replace, ///< likewise, and sums for objects that look different; no walk has touched these
    Fresh    ///< all are shot again
  };

  Kind kind;
  std::vector<bool> moved; ///< for each dynamic object, see findMoved(); empty if all is fresh
};

/// Whether two frames have the same lights. Cheap: it compares addresses and poses, so false does
/// not prove that they changed.
bool areLightsUnchanged(const SceneObjects& now, const SceneObjects& before);

/// Whether two frames differ at most in which dynamic objects are there, in their poses and in
/// their points, and in the look of objects that were not there before.
bool differsOnlyByMotion(const SceneObjects& now, const SceneObjects& before);

/// Whether an object has another material or another number of triangles, or there are more or
/// fewer objects.
bool hasReplaced(const SceneObjects& now, const SceneObjects& before);

/// Which dynamic objects have come or gone, or have another pose or other points. Both frames have
/// as many of them.
std::vector<bool> findMoved(const SceneObjects& now, const SceneObjects& before);

}

#endif
