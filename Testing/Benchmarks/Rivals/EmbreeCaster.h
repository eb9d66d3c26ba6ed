// SPDX-License-Identifier: BSD-3-Clause
#ifndef EmbreeCaster_h
#define EmbreeCaster_h

#include "Rivals/Caster.h"
#include "Rivals/EmbreeRays.h"

#include <memory>

/// `Packet`: see EmbreeRays.
template <class Packet>
Caster makeEmbreeCaster(std::shared_ptr<const EmbreeScene> scene)
{
  struct FloatRay
  {
    Eigen::Vector3f origin, direction;
  };
  return [scene](const std::vector<irradiance::Ray>& rays) -> Cast {
    std::vector<FloatRay> own;
    for (const irradiance::Ray& ray : rays)
    {
      own.push_back({ ray.origin.cast<float>(), ray.direction.cast<float>() });
    }
    return [scene, own](std::vector<irradiance::Hit>& hits) {
      constexpr std::size_t kWidth = EmbreeRays<Packet>::kWidth;
      EmbreeRays<Packet> packet(*scene, kWidth, 0);
      for (std::size_t first = 0; first < own.size(); first += kWidth)
      {
        const std::size_t count = std::min(kWidth, own.size() - first);
        for (std::size_t k = 0; k < count; ++k)
        {
          packet.set(k, own[first + k].origin, own[first + k].direction);
        }
        packet.cast(count);
        for (std::size_t k = 0; k < count; ++k)
        {
          hits[first + k] = packet.hit(k);
        }
      }
    };
  };
}

#endif
