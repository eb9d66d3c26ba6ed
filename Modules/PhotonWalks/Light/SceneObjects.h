#ifndef irradiance_SceneObjects_h
#define irradiance_SceneObjects_h

#include "Light/Surface.h"
#include "Scene/RigidObject.h"

#include <memory>
#include <vector>

namespace irradiance
{

/// Geometry, surface and pose of one object of the scene.
struct SceneObject
{
  std::shared_ptr<const RigidObject> body;
  std::shared_ptr<const Surface> surface;
  AffineMap worldFromObject;
  bool isLoose = false; ///< see PlacedObject
};

/// The whole input of a frame. Object 0 is the static one, object i + 1 is dynamic[i].
struct SceneObjects
{
  SceneObject fixed; ///< its pose is the identity
  std::vector<SceneObject> dynamic;

  const SceneObject& operator[](std::uint32_t object) const
  {
    return object == 0 ? fixed : dynamic[object - 1];
  }
  std::uint32_t size() const { return static_cast<std::uint32_t>(dynamic.size() + 1); }
};

/// World area of every cell, m2.
std::vector<double> cellAreas(const SceneObject& object, const Checkpoint& checkpoint = {});

}

#endif
