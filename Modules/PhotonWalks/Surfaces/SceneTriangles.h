// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SceneTriangles_h
#define irradiance_SceneTriangles_h

#include "Scene/SurfaceRecords.h"
#include "Surfaces/CellLook.h"
#include "Surfaces/SceneObjects.h"

#include <memory>
#include <vector>

namespace irradiance
{

/**
 * A row for each triangle of a frame, by number: its surface, and the look of its cell. Objects
 * that are not there have rows as well, so numbers stay when they come and go.
 */
class SceneTriangles
{
public:
  static constexpr std::uint32_t kNone = TriangleNumbers::kNone;

  SceneTriangles() = default;
  explicit SceneTriangles(const SceneObjects& objects) { update(objects); }
  /// Makes the rows of what is another than before. Throws std::length_error if there are more
  /// triangles or cells than numbers. If it throws, the next one makes up for it.
  void update(const SceneObjects& objects, const CancelPoint& cancelPoint = {});

  const TriangleNumbers& numbers() const { return surfaces_.numbers(); }
  const SurfaceRecords& surfaces() const { return surfaces_; }
  std::uint32_t size() const { return numbers().size(); }
  std::uint32_t numberOf(const TriangleId& id) const { return numbers().numberOf(id); }
  TriangleId idOf(std::uint32_t number) const { return numbers().idOf(number); }

  /// By number; at least one.
  const SurfaceRecord* records() const { return surfaces_.rows(); }
  /// By number, and one more for what hits nothing: no walk survives there.
  const CellLook* looks() const { return looks_.data(); }
  bool hasGlossy() const { return hasGlossy_; }
  /// Of its memory.
  std::size_t bytes() const;

private:
  /// What the looks of an object were made of.
  struct Origin
  {
    std::shared_ptr<const Material> material;
    std::size_t firstCell = 0;
    std::uint32_t first = 0, end = 0; ///< triangles

    bool operator==(const Origin& other) const
    {
      return material == other.material && firstCell == other.firstCell && first == other.first &&
        end == other.end;
    }
  };

  /// Returns whether one is glossy.
  bool fill(const Origin& origin, ThrottledCancelPoint& pace);

  SurfaceRecords surfaces_;
  std::vector<CellLook> looks_ = { CellLook(0, 0.0, false) };
  std::vector<Origin> origins_; ///< by object; without a material where nothing is known
  std::vector<bool> isGlossy_;  ///< by object
  bool hasGlossy_ = false;
};

}

#endif
