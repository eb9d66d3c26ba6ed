// SPDX-License-Identifier: BSD-3-Clause
#include "Photons/Surfaces.h"

#include "Surfaces/Contacts.h"

#include <algorithm>

namespace irradiance
{

void Surfaces::update(const SceneObjects& objects, const CancelPoint& cancelPoint)
{
  forgetOthers(objects);
  known_.resize(objects.size());
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    const SceneObject& object = objects[i];
    if (!known_[i].body)
    {
      known_[i].tree = { object.body->mesh(), solidSidesInModel(object, i == 0, cancelPoint),
        cancelPoint };
      known_[i].body = object.body;
      known_[i].material = object.material;
    }
  }
}

void Surfaces::forgetOthers(const SceneObjects& objects)
{
  known_.resize(std::min<std::size_t>(known_.size(), objects.size()));
  for (std::uint32_t i = 0; i < known_.size(); ++i)
  {
    if (known_[i].body != objects[i].body || known_[i].material != objects[i].material)
    {
      known_[i] = {};
    }
  }
}

}
