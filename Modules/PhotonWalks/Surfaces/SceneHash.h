// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SceneHash_h
#define irradiance_SceneHash_h

#include "Surfaces/SceneObjects.h"

#include <cstring>

namespace irradiance
{

/// A hash of numbers in their order (FNV-1a, by words of 64 bits).
class Hash
{
public:
  template <class Number>
  void add(Number number)
  {
    static_assert(std::is_arithmetic_v<Number> && sizeof(Number) <= sizeof(std::uint64_t));
    std::uint64_t word = 0;
    std::memcpy(&word, &number, sizeof(number));
    value_ = (value_ ^ word) * 0x100000001b3u;
    value_ ^= value_ >> 32;
  }
  template <class Number>
  void add(const std::vector<Number>& numbers)
  {
    add(numbers.size());
    for (const Number& number : numbers)
    {
      add(number);
    }
  }
  void add(const Vector3& vector)
  {
    for (const double coordinate : { vector[0], vector[1], vector[2] })
    {
      add(coordinate);
    }
  }

  template <class First, class Second, class... Rest>
  void add(const First& first, const Second& second, const Rest&... rest)
  {
    add(first);
    add(second);
    (add(rest), ...);
  }

  std::uint64_t value() const { return value_; }

private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

/// Adds a frame: equal frames give equal hashes, whatever the addresses. What `known` has too, at
/// the same address, is left out; null: nothing is.
void addScene(const SceneObjects& objects, const SceneObjects* known, Hash& hash);

}

#endif
