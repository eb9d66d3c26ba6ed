#include "Contest.h"

#include "Timing.h"

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

template <typename T>
std::vector<T> everyNth(const std::vector<T>& values, std::size_t n)
{
  std::vector<T> chosen;
  for (std::size_t i = 0; i < values.size(); i += n)
  {
    chosen.push_back(values[i]);
  }
  return chosen;
}

std::size_t strideOf(const Contender& contender, std::size_t rays)
{
  return std::max<std::size_t>(1, rays / contender.mostRays);
}

std::size_t countMismatches(const std::vector<Hit>& truth, const std::vector<Hit>& hits)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < hits.size(); ++i)
  {
    count += differ(truth[i], hits[i]);
  }
  return count;
}

double mismatchesOf(
  const Contender& contender, const std::vector<Hit>& truth, const std::vector<Hit>& hits)
{
  const std::size_t mismatches = countMismatches(truth, hits);
  const double share = static_cast<double>(mismatches) / static_cast<double>(hits.size());
  if (mismatches > 1 && share > contender.mostMismatches)
  {
    throw std::runtime_error(contender.caster->name() +
      " finds other hits: " + std::to_string(mismatches) + " of " + std::to_string(hits.size()));
  }
  return share;
}

}

std::vector<Performance> compete(
  const std::vector<Contender>& contenders, const std::vector<Ray>& rays, int rounds)
{
  std::vector<std::vector<Hit>> hits;
  std::vector<std::function<void()>> jobs;
  hits.reserve(contenders.size()); // the jobs refer into it
  for (const Contender& contender : contenders)
  {
    const std::vector<Ray> chosen = everyNth(rays, strideOf(contender, rays.size()));
    contender.caster->setRays(chosen);
    hits.emplace_back(chosen.size());
    jobs.push_back([&contender, &found = hits.back()] { contender.caster->cast(found); });
  }
  for (const auto& job : jobs)
  {
    job();
  }
  std::vector<Performance> performances;
  for (std::size_t i = 0; i < contenders.size(); ++i)
  {
    const auto truth = everyNth(hits[0], strideOf(contenders[i], rays.size()));
    performances.push_back({ {}, mismatchesOf(contenders[i], truth, hits[i]) });
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
