// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <new>
#include <utility>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace irradiance
{

/**
 * For vectors that are large, live long and are read here and there. The system is asked for pages
 * of 2 MiB: with pages of 4 KiB a processor spends much of such a read on finding the page. What
 * resize() adds is not initialised, so that large memory is not written twice.
 */
template <class Value>
struct LargePages
{
  using value_type = Value;

  LargePages() = default;
  template <class Other>
  explicit LargePages(const LargePages<Other>&)
  {
  }

  Value* allocate(std::size_t count)
  {
    const std::size_t bytes = bytesFor(count);
    void* const memory = ::operator new(bytes, alignmentOf(bytes));
#ifdef __linux__
    if (isLarge(bytes))
    {
      madvise(memory, bytes, MADV_HUGEPAGE); // a wish: without it all works
    }
#endif
    return static_cast<Value*>(memory);
  }
  void deallocate(Value* values, std::size_t count)
  {
    ::operator delete(values, alignmentOf(bytesFor(count)));
  }

  template <class Made, class... Arguments>
  void construct(Made* place, Arguments&&... arguments)
  {
    if constexpr (sizeof...(Arguments) == 0)
    {
      ::new (static_cast<void*>(place)) Made;
    }
    else
    {
      ::new (static_cast<void*>(place)) Made(std::forward<Arguments>(arguments)...);
    }
  }

  friend bool operator==(const LargePages&, const LargePages&)
  {
    return true;
  }
  friend bool operator!=(const LargePages&, const LargePages&)
  {
    return false;
  }

private:
  static constexpr std::size_t kPage = std::size_t{ 1 } << 21;

  static bool isLarge(std::size_t bytes)
  {
    return bytes > kPage + kPage / 2;
  }
  /// Whole pages, if there are to be large ones.
  static std::size_t bytesFor(std::size_t count)
  {
    const std::size_t bytes = count * sizeof(Value);
    return isLarge(bytes) ? (bytes + kPage - 1) / kPage * kPage : bytes;
  }
  static std::align_val_t alignmentOf(std::size_t bytes)
  {
    return std::align_val_t{ isLarge(bytes) ? kPage : alignof(Value) };
  }
};

}
