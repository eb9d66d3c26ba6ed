// SPDX-License-Identifier: BSD-3-Clause
#include "History/WalkHistory.h"

namespace irradiance
{

WalkHistory::WalkHistory(const WalkPlan& plan, const PointGrid& grid,
  const TriangleNumbers& numbers, int bands, const Power& power, std::shared_ptr<BlockArena> arena,
  const DealtBlocks& dealt)
  : plan_(plan)
  , grid_(grid)
  , numbers_(numbers)
  , bands_(bands)
  , power_(power)
  , dealt_(dealt)
  , arena_(std::move(arena))
{
}

WalkHistory& WalkHistory::operator=(WalkHistory&& other) noexcept
{
  blocks_ = std::move(other.blocks_); // first, as those of before are pages of the arena of before
  plan_ = std::move(other.plan_);
  grid_ = other.grid_;
  numbers_ = std::move(other.numbers_);
  kinds_ = std::move(other.kinds_);
  bands_ = other.bands_;
  power_ = other.power_;
  dealt_ = other.dealt_;
  arena_ = std::move(other.arena_);
  hidden_ = std::move(other.hidden_);
  return *this;
}

void WalkHistory::makeKinds()
{
  kinds_.clear();
  for (std::uint32_t object = 0; object < numbers_.objects(); ++object)
  {
    kinds_.resize(numbers_.first(object + 1), BounceTag::kindOf(object));
  }
}

void WalkHistory::append()
{
  if (blocks_.empty())
  {
    makeKinds();
  }
  const std::size_t number = dealt_[blocks_.size()];
  blocks_.emplace_back(
    *arena_, plan_.firstWalkOf(number), plan_.walksIn(number), bands_, grid_, power_);
  hidden_.emplace_back();
}

void WalkHistory::removeLast()
{
  blocks_.pop_back();
  hidden_.pop_back();
}

void WalkHistory::renumber(const TriangleNumbers& numbers, const std::vector<std::uint32_t>& kept)
{
  if (numbers == numbers_ && kept.empty())
  {
    return;
  }
  // The numbers of static triangles, which come first, stay unless others are told; so hidden hits
  // do.
  for (BounceBlock& block : blocks_)
  {
    block.renumber([&](std::uint32_t triangle) {
      return kept.empty() ? numbers.numberOf(numbers_.idOf(triangle)) : kept[triangle];
    });
  }
  numbers_ = numbers;
  makeKinds();
}

void WalkHistory::setKinds(
  const std::uint32_t* triangles, std::size_t count, std::uint8_t* kinds) const
{
  const std::uint32_t known = numbers_.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    kinds[i] = triangles[i] < known ? kinds_[triangles[i]] : std::uint8_t{ 0 };
  }
}

void WalkHistory::forgetHiddenHits()
{
  for (auto& hidden : hidden_)
  {
    hidden.clear();
  }
}

std::size_t WalkHistory::bytes() const
{
  std::size_t bytes = kinds_.capacity();
  for (std::size_t i = 0; i < blocks_.size(); ++i)
  {
    bytes += blocks_[i].bytes() + hidden_[i].bucket_count() * sizeof(void*) +
      hidden_[i].size() * (sizeof(std::pair<const std::uint32_t, HiddenHit>) + 2 * sizeof(void*));
  }
  return bytes;
}

}
