// SPDX-License-Identifier: BSD-3-Clause
#include "History/BlockArena.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <new>

namespace irradiance
{

BlockArena::BlockArena(std::size_t pageBytes)
  : pageBytes_((pageBytes + kAlignment - 1) / kAlignment * kAlignment)
{
}

BlockArena::~BlockArena()
{
  assert(used_ == 0);
  freeSlabs();
}

void BlockArena::freeSlabs()
{
  for (std::byte* const slab : slabs_)
  {
    std::free(slab);
  }
  slabs_.clear();
}

void* BlockArena::take()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (free_ == nullptr && next_ == end_)
  {
    addSlab();
  }
  ++used_;
  if (void* const page = free_)
  {
    free_ = *static_cast<void**>(page);
    return page;
  }
  void* const page = next_;
  next_ += pageBytes_;
  return page;
}

void BlockArena::giveBack(void* page) noexcept
{
  const std::lock_guard<std::mutex> lock(mutex_);
  free_ = new (page) void*(free_);
  --used_;
}

/// Slabs grow with what is held, so that a sixteenth at most is not in use, and a large scene asks
/// rarely.
void BlockArena::addSlab()
{
  constexpr std::size_t kFirstSlab = std::size_t{ 1 } << 14, kLargestSlab = std::size_t{ 1 } << 22;
  const std::size_t wanted = std::clamp(bytes_ / 16, kFirstSlab, kLargestSlab);
  const std::size_t size = std::max<std::size_t>(wanted / pageBytes_, 1) * pageBytes_;
  slabs_.reserve(slabs_.size() + 1);
  next_ = static_cast<std::byte*>(std::aligned_alloc(kAlignment, size));
  if (next_ == nullptr)
  {
    end_ = nullptr;
    throw std::bad_alloc();
  }
  slabs_.push_back(next_);
  end_ = next_ + size;
  bytes_ += size;
}

std::size_t BlockArena::bytes() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return bytes_ + slabs_.capacity() * sizeof(std::byte*);
}

std::size_t BlockArena::bytesInUse() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return used_ * pageBytes_;
}

void BlockArena::release()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (used_ > 0)
  {
    return;
  }
  freeSlabs();
  bytes_ = 0;
  free_ = nullptr;
  next_ = end_ = nullptr;
}

}
