// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Scene/RigidObject.h"
#include "Surfaces/Emission.h"
#include "Surfaces/Material.h"
#include "Surfaces/Sky.h"

#include <memory>
#include <vector>

namespace irradiance
{

/// Geometry, pose, material and emission of one object of the scene.
struct SceneObject : PlacedBody
{
  std::shared_ptr<const Material> material;
  std::shared_ptr<const Emission> emission; ///< null: none
  /// By cell, whether it counts as a lamp where it coincides with others, even if other light than
  /// its own is computed; null: if it has exitance.
  std::shared_ptr<const std::vector<bool>> lampCells{};

  bool emits() const { return emission && !emission->isEmpty(); }
  /// W/m2 by band; null if the object has no exitance.
  const double* exitanceOf(std::size_t cell) const
  {
    return emission ? emission->exitanceOf(cell) : nullptr;
  }
  bool hasExitance(std::size_t cell) const { return emission && emission->hasExitance(cell); }
  bool isLamp(std::uint32_t triangle) const
  {
    const std::uint32_t cell = material->cellOfTriangle[triangle];
    return lampCells ? (*lampCells)[cell] : hasExitance(cell);
  }
};

/// The whole input of a frame. Object 0 is the static one, object i + 1 is dynamicObjects[i].
struct SceneObjects
{
  SceneObject staticObject; ///< its pose is the identity
  std::vector<SceneObject> dynamicObjects;
  std::shared_ptr<const Sky> sky{}; ///< null: none

  const SceneObject& operator[](std::uint32_t object) const
  {
    return object == 0 ? staticObject : dynamicObjects[object - 1];
  }
  std::uint32_t size() const { return static_cast<std::uint32_t>(dynamicObjects.size() + 1); }
  /// Of all objects.
  Box worldBounds() const
  {
    Box all = staticObject.worldBounds();
    for (const SceneObject& object : dynamicObjects)
    {
      all.add(object.worldBounds());
    }
    return all;
  }
  /// The dynamic objects as the ray casting sees them.
  std::vector<PlacedBody> dynamicBodies() const
  {
    return { dynamicObjects.begin(), dynamicObjects.end() };
  }
};

/**
 * Flattens the dynamic objects of few triangles if there are many of them, and instances all
 * others. Then one tree over single moving triangles (section 2.2 of the paper), rebuilt in each
 * frame, is faster than a tree for each object; Documentation/Performance.md has the measurements.
 * Results do not depend on it.
 */
void flattenManySmall(SceneObjects& objects);

/// Whether an object has come or gone, or has another pose or other points.
bool hasMoved(const SceneObject& now, const SceneObject& before);

/// Whether two frames of an object have the same body and the same cells, which reflect and emit
/// alike.
bool isSameThing(const SceneObject& now, const SceneObject& before);

/// World area of every cell, m2; 0 if the object is not there.
std::vector<double> cellAreas(const SceneObject& object, const CancelPoint& cancelPoint = {});

/// The part of the light that an object reflects or lets through, in whatever way, if it arrives
/// alike everywhere: the mean over its area and the bands, 0..1; 0 for an object without area.
double meanReflectance(const SceneObject& object);

}
