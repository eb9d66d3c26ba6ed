// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_BlockArena_h
#define irradiance_BlockArena_h

#include <cstddef>
#include <mutex>
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
  explicit BlockArena(std::size_t pageBytes);
  ~BlockArena();
  BlockArena(const BlockArena&) = delete;
  BlockArena& operator=(const BlockArena&) = delete;

  std::size_t pageBytes() const { return pageBytes_; }
  /// A page at a multiple of kAlignment. What stands in it is anything.
  void* take();
  void giveBack(void* page) noexcept;

  /// Memory held, used or not.
  std::size_t bytes() const;
  std::size_t bytesInUse() const;
  /// Frees all memory if none is in use, else nothing.
  void release();

  static constexpr std::size_t kAlignment = 64;

private:
  void addSlab();
  void freeSlabs();

  const std::size_t pageBytes_;
  mutable std::mutex mutex_;
  std::vector<std::byte*> slabs_;
  std::size_t bytes_ = 0, used_ = 0; ///< pages in use
  void* free_ = nullptr; ///< pages that were given back: each begins with where the next one is
  std::byte *next_ = nullptr, *end_ = nullptr; ///< of the last slab, never used yet
};

}

#endif
