// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Surfaces_h
#define irradiance_Surfaces_h

#include "Surfaces/SceneObjects.h"
#include "Trees/SurfaceTree.h"

#include <memory>
#include <vector>

namespace irradiance
{

/// The surfaces of all objects, each in its own space, so that a motion changes nothing here.
class Surfaces
{
public:
  /// Updates them to a frame. The surface of an object with the same body and material stays.
  void update(const SceneObjects& objects, const CancelPoint& cancelPoint = {});

  /// Forgets the surfaces of objects that have another body or material, or are gone.
  void forgetOthers(const SceneObjects& objects);

  const SurfaceTree& of(std::uint32_t object) const { return known_[object].tree; }

private:
  /// Holds for this body and material.
  struct Known
  {
    std::shared_ptr<const RigidObject> body;
    std::shared_ptr<const Material> material;
    SurfaceTree tree;
  };

  std::vector<Known> known_;
};

}

#endif
