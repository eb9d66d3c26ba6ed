// SPDX-License-Identifier: BSD-3-Clause
#include "Rivals/CastContest.h"

#include "Measuring/Rounds.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

using namespace irradiance;

namespace
{

/// Lengths below are rounding: the room has 10 m, and coordinates are floats.
constexpr double kShortest = 0.01;

bool differ(const Hit& a, const Hit& b)
{
  if (!a || !b)
  {
    return bool(a) != bool(b);
  }
  return std::abs(a.distance - b.distance) > 1e-3 * std::max(a.distance, kShortest);
}

/// `truth`: the hits of all rays, of which the contender has cast every n-th.
double mismatchesOf(const Contender& contender, const std::vector<Hit>& truth,
  const std::vector<Hit>& hits, std::size_t n)
{
  std::size_t mismatches = 0;
  for (std::size_t i = 0; i < hits.size(); ++i)
  {
    const Hit& right = truth[n * i];
    mismatches += contender.mostMismatches > 0 ? differ(right, hits[i]) : right != hits[i];
  }
  const double share = static_cast<double>(mismatches) / static_cast<double>(hits.size());
  const std::size_t forgiven = contender.mostMismatches > 0 ? 1 : 0;
  if (mismatches > forgiven && share > contender.mostMismatches)
  {
    throw std::runtime_error(contender.name + " finds other hits: " + std::to_string(mismatches) +
      " of " + std::to_string(hits.size()));
  }
  return share;
}

}

std::vector<Performance> compete(
  const std::vector<Contender>& contenders, const std::vector<Ray>& rays, int rounds)
{
  std::vector<std::vector<Hit>> hits(contenders.size());
  std::vector<std::function<void()>> jobs;
  std::vector<Performance> performances;
  for (std::size_t i = 0; i < contenders.size(); ++i)
  {
    const std::size_t n = std::max<std::size_t>(1, rays.size() / contenders[i].mostRays);
    std::vector<Ray> chosen;
    for (std::size_t ray = 0; ray < rays.size(); ray += n)
    {
      chosen.push_back(rays[ray]);
    }
    hits[i].resize(chosen.size());
    jobs.push_back([cast = contenders[i].caster(chosen), &found = hits[i]] { cast(found); });
    jobs.back()();
    performances.push_back({ {}, mismatchesOf(contenders[i], hits[0], hits[i], n) });
  }
  const std::vector<std::vector<double>> seconds = timeInTurns(jobs, rounds);
  for (std::size_t i = 0; i < contenders.size(); ++i)
  {
    for (const double whole : seconds[i])
    {
      performances[i].seconds.push_back(whole / static_cast<double>(hits[i].size()));
    }
  }
  return performances;
}
