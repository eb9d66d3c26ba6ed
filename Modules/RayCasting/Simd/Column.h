// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

namespace irradiance
{

/**
 * Values side by side, for lanes: they start at a cache line, and are never initialised. Memory
 * grows and is not given back.
 *
 * Columns of one size would begin at like places of the system's pages, where the nearest cache has
 * room for a few lines alone. So each begins some lines farther in its page than the one before.
 */
template <class Value>
class Column
{
public:
  static_assert(std::is_trivially_copyable_v<Value>, "values have no constructor that must run");

  /// Places behind the room, so that whole vectors may be read and written.
  static constexpr std::size_t kRoomBehind = 32;

  /// Makes room for that many values; what it holds is lost if it grows.
  void need(std::size_t count)
  {
    if (count > room())
    {
      values_.reset(); // first, so that there are never two
      take(count);
    }
  }

  /// Makes room, and keeps the values there are.
  void reserve(std::size_t count)
  {
    if (const std::size_t kept = room(); count > kept)
    {
      const auto old = std::move(values_);
      take(count);
      if (kept > 0)
      {
        std::memcpy(data(), old.get(), kept * sizeof(Value));
      }
    }
  }

  std::size_t room() const { return values_ ? values_.get_deleter().room : 0; }
  Value* data() { return values_.get(); }
  const Value* data() const { return values_.get(); }
  Value& operator[](std::size_t i) { return data()[i]; }
  const Value& operator[](std::size_t i) const { return data()[i]; }

private:
  static constexpr std::size_t kLine = 64, kPage = 4096;
  /// Behind whose beginning the values are.
  struct Memory
  {
    std::byte* begin = nullptr;
    std::size_t room = 0;

    void operator()(Value*) const { ::operator delete (begin, std::align_val_t{ kLine }); }
  };

  void take(std::size_t count)
  {
    constexpr std::size_t kLinesApart = 5;
    static thread_local std::size_t shift = 0;
    const std::size_t bytes = kPage + (count + kRoomBehind) * sizeof(Value);
    const Memory memory{ static_cast<std::byte*>(::operator new (bytes, std::align_val_t{ kLine })),
      count };
    shift = (shift + kLinesApart * kLine) % kPage;
    values_ = { reinterpret_cast<Value*>(memory.begin + shift), memory };
  }

  std::unique_ptr<Value, Memory> values_;
};

}
