// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/SceneCells.h"

#include <utility>

namespace irradiance
{

void SceneCells::update(const SceneObjects& objects, const CancelPoint& cancelPoint)
{
  const SceneObjects before = std::exchange(objects_, {}); // nothing is known until all is
  const bool isFirst = before.size() != objects.size() || areas_.size() != objects.size();
  areas_.resize(objects.size());
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    const SceneObject &now = objects[i], &old = isFirst ? now : before[i];
    if (isFirst || hasMoved(now, old) || now.material != old.material)
    {
      areas_[i] = cellAreas(now, cancelPoint);
    }
  }
  numbers_ = CellNumbers(objects);
  objects_ = objects;
}

}
