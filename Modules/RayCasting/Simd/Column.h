// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Column_h
#define irradiance_Column_h

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

  Column() = default;
  Column(Column&& other) noexcept
    : memory_(std::move(other.memory_))
    , values_(std::exchange(other.values_, nullptr))
    , room_(std::exchange(other.room_, 0))
  {
  }
  Column& operator=(Column&& other) noexcept
  {
    memory_ = std::move(other.memory_);
    values_ = std::exchange(other.values_, nullptr);
    room_ = std::exchange(other.room_, 0);
    return *this;
  }

  /// Makes room for that many values; what it holds is lost if it grows.
  void need(std::size_t count)
  {
    if (count > room_)
    {
      room_ = 0;
      memory_.reset(); // first, so that there are never two
      take(count);
    }
  }
  /// Makes room, and keeps the values there are.
  void reserve(std::size_t count)
  {
    if (count > room_)
    {
      const Value* const before = values_;
      const std::size_t kept = room_;
      const Memory old = std::move(memory_);
      take(count);
      if (kept > 0)
      {
        std::memcpy(values_, before, kept * sizeof(Value));
      }
    }
  }
  std::size_t room() const { return room_; }
  Value* data() { return values_; }
  const Value* data() const { return values_; }
  Value& operator[](std::size_t i) { return values_[i]; }
  const Value& operator[](std::size_t i) const { return values_[i]; }

private:
  static constexpr std::size_t kLine = 64, kPage = 4096;
  struct Free
  {
    void operator()(std::byte* memory) const
    {
      ::operator delete (memory, std::align_val_t{ kLine });
    }
  };
  using Memory = std::unique_ptr<std::byte, Free>;

  void take(std::size_t count)
  {
    constexpr std::size_t kLinesApart = 5;
    static thread_local std::size_t shift = 0;
    const std::size_t bytes = kPage + (count + kRoomBehind) * sizeof(Value);
    memory_.reset(static_cast<std::byte*>(::operator new (bytes, std::align_val_t{ kLine })));
    shift = (shift + kLinesApart * kLine) % kPage;
    values_ = reinterpret_cast<Value*>(memory_.get() + shift);
    room_ = count;
  }

  Memory memory_;
  Value* values_ = nullptr;
  std::size_t room_ = 0;
};

}

#endif
