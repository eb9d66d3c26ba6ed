// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_FrontColumn_h
#define irradiance_FrontColumn_h

#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <type_traits>

namespace irradiance
{

/// Values of walks side by side, aligned for vectors. They are never initialised: each stage writes what
/// the next ones read.
template <class Value>
class FrontColumn
{
  static_assert(std::is_trivially_copyable_v<Value>);

public:
  /// Stages write whole vectors, also behind the last walk.
  static constexpr std::size_t kRoomBehind = 32;

  /// Makes room, and keeps the values there are. Never gives room back.
  void reserve(std::size_t size)
  {
    if (size > capacity_)
    {
      Memory more(static_cast<Value*>(
        ::operator new ((size + kRoomBehind) * sizeof(Value), std::align_val_t{ kAlignment })));
      if (capacity_ > 0)
      {
        std::memcpy(more.get(), values_.get(), capacity_ * sizeof(Value));
      }
      values_ = std::move(more);
      capacity_ = size;
    }
  }

  Value* data() { return values_.get(); }
  const Value* data() const { return values_.get(); }
  Value& operator[](std::size_t place) { return values_.get()[place]; }
  const Value& operator[](std::size_t place) const { return values_.get()[place]; }

private:
  static constexpr std::size_t kAlignment = 64;

  struct Release
  {
    void operator()(Value* values) const
    {
      ::operator delete (values, std::align_val_t{ kAlignment });
    }
  };
  using Memory = std::unique_ptr<Value, Release>;

  Memory values_;
  std::size_t capacity_ = 0;
};

}

#endif
