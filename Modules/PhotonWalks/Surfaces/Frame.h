// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Scene/Scene.h"
#include "Surfaces/Contacts.h"
#include "Surfaces/KeptParts.h"
#include "Surfaces/ObjectSides.h"
#include "Surfaces/SceneCells.h"
#include "Surfaces/SceneObjects.h"
#include "Surfaces/SceneTriangles.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace irradiance
{

/// Whether any object moved.
inline bool hasMotion(const std::vector<bool>& moved)
{
  return std::find(moved.begin(), moved.end(), true) != moved.end();
}

/// By object, the material that it had in the frame before if its cells may reflect otherwise now,
/// else null; empty if none may.
using Repainted = std::vector<std::shared_ptr<const Material>>;

/// A scene at one time: what there is, and all that follows from where it is. It is made once and
/// handed down to whoever works on that time.
struct Frame
{
  SceneObjects objects;
  SceneCells cells;
  SceneTriangles triangles;
  Scene scene; ///< to cast rays in
  Contacts contacts;
  ObjectSides sides; ///< known where cells gather direct light
  /// For each dynamic object, whether it moved since the frame before; empty after a fresh start.
  std::vector<bool> moved;
  Repainted repainted;
  KeptParts kept; ///< of the frame before

  /// Whether stored walks of the frame before may go other ways.
  bool hasChanged() const { return hasMotion(moved) || !repainted.empty() || !kept.areAll(); }
};

}
