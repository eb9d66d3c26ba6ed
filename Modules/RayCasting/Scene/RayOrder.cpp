// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/RayOrder.h"

#include <algorithm>
#include <array>
#include <utility>

namespace irradiance
{

namespace
{

constexpr unsigned kDigitBits = 11; // of the radix sort; two digits make a key
constexpr unsigned kOriginBits = 5; // for each axis
constexpr unsigned kDirectionBits = 7;
static_assert(3 * kOriginBits + kDirectionBits == 2 * kDigitBits, "the key fills the digits");

/// The bits of a number below 32, each followed by two zeros.
std::uint32_t spread(std::uint32_t x)
{
  x = (x | x << 8) & 0x100fu;
  x = (x | x << 4) & 0x10c3u;
  return (x | x << 2) & 0x1249u;
}

/// The cell of the origin in Morton order, then the octant and the slopes of the direction.
std::uint32_t keyOf(const Ray& ray, const Box& bounds, const Vector3& cellsPerLength)
{
  std::uint32_t cell = 0, direction = 0;
  const double length = ray.direction.cwiseAbs().maxCoeff();
  for (int i = 0; i < 3; ++i)
  {
    const double place = (ray.origin[i] - bounds.lower[i]) * cellsPerLength[i];
    constexpr double kLast = (1u << kOriginBits) - 1;
    // NaN goes to the first cell.
    cell |= spread(static_cast<std::uint32_t>(place > 0 ? std::min(place, kLast) : 0.0)) << i;
    direction = direction << 1 | (ray.direction[i] < 0 ? 1u : 0u);
  }
  for (int i = 0; i < 2; ++i)
  {
    const double slope = std::abs(ray.direction[i]) / length;
    direction =
      direction << 2 | static_cast<std::uint32_t>(slope > 0 ? std::min(4 * slope, 3.0) : 0);
  }
  return cell << kDirectionBits | direction;
}

struct KeyedRay
{
  std::uint32_t key, ray;
};

/// True if most rays are near and nearly parallel to the ray before them.
bool areCoherent(const Ray* rays, std::uint32_t count, const Box& bounds)
{
  constexpr double kSameWay = 0.95; // cosine
  const double near = 0.25 * bounds.extent().maxCoeff();
  std::uint32_t coherent = 0;
  for (std::uint32_t i = 1; i < count; ++i)
  {
    const Vector3 &d = rays[i].direction, &e = rays[i - 1].direction;
    const double product = d.dot(e);
    const bool isNear = (rays[i].origin - rays[i - 1].origin).cwiseAbs().maxCoeff() < near;
    const bool isSameWay =
      product > 0 && product * product > kSameWay * kSameWay * d.squaredNorm() * e.squaredNorm();
    coherent += isNear && isSameWay ? 1 : 0;
  }
  return 2 * std::uint64_t{ coherent } > count;
}

void sortByDigit(const std::vector<KeyedRay>& from, std::vector<KeyedRay>& to, unsigned shift)
{
  constexpr std::uint32_t kDigits = 1u << kDigitBits;
  std::array<std::uint32_t, kDigits> place{};
  for (const KeyedRay& item : from)
  {
    ++place[item.key >> shift & (kDigits - 1)];
  }
  std::uint32_t next = 0;
  for (std::uint32_t& count : place)
  {
    next += std::exchange(count, next);
  }
  for (const KeyedRay& item : from)
  {
    to[place[item.key >> shift & (kDigits - 1)]++] = item;
  }
}

}

std::vector<std::uint32_t> coherentOrder(const Ray* rays, std::uint32_t count, const Box& bounds)
{
  if (areCoherent(rays, count, bounds))
  {
    return {};
  }
  const Vector3 cellsPerLength = bounds.isEmpty()
    ? Vector3(Vector3::Zero())
    : Vector3((1u << kOriginBits) * bounds.extent().cwiseInverse());
  std::vector<KeyedRay> items(count), sorted(count);
  for (std::uint32_t i = 0; i < count; ++i)
  {
    items[i] = { keyOf(rays[i], bounds, cellsPerLength), i };
  }
  sortByDigit(items, sorted, 0);
  sortByDigit(sorted, items, kDigitBits);
  std::vector<std::uint32_t> order(count);
  std::transform(
    items.begin(), items.end(), order.begin(), [](const KeyedRay& item) { return item.ray; });
  return order;
}

}
