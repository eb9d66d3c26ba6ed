// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Scene/SurfaceRecords.h"
#include "Surfaces/SceneCells.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

namespace irradiance
{

/**
 * What a walk needs of the cell of a triangle, in 8 bytes: which one it is, and whether the walk
 * survives, decided on the integer that a sample is made of.
 *
 * A sample c stands for (c + 1/2) / 2^32, see SobolPoint::toUnit(). Twice that is an integer below
 * 2^33, so a double holds it, as it does r = 2^32 times a reflectance. Hence `sample < reflectance`
 * means c < r - 1/2, and for integers c < N, with N the difference rounded up. The difference of
 * doubles is exact for r >= 1/4 (up to 1 by Sterbenz, beyond as it needs no finer bits than r), and
 * negative below, as the true one is. N = 2^32, which all samples are below, has no room in 32 bits
 * and is a bit of its own.
 */
struct CellLook
{
  /// Bits of `cell` beside the number. Glossy is what light may leave otherwise than diffusely on
  /// the side where it came: also sheets that let it through.
  static constexpr std::uint32_t kSurvivesAlways = 1u << 31, kIsGlossy = 1u << 30;
  static constexpr std::uint32_t kNumber = kIsGlossy - 1;

  std::uint32_t cell;      ///< number among the cells of all objects, and the bits above
  std::uint32_t threshold; ///< a walk survives if its sample is below, or always

  CellLook() = default;
  /// `survival`: what is not absorbed; with several bands it depends on the walk, and is not used.
  CellLook(std::uint32_t number, double survival, bool isGlossy)
    : cell(number | (isGlossy ? kIsGlossy : 0u))
    , threshold(0)
  {
    constexpr double kAll = 0x1p32;
    const double surviving = std::ceil(kAll * survival - 0.5);
    if (surviving >= kAll)
    {
      cell |= kSurvivesAlways;
    }
    else if (surviving > 0)
    {
      threshold = static_cast<std::uint32_t>(surviving);
    }
  }

  std::uint32_t number() const { return cell & kNumber; }
  bool isGlossy() const { return (cell & kIsGlossy) != 0; }
  bool survives(std::uint32_t sample) const
  {
    return sample < threshold || (cell & kSurvivesAlways) != 0;
  }
};
static_assert(sizeof(CellLook) == 8);

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
  void update(const SceneObjects& objects, const CancelPoint& cancelPoint = {})
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

private:
  /// What the looks of an object were made of: its material, first cell, first triangle, and the
  /// first triangle of the next object.
  using Origin =
    std::tuple<std::shared_ptr<const Material>, std::size_t, std::uint32_t, std::uint32_t>;

  /// Returns whether one is glossy.
  bool fill(const Origin& origin, ThrottledCancelPoint& pace)
  {
    const auto& [material, firstCell, first, end] = origin;
    bool isGlossy = false;
    for (std::uint32_t number = first; number < end; ++number)
    {
      const std::uint32_t cell = material->cellOfTriangle[number - first];
      looks_[number] = CellLook(static_cast<std::uint32_t>(firstCell + cell),
        material->bands == 1 ? material->surviving()[cell] : 0.0,
        material->isSpecular(cell) || material->transmits(cell));
      isGlossy = isGlossy || looks_[number].isGlossy();
      pace.step();
    }
    return isGlossy;
  }

  SurfaceRecords surfaces_;
  std::vector<CellLook> looks_ = { CellLook(0, 0.0, false) };
  std::vector<Origin> origins_; ///< by object; without a material where nothing is known
  std::vector<bool> isGlossy_;  ///< by object
  bool hasGlossy_ = false;
};

}
