// SPDX-License-Identifier: BSD-3-Clause
#include "Light/SceneCells.h"

#include <utility>

namespace irradiance
{

void SceneCells::update(const SceneObjects& objects, const Checkpoint& checkpoint)
{
  const SceneObjects before = std::exchange(objects_, {}); // nothing is known until all is
  const bool isFirst = before.size() != objects.size() || areas_.size() != objects.size();
  areas_.resize(objects.size());
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    const SceneObject &now = objects[i], &old = isFirst ? now : before[i];
    if (isFirst || hasMoved(now, old) || now.material != old.material)
    {
      areas_[i] = cellAreas(now, checkpoint);
    }
  }
  numbers_ = CellNumbers(objects);
  objects_ = objects;
}

}
