// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/SceneTriangles.h"

#include "Surfaces/SceneCells.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace irradiance
{

void SceneTriangles::update(const SceneObjects& objects, const CancelPoint& cancelPoint)
{
  const CellNumbers cells(objects);
  if (cells.size() > CellLook::kNumber)
  {
    throw std::length_error("the scene has more cells than there are numbers of 30 bits");
  }
  surfaces_.update(objects.staticObject.body, objects.dynamicBodies(), cancelPoint);
  looks_.resize(std::size_t{ size() } + 1);
  looks_.back() = CellLook(0, 0.0, false);
  origins_.resize(objects.size());
  isGlossy_.resize(objects.size());
  ThrottledCancelPoint pace(cancelPoint);
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    Origin origin{ objects[object].material, cells[{ object, 0 }], numbers().first(object),
      numbers().first(object + 1) };
    if (origins_[object] != origin)
    {
      origins_[object] = {}; // for the case that the work is cancelled
      isGlossy_[object] = fill(origin, pace);
      origins_[object] = std::move(origin);
    }
  }
  hasGlossy_ = std::find(isGlossy_.begin(), isGlossy_.end(), true) != isGlossy_.end();
}

bool SceneTriangles::fill(const Origin& origin, ThrottledCancelPoint& pace)
{
  const auto& [material, firstCell, first, end] = origin;
  bool isGlossy = false;
  for (std::uint32_t number = first; number < end; ++number)
  {
    const std::uint32_t cell = material->cellOfTriangle[number - first];
    looks_[number] = CellLook(static_cast<std::uint32_t>(firstCell + cell),
      material->bands == 1 ? material->totalReflectance()[cell] : 0.0, material->isSpecular(cell));
    isGlossy = isGlossy || looks_[number].isGlossy();
    pace.step();
  }
  return isGlossy;
}

}
