// SPDX-License-Identifier: BSD-3-Clause
#include "Views/WalkPath.h"

#include <algorithm>
#include <cstring>

namespace irradiance
{

namespace
{

std::int64_t bitsOf(double value)
{
  std::int64_t bits;
  std::memcpy(&bits, &value, sizeof(bits));
  return bits;
}

double valueOf(std::int64_t bits)
{
  double value;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

/// Ranks send integers.
void write(const WalkPath& path, std::vector<std::int64_t>& numbers)
{
  numbers.insert(numbers.end(),
    { path.walk, path.escapes ? 1 : 0, path.isStale ? 1 : 0,
      static_cast<std::int64_t>(path.firstRepaired),
      static_cast<std::int64_t>(path.points.size()) });
  numbers.insert(numbers.end(), path.power.quanta.begin(), path.power.quanta.end());
  for (const Vector3& point : path.points)
  {
    numbers.insert(numbers.end(), { bitsOf(point[0]), bitsOf(point[1]), bitsOf(point[2]) });
  }
}

/// Leaves `next` behind what write() wrote.
WalkPath read(const std::int64_t*& next)
{
  WalkPath path{};
  path.walk = static_cast<std::uint32_t>(*next++);
  path.escapes = *next++ != 0;
  path.isStale = *next++ != 0;
  path.firstRepaired = static_cast<std::size_t>(*next++);
  path.points.resize(static_cast<std::size_t>(*next++));
  for (std::int64_t& quanta : path.power.quanta)
  {
    quanta = *next++;
  }
  for (Vector3& point : path.points)
  {
    point = { valueOf(next[0]), valueOf(next[1]), valueOf(next[2]) };
    next += 3;
  }
  return path;
}

}

std::vector<WalkPath> pathsOfAll(const std::vector<WalkPath>& own, Ranks& ranks)
{
  std::vector<std::int64_t> numbers;
  for (const WalkPath& path : own)
  {
    write(path, numbers);
  }
  numbers = ranks.concatenate(numbers);
  std::vector<WalkPath> all;
  for (const std::int64_t* next = numbers.data(); next != numbers.data() + numbers.size();)
  {
    all.push_back(read(next));
  }
  std::sort(
    all.begin(), all.end(), [](const WalkPath& a, const WalkPath& b) { return a.walk < b.walk; });
  return all;
}

}
