// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/SceneTriangles.h"

#include <algorithm>
#include <stdexcept>

namespace irradiance
{

namespace
{

std::vector<std::uint32_t> firstTriangles(const SceneObjects& objects)
{
  std::vector<std::uint32_t> firsts{ 0 };
  std::size_t end = 0;
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    end += objects[i].body->mesh().size();
    firsts.push_back(static_cast<std::uint32_t>(end));
  }
  if (end >= SceneTriangles::kNone)
  {
    throw std::length_error("the scene has more triangles than there are numbers of 32 bits");
  }
  return firsts;
}

CellLook lookOf(const Material& material, std::uint32_t cell, std::size_t number)
{
  return { static_cast<std::uint32_t>(number),
    material.bands == 1 ? material.totalReflectance()[cell] : 0.0, material.isSpecular(cell) };
}

}

SceneTriangles::SceneTriangles(const SceneObjects& objects)
  : firsts_(firstTriangles(objects))
{
  const CellNumbers cells(objects);
  if (cells.size() > CellLook::kNumber)
  {
    throw std::length_error("the scene has more cells than there are numbers of 30 bits");
  }
  records_.resize(std::size_t{ size() } + 1);
  looks_.reserve(records_.size());
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    place(objects[i], i);
    const Material& material = *objects[i].material;
    for (std::uint32_t triangle = 0; triangle < firsts_[i + 1] - firsts_[i]; ++triangle)
    {
      const std::uint32_t cell = material.cellOfTriangle[triangle];
      looks_.push_back(lookOf(material, cell, cells[{ i, cell }]));
      hasGlossy_ = hasGlossy_ || looks_.back().isGlossy();
    }
  }
  looks_.push_back({ 0, 0.0, false });
}

void SceneTriangles::place(const SceneObject& object, std::uint32_t number)
{
  const TriangleMesh& mesh = object.body->mesh();
  for (std::uint32_t i = 0; i < mesh.size(); ++i)
  {
    // Static triangles are in world space, and keep their bits.
    records_[firsts_[number] + i] =
      SurfaceRecord(number == 0 ? mesh[i] : transformed(object.worldFromObject, mesh[i]));
  }
}

TriangleId SceneTriangles::idOf(std::uint32_t number) const
{
  if (number == kNone)
  {
    return {};
  }
  const auto next = std::upper_bound(firsts_.begin(), firsts_.end(), number);
  const auto object = static_cast<std::uint32_t>(next - firsts_.begin()) - 1;
  return { object, number - firsts_[object] };
}

}
