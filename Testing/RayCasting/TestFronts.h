// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Scene/FrontCast.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace irradiance::test
{

/// GCC 12 drops the rounding of a vector of doubles that are cast to float and back at once.
inline double roundedToFloat(double x)
{
  const volatile float rounded = static_cast<float>(x);
  return static_cast<double>(rounded);
}

/// The ray with a direction that a front can hold: of length 1, and rounded to floats.
inline Ray asInFront(const Ray& ray)
{
  const Vector3 unit = (ray.direction / ray.direction.cwiseAbs().maxCoeff()).normalized();
  return { ray.origin,
    { roundedToFloat(unit[0]), roundedToFloat(unit[1]), roundedToFloat(unit[2]) }, ray.start };
}

/// Rays and their hits, as the columns of a front. Directions must be floats unless they stay
/// exact.
class TestFront
{
public:
  explicit TestFront(const SurfaceRecords& records, bool isExact = false)
    : records_(records)
    , isExact_(isExact)
  {
  }

  void set(const std::vector<Ray>& rays, const std::vector<Hit>& hits)
  {
    count_ = static_cast<std::uint32_t>(rays.size());
    // What stands beyond the last ray must not matter.
    const std::size_t room = TreeRays::roomFor(count_);
    const double none = std::numeric_limits<double>::quiet_NaN();
    for (int axis = 0; axis < 3; ++axis)
    {
      origin_[axis].assign(room, none);
      direction_[axis].assign(room, static_cast<float>(none));
      exactDirection_[axis].assign(room, none);
    }
    start_.assign(room, 0);
    distance_.assign(room, none);
    hit_.assign(room, 0);
    weight_[0].assign(room, 0);
    weight_[1].assign(room, 0);
    for (std::size_t i = 0; i < rays.size(); ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        origin_[axis][i] = rays[i].origin[axis];
        direction_[axis][i] = static_cast<float>(rays[i].direction[axis]);
        exactDirection_[axis][i] = rays[i].direction[axis];
      }
      start_[i] = records_.numbers().numberOf(rays[i].start);
      distance_[i] = hits[i].distance;
      hit_[i] = records_.numbers().numberOf(hits[i].id);
      weight_[0][i] = hits[i].weights[0];
      weight_[1][i] = hits[i].weights[1];
    }
  }

  TreeRays columns()
  {
    TreeRays rays{ count_, { origin_[0].data(), origin_[1].data(), origin_[2].data() },
      { nullptr, nullptr, nullptr }, { nullptr, nullptr, nullptr }, start_.data(), distance_.data(),
      hit_.data(), { weight_[0].data(), weight_[1].data() } };
    for (int axis = 0; axis < 3; ++axis)
    {
      rays.direction[axis] = isExact_ ? nullptr : direction_[axis].data();
      rays.exactDirection[axis] = isExact_ ? exactDirection_[axis].data() : nullptr;
    }
    return rays;
  }

  Hit hit(std::size_t i) const
  {
    return { distance_[i], records_.numbers().idOf(hit_[i]), { weight_[0][i], weight_[1][i] } };
  }

private:
  const SurfaceRecords& records_;
  bool isExact_;
  std::uint32_t count_ = 0;
  std::vector<double> origin_[3], exactDirection_[3], distance_;
  std::vector<float> direction_[3], weight_[2];
  std::vector<std::uint32_t> start_, hit_;
};

using CastFunction = void (FrontCast::*)(const Scene&, const FrontTriangles&, const TreeRays&);

/// Casts rays of any direction with these hits given.
inline std::vector<Hit> hitsOf(const Scene& scene, const SurfaceRecords& records,
  CastFunction function, const std::vector<Ray>& rays, const std::vector<Hit>& given)
{
  TestFront front(records, true);
  front.set(rays, given);
  FrontCast cast;
  (cast.*function)(scene, records, front.columns());
  std::vector<Hit> found;
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    found.push_back(front.hit(i));
  }
  return found;
}

inline Hit hitOf(const Scene& scene, const SurfaceRecords& records, CastFunction function,
  const Ray& ray, const Hit& given)
{
  return hitsOf(scene, records, function, { ray }, { given })[0];
}

}
