// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/CellShapes.h"

#include <algorithm>
#include <numeric>

namespace irradiance
{

Triangle triangleOf(const SceneTriangles& triangles, std::uint32_t number)
{
  const SurfaceRecord& record = triangles.records()[number];
  const auto corner = [](const double* x) { return Vector3(x[0], x[1], x[2]); };
  return { corner(record.a), corner(record.b), corner(record.c) };
}

CellShapes::CellShapes(
  const Frame& frame, std::uint32_t first, std::uint32_t end, const CancelPoint& cancelPoint)
  : numbers_(frame.objects)
{
  // The exponent of a lobe that is as good as a mirror: half of it is within 2 degrees.
  constexpr double kSharp = 1000;
  ThrottledCancelPoint pace(cancelPoint);
  sortTriangles(frame.objects, frame.triangles, first, end, pace);
  shapes_.reserve(numbers_.size());
  for (std::size_t cell = 0; cell < numbers_.size(); ++cell)
  {
    shapes_.push_back(shapeOf(cell, frame.triangles));
    pace.step();
  }
  for (std::uint32_t object = first; object < end; ++object)
  {
    const Material& material = *frame.objects[object].material;
    for (std::size_t i = 0; i < material.specularReflectance.size(); ++i)
    {
      const std::size_t cell = i / static_cast<std::size_t>(material.bands);
      double& mirrored = shapes_[numbers_[{ object, cell }]].mirrored;
      mirrored = std::max(
        mirrored, material.phongExponent[cell] >= kSharp ? material.specularReflectance[i] : 0);
    }
  }
}

/// By cell; within a cell they keep their order.
void CellShapes::sortTriangles(const SceneObjects& objects, const SceneTriangles& triangles,
  std::uint32_t firstObject, std::uint32_t endObject, ThrottledCancelPoint& pace)
{
  firsts_.assign(numbers_.size() + 1, 0);
  const auto forEach = [&](const auto& visit) {
    for (std::uint32_t object = firstObject; object < endObject; ++object)
    {
      const std::uint32_t first = triangles.numbers().first(object);
      const auto count = static_cast<std::uint32_t>(objects[object].mesh().size());
      for (std::uint32_t i = 0; i < count; ++i)
      {
        visit(numbers_[{ object, objects[object].material->cellOfTriangle[i] }], first + i);
        pace.step();
      }
    }
  };
  forEach([&](std::size_t cell, std::uint32_t) { ++firsts_[cell + 1]; });
  std::partial_sum(firsts_.begin(), firsts_.end(), firsts_.begin());
  triangles_.resize(firsts_.back());
  std::vector<std::size_t> next(firsts_.begin(), firsts_.end() - 1);
  forEach([&](std::size_t cell, std::uint32_t number) { triangles_[next[cell]++] = number; });
}

CellShape CellShapes::shapeOf(std::size_t cell, const SceneTriangles& triangles) const
{
  CellShape shape;
  std::for_each(begin(cell), end(cell), [&](std::uint32_t number) {
    const Triangle triangle = triangleOf(triangles, number);
    const Vector3 areaVector = 0.5 * triangle.areaVector();
    const double area = areaVector.norm();
    shape.center += area / 3 * (triangle.a + triangle.b + triangle.c);
    shape.normal += areaVector;
    shape.area += area;
  });
  if (shape.area > 0)
  {
    shape.center /= shape.area;
    shape.normal /= shape.area;
    std::for_each(begin(cell), end(cell), [&](std::uint32_t number) {
      const Triangle triangle = triangleOf(triangles, number);
      for (const Vector3& corner : { triangle.a, triangle.b, triangle.c })
      {
        shape.radius = std::max(shape.radius, (corner - shape.center).norm());
      }
    });
  }
  return shape;
}

}
