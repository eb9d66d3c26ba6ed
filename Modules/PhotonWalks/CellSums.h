#ifndef irradiance_CellSums_h
#define irradiance_CellSums_h

#include "Power.h"
#include "Ray.h"
#include "Surface.h"

#include <atomic>
#include <memory>
#include <vector>

namespace irradiance
{

/// The power that each cell receives, in quanta: adding a photon adds its power, removing it
/// subtracts it. May be used by many threads at once; the result does not depend on their order.
class CellSums
{
public:
  CellSums() = default;
  /// `sides`: 1 for the sum over both sides of a cell, 2 to keep front and back apart.
  CellSums(const SceneObjects& objects, int sides);

  /// Has the memory bring what add() will change.
  void fetch(const TriangleId& id) const
  {
    if (id.object != TriangleId::kNone)
    {
      const std::size_t cell = surfaces_[id.object]->cellOfTriangle[id.triangle];
      __builtin_prefetch(sums_.get() + slot(id.object, cell, 0), 1);
    }
  }
  /// `sign`: 1 to add, -1 to remove.
  void add(const TriangleId& id, bool isFront, const Power& power, int sign);
  /// `side`: 0 front (or both), 1 back.
  std::int64_t sum(std::uint32_t object, std::size_t cell, int side, int band) const;

private:
  std::size_t slot(std::uint32_t object, std::size_t cell, int side) const
  {
    return ((firstCell_[object] + cell) * static_cast<std::size_t>(sides_) +
             static_cast<std::size_t>(side)) *
      static_cast<std::size_t>(bands_);
  }

  int sides_ = 1;
  int bands_ = 1;
  std::vector<std::size_t> firstCell_;
  std::vector<std::shared_ptr<const Surface>> surfaces_;
  std::unique_ptr<std::atomic<std::int64_t>[]> sums_;
};

}

#endif
