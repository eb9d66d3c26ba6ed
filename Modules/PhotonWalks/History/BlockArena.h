// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdlib>
#include <mutex>
#include <new>
#include <vector>

namespace irradiance
{

/**
 * Memory for the blocks of a history, in pages of one size. What a block gives back is used again,
 * so an engine that keeps its arena over fresh starts does not wait a second time for the system to
 * map memory; that costs twice what storing a segment does. Nothing is moved when a block grows.
 *
 * Several threads may take and give back at a time. It must outlive the blocks.
 */
class BlockArena
{
public:
  explicit BlockArena(std::size_t pageBytes)
    : pageBytes_((pageBytes + kAlignment - 1) / kAlignment * kAlignment)
  {
  }
  ~BlockArena()
  {
    assert(used_ == 0);
    freeSlabs();
  }
  BlockArena(const BlockArena&) = delete;
  BlockArena& operator=(const BlockArena&) = delete;

  std::size_t pageBytes() const { return pageBytes_; }
  /// A page at a multiple of kAlignment. What stands in it is anything.
  void* take()
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
    next_ += pageBytes_;
    return next_ - pageBytes_;
  }
  void giveBack(void* page) noexcept
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    free_ = new (page) void*(free_);
    --used_;
  }

  /// Memory held, used or not.
  std::size_t bytes() const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return bytes_ + slabs_.capacity() * sizeof(std::byte*);
  }
  std::size_t bytesInUse() const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return used_ * pageBytes_;
  }
  /// Frees all memory if none is in use, else nothing.
  void release()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (used_ == 0)
    {
      freeSlabs();
    }
  }

  static constexpr std::size_t kAlignment = 64;

private:
  /// Slabs grow with what is held, so that a sixteenth at most is not in use, and a large scene asks
  /// rarely.
  void addSlab()
  {
    constexpr std::size_t kFirst = std::size_t{ 1 } << 14, kLargest = std::size_t{ 1 } << 22;
    const std::size_t wanted = std::clamp(bytes_ / 16, kFirst, kLargest);
    const std::size_t size = std::max<std::size_t>(wanted / pageBytes_, 1) * pageBytes_;
    slabs_.reserve(slabs_.size() + 1);
    next_ = end_ = static_cast<std::byte*>(std::aligned_alloc(kAlignment, size));
    if (next_ == nullptr)
    {
      throw std::bad_alloc();
    }
    slabs_.push_back(next_);
    end_ += size;
    bytes_ += size;
  }
  void freeSlabs()
  {
    std::for_each(slabs_.begin(), slabs_.end(), std::free);
    slabs_.clear();
    bytes_ = 0;
    free_ = nullptr;
    next_ = end_ = nullptr;
  }

  const std::size_t pageBytes_;
  mutable std::mutex mutex_;
  std::vector<std::byte*> slabs_;
  std::size_t bytes_ = 0, used_ = 0; ///< pages in use
  void* free_ = nullptr; ///< pages that were given back: each begins with where the next one is
  std::byte *next_ = nullptr, *end_ = nullptr; ///< of the last slab, never used yet
};

}
