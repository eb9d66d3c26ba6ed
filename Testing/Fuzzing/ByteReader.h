// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

namespace irradiance::fuzzing
{

/// Reads what a fuzzer writes. Past the end all bytes are 0, so every input has a meaning.
class ByteReader
{
public:
  ByteReader(const std::uint8_t* data, std::size_t size)
    : next_(data)
    , end_(data + size)
  {
  }

  bool isAtEnd() const { return next_ == end_; }
  std::uint8_t byte() { return isAtEnd() ? std::uint8_t{ 0 } : *next_++; }
  /// 0 .. end - 1; end is at most 256.
  int below(int end) { return byte() % end; }
  bool oneIn(int count) { return below(count) == count - 1; }

  /// Any double. Small whole numbers, exact fractions, powers of two and values next to the last
  /// one are frequent: they make shared corners, coplanar faces and slivers.
  double number()
  {
    switch (below(8))
    {
      case 0:
        last_ = signedByte();
        break;
      case 1:
        last_ = signedByte() / 16.0;
        break;
      case 2:
        last_ = std::ldexp(static_cast<double>(signedByte()), signedByte() / 2);
        break;
      case 3:
        last_ = static_cast<double>(raw<float>());
        break;
      case 4:
        last_ = raw<double>();
        break;
      case 5:
        nudge(signedByte());
        break;
      case 6:
        last_ = -last_;
        break;
      default:
        last_ = signedByte() / 127.0;
        break;
    }
    return last_;
  }

  /// Finite, and not larger than `most`.
  double numberWithin(double most)
  {
    const double value = number();
    last_ = std::abs(value) <= most ? value : 0.0; // NaN becomes 0 too
    return last_;
  }

private:
  int signedByte() { return static_cast<std::int8_t>(byte()); }

  template <typename T>
  T raw()
  {
    std::uint8_t bytes[sizeof(T)] = {};
    const std::ptrdiff_t size = std::min<std::ptrdiff_t>(sizeof(T), end_ - next_);
    std::copy_n(next_, size, bytes);
    next_ += size;
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }

  void nudge(int ulps)
  {
    const double goal =
      ulps < 0 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
    for (int i = std::abs(ulps) % 4; i >= 0; --i)
    {
      last_ = std::nextafter(last_, goal);
    }
  }

  const std::uint8_t* next_;
  const std::uint8_t* end_;
  double last_ = 0;
};

}
