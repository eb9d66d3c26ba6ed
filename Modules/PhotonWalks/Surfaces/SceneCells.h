// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Surfaces/SceneObjects.h"

#include <utility>
#include <vector>

namespace irradiance
{

/// A cell of the scene: which one of which object.
struct SceneCell
{
  std::uint32_t object = 0;
  std::size_t cell = 0;

  friend bool operator==(const SceneCell& a, const SceneCell& b)
  {
    return a.object == b.object && a.cell == b.cell;
  }
};

/// A side of a cell, or both together.
struct CellSide : SceneCell
{
  static constexpr int kBoth = 2;
  int side = kBoth; ///< 0 the front, 1 the back, or kBoth
};

/// Calls visit(CellSide) for what is told of a cell: each of its sides, or both together.
template <class Visit>
void forEachSide(const SceneCell& cell, bool areApart, const Visit& visit)
{
  if (!areApart)
  {
    visit(CellSide{ cell });
    return;
  }
  visit(CellSide{ cell, 0 });
  visit(CellSide{ cell, 1 });
}

/// Numbers the cells of all objects, object by object.
class CellNumbers
{
public:
  CellNumbers() = default;
  explicit CellNumbers(const SceneObjects& objects)
  {
    for (std::uint32_t object = 0; object < objects.size(); ++object)
    {
      ends_.push_back(ends_.back() + objects[object].material->numberOfCells);
    }
  }

  std::uint32_t numberOfObjects() const { return static_cast<std::uint32_t>(ends_.size() - 1); }
  /// Of all objects.
  std::size_t size() const { return ends_.back(); }
  std::size_t sizeOf(std::uint32_t object) const { return ends_[object + 1] - ends_[object]; }
  std::size_t operator[](const SceneCell& cell) const { return ends_[cell.object] + cell.cell; }
  /// Calls visit(SceneCell) for each cell, in order.
  template <class Visit>
  void forEach(const Visit& visit) const
  {
    for (std::uint32_t object = 0; object < numberOfObjects(); ++object)
    {
      for (std::size_t cell = 0; cell < sizeOf(object); ++cell)
      {
        visit(SceneCell{ object, cell });
      }
    }
  }

private:
  std::vector<std::size_t> ends_ = { 0 }; ///< of no object, and of each
};

/// The cells of the scene and their areas in a frame.
class SceneCells
{
public:
  /// Measures what differs from the last frame.
  void update(const SceneObjects& objects, const CancelPoint& cancelPoint)
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

  const CellNumbers& numbers() const { return numbers_; }
  /// World area, m2; 0 if the object is not there.
  double area(const SceneCell& cell) const { return areas_[cell.object][cell.cell]; }

private:
  SceneObjects objects_; ///< as measured
  CellNumbers numbers_;
  std::vector<std::vector<double>> areas_; ///< by object
};

}
