#include "CellSums.h"

namespace irradiance
{

CellSums::CellSums(const SceneObjects& objects, int sides)
  : sides_(sides)
  , bands_(objects.fixed.surface->bands)
{
  std::size_t cells = 0;
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    firstCell_.push_back(cells);
    surfaces_.push_back(objects[object].surface);
    cells += objects[object].surface->numberOfCells;
  }
  const std::size_t size =
    cells * static_cast<std::size_t>(sides_) * static_cast<std::size_t>(bands_);
  sums_ = std::make_unique<std::atomic<std::int64_t>[]>(size);
}

void CellSums::add(const TriangleId& id, bool isFront, const Power& power, int sign)
{
  const std::size_t cell = surfaces_[id.object]->cellOfTriangle[id.triangle];
  const std::size_t first = slot(id.object, cell, sides_ == 2 && !isFront ? 1 : 0);
  for (int band = 0; band < bands_; ++band)
  {
    sums_[first + static_cast<std::size_t>(band)].fetch_add(
      sign * power[band], std::memory_order_relaxed);
  }
}

std::int64_t CellSums::sum(std::uint32_t object, std::size_t cell, int side, int band) const
{
  return sums_[slot(object, cell, side) + static_cast<std::size_t>(band)].load(
    std::memory_order_relaxed);
}

}
