#ifndef StoredSegments_h
#define StoredSegments_h

#include "History/WalkBlock.h"

#include <cstdint>
#include <vector>

/// The history of many walks at random, without the cost of shooting them: chains of points on the
/// walls of a room, of 1 to 7 segments each.
class StoredSegments
{
public:
  StoredSegments(const irradiance::Box& room, std::size_t atLeast);

  const std::vector<irradiance::WalkBlock>& blocks() const { return blocks_; }
  std::size_t size() const { return size_; }
  /// Of the points.
  const irradiance::UnitFrame& frame() const { return frame_; }
  /// Memory that the blocks hold.
  std::size_t bytes() const;

private:
  irradiance::UnitFrame frame_;
  std::vector<irradiance::WalkBlock> blocks_;
  std::size_t size_ = 0;
};

#endif
