// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

/**
 * The photon map of Jensen (1996, "Global Illumination Using Photon Maps"), as one writes it for
 * speed: a left-balanced kd-tree in one array, in the order of a heap, so that it needs no
 * pointers. It cannot be changed; each frame builds another. Floats, one thread.
 */
class PhotonMap
{
public:
  struct Photon
  {
    std::array<float, 3> position;         ///< m
    float power;                           ///< W
    std::array<std::uint8_t, 2> direction; ///< of its flight: polar angle and azimuth in 256 steps
    std::uint8_t axis = 0;                 ///< in which its node parts the photons below it
  };
  struct Neighbour
  {
    float squaredDistance; ///< m2
    std::uint32_t photon;
  };

  /// A direction in two bytes, and back; unit vectors.
  static std::array<std::uint8_t, 2> packed(const std::array<float, 3>& direction);
  static std::array<float, 3> unpacked(const std::array<std::uint8_t, 2>& direction);

  explicit PhotonMap(std::vector<Photon> photons);

  const Photon& photon(std::uint32_t i) const { return photons_[i]; }

  /// Replaces `found` by the `count` photons nearest to a point, or by all if there are fewer. They
  /// are in no order.
  void findNearest(
    const std::array<float, 3>& point, std::size_t count, std::vector<Neighbour>& found) const;
  /// W/m2 at a point of a surface: the power of the photons, of the nearest `count`, that flew
  /// against the normal, over the disc through the farthest one.
  float irradiance(const std::array<float, 3>& point, const std::array<float, 3>& normal,
    std::size_t count, std::vector<Neighbour>& found) const;

private:
  struct Box
  {
    std::array<float, 3> lower, upper;
  };

  void balance(Photon* begin, Photon* end, std::size_t node, const Box& box);

  std::vector<Photon> photons_; ///< those below node i are nodes 2 i + 1 and 2 i + 2, and theirs
};
