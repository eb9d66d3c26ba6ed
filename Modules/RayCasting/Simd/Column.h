// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Column_h
#define irradiance_Column_h

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>

namespace irradiance
{

/// Memory for lanes, at the start of a cache line. It grows and does not shrink; what it holds is not
/// kept when it grows, and is never initialised.
template <class Value>
class Column
{
public:
  static_assert(std::is_trivially_copyable_v<Value>, "values have no constructor that must run");

  void need(std::size_t count)
  {
    if (count > room_)
    {
      values_.reset();
      room_ = 0;
      values_.reset(static_cast<Value*>(::operator new(count * sizeof(Value), kLine)));
      room_ = count;
    }
  }
  std::size_t room() const { return room_; }
  Value* data() { return values_.get(); }
  const Value* data() const { return values_.get(); }
  Value& operator[](std::size_t i) { return values_.get()[i]; }
  const Value& operator[](std::size_t i) const { return values_.get()[i]; }

private:
  static constexpr std::align_val_t kLine{ 64 };
  struct Free
  {
    void operator()(Value* values) const { ::operator delete(values, kLine); }
  };

  std::unique_ptr<Value, Free> values_;
  std::size_t room_ = 0;
};

}

#endif
