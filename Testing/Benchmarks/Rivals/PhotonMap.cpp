// SPDX-License-Identifier: BSD-3-Clause
#include "Rivals/PhotonMap.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{

/// Of `count` nodes, those in the left subtree if all levels except the last are full, and that is
/// filled from the left.
std::size_t leftOf(std::size_t count)
{
  std::size_t level = 1; // nodes in the last full level
  while (2 * level - 1 <= count)
  {
    level *= 2;
  }
  level /= 2;
  const std::size_t inLast = count - (2 * level - 1);
  return level - 1 + std::min(inLast, level);
}

float squaredDistance(const std::array<float, 3>& a, const std::array<float, 3>& b)
{
  const float x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return x * x + y * y + z * z;
}

float dot(const std::array<float, 3>& a, const std::array<float, 3>& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

constexpr double kPi = 3.14159265358979323846;

/// Of the middles of the steps into which the angles are cut.
struct AngleTables
{
  std::array<float, 256> cosPolar, sinPolar, cosAzimuth, sinAzimuth;

  AngleTables()
  {
    for (std::size_t i = 0; i < 256; ++i)
    {
      const double half = (static_cast<double>(i) + 0.5) / 256 * kPi;
      cosPolar[i] = static_cast<float>(std::cos(half));
      sinPolar[i] = static_cast<float>(std::sin(half));
      cosAzimuth[i] = static_cast<float>(std::cos(2 * half));
      sinAzimuth[i] = static_cast<float>(std::sin(2 * half));
    }
  }
};

const AngleTables& angleTables()
{
  static const AngleTables tables;
  return tables;
}

/// The nearest photons so far. When there are as many as wanted they form a heap, the farthest
/// first.
class Nearest
{
public:
  using Neighbour = PhotonMap::Neighbour;

  Nearest(std::size_t count, std::vector<Neighbour>& found)
    : count_(count)
    , found_(found)
  {
    found_.clear();
    found_.reserve(count);
  }

  /// Beyond this nothing is of use.
  float limit() const { return limit_; }

  void add(const Neighbour& neighbour)
  {
    if (found_.size() < count_)
    {
      found_.push_back(neighbour);
      if (found_.size() == count_)
      {
        std::make_heap(found_.begin(), found_.end(), isNearer);
        limit_ = found_.front().squaredDistance;
      }
      return;
    }
    replaceFarthest(neighbour);
    limit_ = found_.front().squaredDistance;
  }

private:
  static bool isNearer(const Neighbour& a, const Neighbour& b)
  {
    return a.squaredDistance < b.squaredDistance;
  }

  void replaceFarthest(const Neighbour& neighbour)
  {
    std::size_t hole = 0;
    for (std::size_t child = 1; child < count_; child = 2 * hole + 1)
    {
      child += child + 1 < count_ && isNearer(found_[child], found_[child + 1]) ? 1 : 0;
      if (!isNearer(neighbour, found_[child]))
      {
        break;
      }
      found_[hole] = found_[child];
      hole = child;
    }
    found_[hole] = neighbour;
  }

  std::size_t count_;
  std::vector<Neighbour>& found_;
  float limit_ = std::numeric_limits<float>::infinity();
};

}

std::array<std::uint8_t, 2> PhotonMap::packed(const std::array<float, 3>& direction)
{
  const auto step = [](double turn) {
    return static_cast<std::uint8_t>(std::clamp(static_cast<int>(256 * turn), 0, 255));
  };
  const double polar = std::acos(std::clamp(static_cast<double>(direction[2]), -1.0, 1.0));
  const double azimuth = std::atan2(direction[1], direction[0]) / (2 * kPi);
  return { step(polar / kPi), step(azimuth < 0 ? azimuth + 1 : azimuth) };
}

std::array<float, 3> PhotonMap::unpacked(const std::array<std::uint8_t, 2>& direction)
{
  const AngleTables& tables = angleTables();
  const auto [polar, azimuth] = direction;
  return { tables.sinPolar[polar] * tables.cosAzimuth[azimuth],
    tables.sinPolar[polar] * tables.sinAzimuth[azimuth], tables.cosPolar[polar] };
}

PhotonMap::PhotonMap(std::vector<Photon> photons)
  : photons_(photons.size())
{
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Box box{ { kInfinity, kInfinity, kInfinity }, { -kInfinity, -kInfinity, -kInfinity } };
  for (const Photon& photon : photons)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      box.lower[axis] = std::min(box.lower[axis], photon.position[axis]);
      box.upper[axis] = std::max(box.upper[axis], photon.position[axis]);
    }
  }
  balance(photons.data(), photons.data() + photons.size(), 0, box);
}

/// Makes the photons of a range, which lie in `box`, the tree below `node`.
void PhotonMap::balance(Photon* begin, Photon* end, std::size_t node, const Box& box)
{
  if (begin == end)
  {
    return;
  }
  std::uint8_t axis = 0;
  for (std::uint8_t other : { 1, 2 })
  {
    if (box.upper[other] - box.lower[other] > box.upper[axis] - box.lower[axis])
    {
      axis = other;
    }
  }
  Photon* const median = begin + leftOf(static_cast<std::size_t>(end - begin));
  std::nth_element(begin, median, end,
    [axis](const Photon& a, const Photon& b) { return a.position[axis] < b.position[axis]; });
  photons_[node] = *median;
  photons_[node].axis = axis;
  Box left = box, right = box;
  left.upper[axis] = right.lower[axis] = median->position[axis];
  balance(begin, median, 2 * node + 1, left);
  balance(median + 1, end, 2 * node + 2, right);
}

void PhotonMap::findNearest(
  const std::array<float, 3>& point, std::size_t count, std::vector<Neighbour>& found) const
{
  /// A node whose nearer subtree is being searched. It and the other one are behind its plane.
  struct Ahead
  {
    std::uint32_t node;
    float squaredDistance; ///< of the plane
    std::uint32_t farChild;
  };
  std::array<Ahead, 32> stack;
  std::size_t depth = 0;
  Nearest nearest(count, found);
  const auto size = static_cast<std::uint32_t>(count > 0 ? photons_.size() : 0);
  std::uint32_t node = 0;
  for (;;)
  {
    while (node < size)
    {
      const Photon& photon = photons_[node];
      const float offset = point[photon.axis] - photon.position[photon.axis];
      const std::uint32_t left = 2 * node + 1, isRight = offset > 0 ? 1 : 0;
      stack[depth++] = { node, offset * offset, left + 1 - isRight };
      node = left + isRight;
    }
    while (depth > 0 && stack[depth - 1].squaredDistance >= nearest.limit())
    {
      --depth;
    }
    if (depth == 0)
    {
      return;
    }
    const Ahead& ahead = stack[--depth];
    const float distance = squaredDistance(point, photons_[ahead.node].position);
    if (distance < nearest.limit())
    {
      nearest.add({ distance, ahead.node });
    }
    node = ahead.farChild;
  }
}

float PhotonMap::irradiance(const std::array<float, 3>& point, const std::array<float, 3>& normal,
  std::size_t count, std::vector<Neighbour>& found) const
{
  findNearest(point, count, found);
  float power = 0, squaredRadius = 0;
  for (const Neighbour& neighbour : found)
  {
    const Photon& photon = photons_[neighbour.photon];
    squaredRadius = std::max(squaredRadius, neighbour.squaredDistance);
    power += dot(unpacked(photon.direction), normal) < 0 ? photon.power : 0;
  }
  return squaredRadius > 0 ? power / (static_cast<float>(kPi) * squaredRadius) : 0;
}
