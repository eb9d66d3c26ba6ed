// SPDX-License-Identifier: BSD-3-Clause
#include "Lights/PowerClasses.h"

#include "Geometry/Vector.h"
#include "Sampling/SplitMix.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <unordered_map>

namespace irradiance
{

namespace
{

constexpr std::size_t kMostClasses = 4;
constexpr double kWeak = 0.01; ///< beside the strongest of a class

/// Sets of lights, each with one of them that stands for all.
class Lamps
{
public:
  explicit Lamps(std::size_t count)
    : next_(count)
  {
    std::iota(next_.begin(), next_.end(), std::size_t{});
  }
  std::size_t of(std::size_t light)
  {
    while (next_[light] != light)
    {
      light = next_[light] = next_[next_[light]];
    }
    return light;
  }
  void join(std::size_t a, std::size_t b) { next_[of(a)] = of(b); }

private:
  std::vector<std::size_t> next_;
};

/// A corner of a light, by its object.
struct Corner
{
  std::uint32_t object;
  Vector3 place;

  friend bool operator==(const Corner& a, const Corner& b)
  {
    return a.object == b.object && a.place == b.place;
  }
};

struct CornerHash
{
  std::size_t operator()(const Corner& corner) const
  {
    const std::hash<double> hash;
    std::size_t value = corner.object;
    for (const double x : { corner.place[0], corner.place[1], corner.place[2] })
    {
      value = splitMix(value ^ hash(x));
    }
    return value;
  }
};

Lamps lampsOf(const std::vector<Light>& lights)
{
  Lamps lamps(lights.size());
  std::unordered_map<Corner, std::size_t, CornerHash> corners;
  for (std::size_t i = 0; i < lights.size(); ++i)
  {
    if (const auto* const area = std::get_if<AreaLight>(&lights[i].kind))
    {
      for (const Vector3& place : { area->triangle.a, area->triangle.b, area->triangle.c })
      {
        lamps.join(i, corners.emplace(Corner{ lights[i].cell.object, place }, i).first->second);
      }
    }
  }
  return lamps;
}

}

std::vector<LightTable> powerClassesOf(const LightTable& table, double leastPart)
{
  const std::vector<Light>& lights = table.lights();
  const auto isFainter = [](const Light& a, const Light& b) {
    return a.totalFlux() < b.totalFlux();
  };
  // Most often all lights are alike, and no lamp can be much stronger than another.
  const auto faintest = std::min_element(lights.begin(), lights.end(), isFainter);
  if (lights.empty() || faintest->totalFlux() >= kWeak * table.flux())
  {
    return { table };
  }
  Lamps lamps = lampsOf(lights);
  std::vector<double> flux(lights.size()); // W, of the lamp for which a light stands
  for (std::size_t i = 0; i < lights.size(); ++i)
  {
    flux[lamps.of(i)] += lights[i].totalFlux();
  }
  std::vector<LightTable> classes;
  for (double above = kInfinity; above > 0;)
  {
    double strongest = 0;
    for (std::size_t i = 0; i < lights.size(); ++i)
    {
      const double its = flux[lamps.of(i)];
      strongest = its < above ? std::max(strongest, its) : strongest;
    }
    double weakest = kWeak * strongest, rest = 0;
    for (std::size_t i = 0; i < lights.size(); ++i)
    {
      rest += flux[lamps.of(i)] < weakest ? lights[i].totalFlux() : 0;
    }
    if (classes.size() + 1 == kMostClasses || rest <= leastPart * table.flux())
    {
      weakest = 0;
    }
    std::vector<bool> chosen(lights.size());
    for (std::size_t i = 0; i < lights.size(); ++i)
    {
      const double its = flux[lamps.of(i)];
      chosen[i] = weakest <= its && its < above;
    }
    classes.push_back(table.only(chosen));
    above = weakest;
  }
  return classes;
}

}
