// SPDX-License-Identifier: BSD-3-Clause
#include "DirectLight/PowerClasses.h"

#include "DirectLight/FirstHits.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>

namespace irradiance
{

namespace
{

constexpr std::size_t kMostClasses = 4;
constexpr double kWeak = 0.15; ///< beside the strongest of a class

/// For each light one of its lamp, the same for all of these: it stands for the lamp.
std::vector<std::size_t> lampsOf(const std::vector<Light>& lights)
{
  std::vector<std::size_t> lamps(lights.size()); // each leads to the next of its lamp, or itself
  std::iota(lamps.begin(), lamps.end(), std::size_t{});
  const auto lastOf = [&](std::size_t light) {
    while (lamps[light] != light)
    {
      light = lamps[light] = lamps[lamps[light]];
    }
    return light;
  };
  std::map<std::tuple<std::uint32_t, double, double, double>, std::size_t> corners; // by object
  for (std::size_t i = 0; i < lights.size(); ++i)
  {
    if (const Triangle* const surface = lights[i].surface())
    {
      for (const Vector3& place : { surface->a, surface->b, surface->c })
      {
        const std::tuple corner(lights[i].cell.object, place[0], place[1], place[2]);
        const std::size_t other = corners.emplace(corner, i).first->second;
        lamps[lastOf(i)] = lastOf(other);
      }
    }
  }
  for (std::size_t i = 0; i < lights.size(); ++i)
  {
    lamps[i] = lastOf(i);
  }
  return lamps;
}

/// Where the light of lamps falls first.
class LampHits
{
public:
  LampHits(
    const LightTable& table, const SceneObjects& objects, const std::vector<std::size_t>& lamps)
    : arrivals_(table.lights().size())
    , cellOfTriangle_(objects.staticObject.material->cellOfTriangle)
    , strong_(2 * objects.staticObject.material->numberOfCells)
    , own_(strong_.size())
  {
    const FirstHits hits(objects, table);
    for (const FirstHits::Arrival& arrival : hits.arrivals())
    {
      arrivals_[lamps[arrival.light]].push_back(arrival);
    }
  }

  /// Those that others are compared with.
  void setStrong(const std::vector<std::size_t>& lamps)
  {
    std::fill(strong_.begin(), strong_.end(), 0);
    for (const std::size_t lamp : lamps)
    {
      for (const FirstHits::Arrival& arrival : arrivals_[lamp])
      {
        strong_[sideOf(arrival)] += arrival.flux;
      }
    }
  }

  /// Whether the light of a lamp falls mostly where the strong ones send more than it does. Where
  /// few rays arrive it is not.
  bool isOutshone(std::size_t lamp)
  {
    for (const FirstHits::Arrival& arrival : arrivals_[lamp])
    {
      own_[sideOf(arrival)][arrival.half] += arrival.flux;
    }
    double theirs = 0, its = 0;
    for (const FirstHits::Arrival& arrival : arrivals_[lamp])
    {
      theirs += arrival.flux * strong_[sideOf(arrival)];
      // Twice the other half: a ray always meets the cell that it meets.
      its += arrival.flux * 2 * own_[sideOf(arrival)][1 - arrival.half];
    }
    for (const FirstHits::Arrival& arrival : arrivals_[lamp])
    {
      own_[sideOf(arrival)] = {};
    }
    return theirs > its;
  }

private:
  std::size_t sideOf(const FirstHits::Arrival& arrival) const
  {
    return 2 * std::size_t{ cellOfTriangle_[arrival.triangle] } + (arrival.isFront ? 0 : 1);
  }

  std::vector<std::vector<FirstHits::Arrival>> arrivals_; ///< by lamp
  const std::vector<std::uint32_t>& cellOfTriangle_;
  std::vector<double> strong_;             ///< W, by side of a cell
  std::vector<std::array<double, 2>> own_; ///< likewise of one lamp, by half
};

}

std::vector<LightTable> powerClassesOf(
  const LightTable& table, const SceneObjects& objects, double leastPart)
{
  const std::vector<Light>& lights = table.lights();
  const std::vector<std::size_t> lamps = lampsOf(lights);
  std::vector<double> flux(lights.size()); // W, of the lamp for which a light stands
  for (std::size_t i = 0; i < lights.size(); ++i)
  {
    flux[lamps[i]] += lights[i].totalFlux();
  }
  std::vector<std::size_t> rest; // the strongest first
  for (std::size_t i = 0; i < lights.size(); ++i)
  {
    if (flux[i] > 0)
    {
      rest.push_back(i);
    }
  }
  std::stable_sort(
    rest.begin(), rest.end(), [&](std::size_t a, std::size_t b) { return flux[a] > flux[b]; });
  std::optional<LampHits> hits;
  std::vector<std::size_t> classOf(lights.size()); // of lamps
  std::size_t number = 0;
  for (; !rest.empty(); ++number)
  {
    const double weakest = kWeak * flux[rest.front()];
    const auto strong = std::partition_point(
      rest.begin(), rest.end(), [&](std::size_t lamp) { return flux[lamp] >= weakest; });
    const std::vector<std::size_t> members(rest.begin(), strong);
    std::vector<std::size_t> others(strong, rest.end());
    if (!others.empty() && !hits)
    {
      hits.emplace(table, objects, lamps);
    }
    if (!others.empty())
    {
      hits->setStrong(members);
      others.erase(std::remove_if(others.begin(), others.end(),
                     [&](std::size_t lamp) { return hits->isOutshone(lamp); }),
        others.end());
    }
    const double left = std::accumulate(others.begin(), others.end(), 0.0,
      [&](double sum, std::size_t lamp) { return sum + flux[lamp]; });
    if (number + 1 == kMostClasses || left <= leastPart * table.flux())
    {
      others.clear();
    }
    for (const std::size_t lamp : others)
    {
      classOf[lamp] = number + 1;
    }
    rest = std::move(others);
  }
  if (number <= 1)
  {
    return { table };
  }
  std::vector<LightTable> classes;
  for (std::size_t i = 0; i < number; ++i)
  {
    std::vector<bool> chosen(lights.size());
    for (std::size_t light = 0; light < lights.size(); ++light)
    {
      chosen[light] = classOf[lamps[light]] == i;
    }
    classes.push_back(table.only(chosen));
  }
  return classes;
}

}
