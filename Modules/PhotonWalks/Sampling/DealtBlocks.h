// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_DealtBlocks_h
#define irradiance_DealtBlocks_h

#include <cstddef>

namespace irradiance
{

/// The blocks of a plan that one rank of several works on. They are dealt in turn, so that each
/// round is shared evenly.
class DealtBlocks
{
public:
  /// All blocks.
  DealtBlocks() = default;
  DealtBlocks(std::size_t rank, std::size_t ranks)
    : rank_(rank)
    , ranks_(ranks)
  {
  }

  /// The number in the plan of the i-th of these.
  std::size_t operator[](std::size_t i) const { return rank_ + i * ranks_; }
  bool contains(std::size_t block) const { return block % ranks_ == rank_; }
  /// How many of these have lower numbers.
  std::size_t before(std::size_t block) const
  {
    return ranks_ == 1 ? block : (block + ranks_ - 1 - rank_) / ranks_;
  }

  friend bool operator==(const DealtBlocks& a, const DealtBlocks& b)
  {
    return a.rank_ == b.rank_ && a.ranks_ == b.ranks_;
  }

private:
  std::size_t rank_ = 0, ranks_ = 1;
};

}

#endif
