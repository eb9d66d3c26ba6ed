#ifndef irradiance_CellSums_h
#define irradiance_CellSums_h

#include "Power.h"
#include "Prefetch.h"
#include "Ray.h"
#include "Surface.h"

#include <memory>
#include <mutex>
#include <vector>

namespace irradiance
{

/// What a photon brings to a cell, or takes away again.
struct Deposit
{
  std::size_t slot;
  std::int64_t quanta;
};

/// The power that each cell receives, in quanta: adding a photon adds its power, removing it
/// subtracts it. Threads collect deposits and hand them in many at a time; the result does not
/// depend on their order.
class CellSums
{
public:
  CellSums() = default;
  /// `sides`: 1 for the sum over both sides of a cell, 2 to keep front and back apart.
  CellSums(const SceneObjects& objects, int sides);

  /// Has the memory bring what collect() and add() will need.
  void fetch(const TriangleId& id) const
  {
    if (id.object != TriangleId::kNone)
    {
      const std::size_t cell = surfaces_[id.object]->cellOfTriangle[id.triangle];
      prefetch(sums_.data() + slot(id.object, cell, 0));
    }
  }
  /// Appends the deposits of a photon. `sign`: 1 to add it, -1 to remove it.
  void collect(const TriangleId& id, bool isFront, const Power& power, int sign,
    std::vector<Deposit>& deposits) const;
  /// May be called by many threads at once.
  void add(const std::vector<Deposit>& deposits);
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
  std::vector<std::int64_t> sums_;
  std::unique_ptr<std::mutex> mutex_ = std::make_unique<std::mutex>();
};

}

#endif
