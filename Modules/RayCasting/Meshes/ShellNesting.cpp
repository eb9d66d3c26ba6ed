// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/ShellNesting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace irradiance
{

namespace
{

/// A point just inside of a shell with its front inside.
struct Sample
{
  Vector3 point;
  std::uint32_t shell;
  double row; ///< across y; there are about as many rows as a row has points
};

bool isBefore(const Sample& a, const Sample& b)
{
  return std::make_pair(a.row, a.point[2]) < std::make_pair(b.row, b.point[2]);
}

/// Near no edge of a regular mesh, as seen along an axis.
Vector3 insideOf(const Triangle& t, SolidSide side, const Box& bounds)
{
  const double step = std::max(0x1p-24 * bounds.extent().norm(), 0x1p-44 * bounds.magnitude());
  const Vector3 inwards = (side == SolidSide::InFront ? 1.0 : -1.0) * t.areaVector().normalized();
  return t.a + 0.4511 * (t.b - t.a) + 0.2352 * (t.c - t.a) + step * inwards;
}

/// In no row yet. Adds to the number of each shell's samples.
std::vector<Sample> takeSamples(const std::vector<Triangle>& triangles, const SolidSides& bodies,
  std::vector<std::uint32_t>& samplesOf)
{
  constexpr std::uint32_t kSamples = 8; // of a shell, at least, if it has so many triangles
  const std::vector<Shell>& shells = bodies.shells;
  std::vector<Sample> samples;
  if (std::count_if(shells.begin(), shells.end(), [](const Shell& s) { return s.isClosed; }) < 2)
  {
    return samples;
  }
  std::vector<std::uint32_t> counts(shells.size(), 0), next(shells.size(), 0);
  for (const std::uint32_t shell : bodies.shellOf)
  {
    ++counts[shell];
  }
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
  {
    const std::uint32_t shell = bodies.shellOf[i];
    const bool isSampled = shells[shell].isClosed && shells[shell].isTurned &&
      next[shell]++ % std::max(1u, counts[shell] / kSamples) == 0;
    if (isSampled && triangles[i].area() > 0)
    {
      ++samplesOf[shell];
      samples.push_back({ insideOf(triangles[i], bodies.of[i], shells[shell].bounds), shell, 0 });
    }
  }
  return samples;
}

/// Seen along x, whether a ray from the point along z crosses an edge. The two triangles at an
/// edge get the same answer, so of a closed shell the ray along x crosses an even number.
bool isBeside(const Vector3& a, const Vector3& b, const Vector3& point)
{
  if ((a[1] <= point[1]) == (b[1] <= point[1]))
  {
    return false;
  }
  const Vector3 &p = a[1] < b[1] ? a : b, &q = a[1] < b[1] ? b : a;
  return (point[2] - p[2]) * (q[1] - p[1]) < (q[2] - p[2]) * (point[1] - p[1]);
}

/// Whether the ray from the point along x crosses the triangle.
bool doesCross(const Triangle& t, const Vector3& point)
{
  const bool isHit =
    (isBeside(t.a, t.b, point) != isBeside(t.b, t.c, point)) != isBeside(t.c, t.a, point);
  const Vector3 n = t.areaVector(), d = point - t.a;
  return isHit && (n[0] > 0 ? n.dot(d) < 0 : n.dot(d) > 0);
}

/// Where the ray from each sample along x crosses closed shells: inner shell, outer shell, sample.
std::vector<std::array<std::uint32_t, 3>> crossingsOf(std::vector<Sample> samples,
  const std::vector<Triangle>& triangles, const SolidSides& bodies, const CancelPoint& cancelPoint)
{
  Box bounds;
  for (const Sample& sample : samples)
  {
    bounds.add(sample.point);
  }
  const double rowsPerLength =
    std::sqrt(static_cast<double>(samples.size())) / std::max(bounds.extent()[1], 0x1p-1000);
  const auto rowOf = [&](double y) { return std::floor((y - bounds.lower[1]) * rowsPerLength); };
  for (Sample& sample : samples)
  {
    sample.row = rowOf(sample.point[1]);
  }
  std::sort(samples.begin(), samples.end(), isBefore);
  std::vector<std::array<std::uint32_t, 3>> crossings;
  ThrottledCancelPoint pace(cancelPoint);
  for (std::uint32_t i = 0; i < triangles.size() && !samples.empty(); ++i)
  {
    pace.step();
    const Shell& shell = bodies.shell(i);
    const Box box = triangles[i].bounds();
    const double last = rowOf(std::min(box.upper[1], bounds.upper[1]));
    double row = std::max(rowOf(box.lower[1]), 0.0) - 1;
    while (shell.isClosed && ++row <= last)
    {
      auto sample = std::lower_bound(
        samples.begin(), samples.end(), Sample{ { 0, 0, box.lower[2] }, 0, row }, isBefore);
      for (; sample != samples.end() && sample->row == row && sample->point[2] <= box.upper[2];
           ++sample)
      {
        const Box& inner = bodies.shells[sample->shell].bounds;
        if (sample->point[0] <= box.upper[0] && holds(shell.bounds, inner) &&
          !holds(inner, shell.bounds) && doesCross(triangles[i], sample->point))
        {
          crossings.push_back({ sample->shell, bodies.shellOf[i],
            static_cast<std::uint32_t>(sample - samples.begin()) });
        }
      }
    }
  }
  std::sort(crossings.begin(), crossings.end());
  return crossings;
}

/// A sheet as large as a side of the box lies against it. A smaller one lies in it, or lights it.
bool isSmallerThanASide(const Box& inner, const Box& outer)
{
  const double rounding = 0x1p-32 * outer.magnitude();
  return (inner.extent().array() < outer.extent().array() - rounding).count() >= 2;
}

/// If the closed shell should be a body.
std::vector<std::uint32_t> cavitiesOf(
  const std::vector<Shell>& shells, const std::vector<std::uint32_t>& around, std::uint32_t number)
{
  std::vector<std::uint32_t> cavities;
  for (std::uint32_t i = 0; i < shells.size() && shells[number].isOutermost; ++i)
  {
    if (around[i] == number)
    {
      cavities.push_back(i);
    }
  }
  return cavities;
}

/// Whether a shell holds something that is not, or in, one of its cavities. What touches the
/// outside of a body with cavities is not in it. `byX`: the shells by the lower bounds along x.
bool isFurnished(const std::vector<Shell>& shells, const std::vector<std::uint32_t>& byX,
  std::uint32_t number, const std::vector<std::uint32_t>& cavities, ThrottledCancelPoint& pace)
{
  const auto lowerX = [&](std::uint32_t shell) { return shells[shell].bounds.lower[0]; };
  const Box& outer = shells[number].bounds;
  const double rounding = 0x1p-32 * outer.magnitude();
  Box within = outer;
  within.inflate(cavities.empty() ? 0 : -4 * rounding);
  auto i = std::lower_bound(byX.begin(), byX.end(), within.lower[0] - rounding,
    [&](std::uint32_t shell, double x) { return lowerX(shell) < x; });
  for (; i != byX.end() && lowerX(*i) <= within.upper[0]; ++i)
  {
    pace.step();
    const Box& inner = shells[*i].bounds;
    const auto isOfCavity = [&](
                              std::uint32_t cavity) { return holds(shells[cavity].bounds, inner); };
    if (*i != number && holds(within, inner) && isSmallerThanASide(inner, outer) &&
      std::none_of(cavities.begin(), cavities.end(), isOfCavity))
    {
      return true;
    }
  }
  return false;
}

}

std::vector<std::uint32_t> shellsAround(
  const std::vector<Triangle>& triangles, const SolidSides& bodies, const CancelPoint& cancelPoint)
{
  std::vector<std::uint32_t> samplesOf(bodies.shells.size(), 0);
  const std::vector<std::array<std::uint32_t, 3>> crossings =
    crossingsOf(takeSamples(triangles, bodies, samplesOf), triangles, bodies, cancelPoint);
  std::vector<std::uint32_t> around(bodies.shells.size(), kNoShell);
  const auto size = [&](std::uint32_t shell) {
    return bodies.shells[shell].bounds.extent().squaredNorm();
  };
  for (std::size_t i = 0; i < crossings.size();)
  {
    const auto [inner, outer, first] = crossings[i];
    std::uint32_t inside = 0;
    while (i < crossings.size() && crossings[i][0] == inner && crossings[i][1] == outer)
    {
      const std::size_t begin = i;
      while (i < crossings.size() && crossings[i] == crossings[begin])
      {
        ++i;
      }
      inside += (i - begin) % 2;
    }
    if (inside == samplesOf[inner] &&
      (around[inner] == kNoShell || size(outer) < size(around[inner])))
    {
      around[inner] = outer;
    }
  }
  return around;
}

void markRooms(std::vector<Shell>& shells, const std::vector<std::uint32_t>& around,
  bool mayHoldRooms, const CancelPoint& cancelPoint)
{
  std::vector<std::uint32_t> order(shells.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t k) {
    return shells[i].bounds.lower[0] < shells[k].bounds.lower[0];
  });
  ThrottledCancelPoint pace(cancelPoint);
  for (std::uint32_t i = 0; mayHoldRooms && i < shells.size(); ++i)
  {
    Shell& shell = shells[i];
    if (shell.isClosed)
    {
      const std::vector<std::uint32_t> cavities =
        shell.isTurned ? std::vector<std::uint32_t>() : cavitiesOf(shells, around, i);
      shell.isRoom = shell.isTurned == shell.isOutermost
        ? shell.isOutermost
        : isFurnished(shells, order, i, cavities, pace);
      shell.isOutermost = shell.isOutermost && (shell.isRoom || cavities.empty());
    }
  }
  // A shell with its front inside that lies in the solid of a body is a cavity. Larger ones first,
  // as a cavity has no solid inside.
  const auto size = [&](std::uint32_t i) { return shells[i].bounds.extent().squaredNorm(); };
  std::sort(order.begin(), order.end(),
    [&](std::uint32_t i, std::uint32_t k) { return size(i) > size(k); });
  for (const std::uint32_t i : order)
  {
    shells[i].isRoom = shells[i].isRoom || (around[i] != kNoShell && !shells[around[i]].isRoom);
  }
}

bool holds(const Box& outer, const Box& inner)
{
  const double rounding = 0x1p-32 * outer.magnitude();
  return (inner.lower.array() >= outer.lower.array() - rounding).all() &&
    (inner.upper.array() <= outer.upper.array() + rounding).all();
}

}
