// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SceneTriangles_h
#define irradiance_SceneTriangles_h

#include "Geometry/Ray.h"
#include "Meshes/SurfaceRecord.h"
#include "Surfaces/CellLook.h"
#include "Surfaces/SceneCells.h"

#include <vector>

namespace irradiance
{

/**
 * A row for each triangle of a frame, numbered through all objects: its number is the first one of its
 * object plus its own there. Objects that are not there have rows as well, so numbers stay when they come
 * and go.
 */
class SceneTriangles
{
public:
  static constexpr std::uint32_t kNone = TriangleId::kNone;

  SceneTriangles() = default;
  /// Throws std::length_error if there are more triangles or cells than numbers.
  explicit SceneTriangles(const SceneObjects& objects);
  /// Computes the records of an object again, after it has moved. It has the same triangles as before.
  void place(const SceneObject& object, std::uint32_t number);

  std::uint32_t size() const { return firsts_.back(); }
  std::uint32_t numberOf(const TriangleId& id) const
  {
    return id == TriangleId{} ? kNone : firsts_[id.object] + id.triangle;
  }
  TriangleId idOf(std::uint32_t number) const;

  /// By number; at least one.
  const SurfaceRecord* records() const { return records_.data(); }
  /// By number, and one more for what hits nothing: no walk survives there.
  const CellLook* looks() const { return looks_.data(); }
  bool hasGlossy() const { return hasGlossy_; }

private:
  std::vector<std::uint32_t> firsts_ = { 0 }; ///< of each object, and one past the last triangle
  std::vector<SurfaceRecord> records_;
  std::vector<CellLook> looks_;
  bool hasGlossy_ = false;
};

}

#endif
