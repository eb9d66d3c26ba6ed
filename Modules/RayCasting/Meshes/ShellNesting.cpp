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

class NestingSearch
{
public:
  NestingSearch(const std::vector<Triangle>& triangles, const SolidSides& bodies,
    const CancelPoint& cancelPoint)
    : triangles_(triangles)
    , bodies_(bodies)
    , pace_(cancelPoint)
    , samplesOf_(bodies.shells.size(), 0)
  {
    takeSamples();
    for (std::uint32_t i = 0; i < triangles.size() && !samples_.empty(); ++i)
    {
      pace_.step();
      if (bodies.shell(i).isClosed)
      {
        addCrossings(triangles[i], bodies.shellOf[i]);
      }
    }
    std::sort(crossings_.begin(), crossings_.end());
  }

  std::vector<std::uint32_t> shellsAround() const
  {
    std::vector<std::uint32_t> around(bodies_.shells.size(), kNoShell);
    const auto size = [&](std::uint32_t shell) {
      return bodies_.shells[shell].bounds.extent().squaredNorm();
    };
    for (std::size_t i = 0; i < crossings_.size();)
    {
      const auto [inner, outer, first] = crossings_[i];
      std::uint32_t inside = 0;
      while (i < crossings_.size() && crossings_[i][0] == inner && crossings_[i][1] == outer)
      {
        const std::size_t begin = i;
        while (i < crossings_.size() && crossings_[i] == crossings_[begin])
        {
          ++i;
        }
        inside += (i - begin) % 2;
      }
      if (inside == samplesOf_[inner] &&
        (around[inner] == kNoShell || size(outer) < size(around[inner])))
      {
        around[inner] = outer;
      }
    }
    return around;
  }

private:
  /// Of a shell, at least, if it has so many triangles.
  static constexpr std::uint32_t kSamples = 8;

  void takeSamples()
  {
    const std::vector<Shell>& shells = bodies_.shells;
    if (std::count_if(shells.begin(), shells.end(), [](const Shell& s) { return s.isClosed; }) < 2)
    {
      return;
    }
    std::vector<std::uint32_t> counts(shells.size(), 0), next(shells.size(), 0);
    for (const std::uint32_t shell : bodies_.shellOf)
    {
      ++counts[shell];
    }
    for (std::uint32_t i = 0; i < triangles_.size(); ++i)
    {
      const std::uint32_t shell = bodies_.shellOf[i];
      const bool isSampled = shells[shell].isClosed && shells[shell].isTurned &&
        next[shell]++ % std::max(1u, counts[shell] / kSamples) == 0;
      if (isSampled && triangles_[i].area() > 0)
      {
        ++samplesOf_[shell];
        samples_.push_back({ insideOf(i), shell, 0 });
      }
    }
    sortByRow();
  }

  void sortByRow()
  {
    for (const Sample& sample : samples_)
    {
      bounds_.add(sample.point);
    }
    rowsPerLength_ =
      std::sqrt(static_cast<double>(samples_.size())) / std::max(bounds_.extent()[1], 0x1p-1000);
    for (Sample& sample : samples_)
    {
      sample.row = rowOf(sample.point[1]);
    }
    std::sort(samples_.begin(), samples_.end(), isBefore);
  }

  double rowOf(double y) const { return std::floor((y - bounds_.lower[1]) * rowsPerLength_); }

  static bool isBefore(const Sample& a, const Sample& b)
  {
    return std::make_pair(a.row, a.point[2]) < std::make_pair(b.row, b.point[2]);
  }

  /// Near no edge of a regular mesh, as seen along an axis.
  Vector3 insideOf(std::uint32_t triangle) const
  {
    const Triangle& t = triangles_[triangle];
    const Box& bounds = bodies_.shell(triangle).bounds;
    const double step = std::max(0x1p-24 * bounds.extent().norm(), 0x1p-44 * bounds.magnitude());
    const Vector3 inwards =
      (bodies_.of[triangle] == SolidSide::InFront ? 1.0 : -1.0) * t.areaVector().normalized();
    return t.a + 0.4511 * (t.b - t.a) + 0.2352 * (t.c - t.a) + step * inwards;
  }

  /// Where the ray from each sample along x crosses the triangle.
  void addCrossings(const Triangle& triangle, std::uint32_t outer)
  {
    const Box box = triangle.bounds();
    const double last = rowOf(std::min(box.upper[1], bounds_.upper[1]));
    double row = std::max(rowOf(box.lower[1]), 0.0) - 1;
    while (++row <= last)
    {
      auto sample = std::lower_bound(
        samples_.begin(), samples_.end(), Sample{ { 0, 0, box.lower[2] }, 0, row }, isBefore);
      for (; sample != samples_.end() && sample->row == row && sample->point[2] <= box.upper[2];
           ++sample)
      {
        const Box& inner = bodies_.shells[sample->shell].bounds;
        const Box& its = bodies_.shells[outer].bounds;
        if (sample->point[0] <= box.upper[0] && holds(its, inner) && !holds(inner, its) &&
          doesCross(triangle, sample->point))
        {
          crossings_.push_back(
            { sample->shell, outer, static_cast<std::uint32_t>(sample - samples_.begin()) });
        }
      }
    }
  }

  static bool doesCross(const Triangle& t, const Vector3& point)
  {
    const bool isHit =
      (isBeside(t.a, t.b, point) != isBeside(t.b, t.c, point)) != isBeside(t.c, t.a, point);
    const Vector3 n = t.areaVector(), d = point - t.a;
    return isHit && (n[0] > 0 ? n.dot(d) < 0 : n.dot(d) > 0);
  }

  /// Seen along x, whether a ray from the point along z crosses an edge. The two triangles at an
  /// edge get the same answer, so of a closed shell the ray along x crosses an even number.
  static bool isBeside(const Vector3& a, const Vector3& b, const Vector3& point)
  {
    if ((a[1] <= point[1]) == (b[1] <= point[1]))
    {
      return false;
    }
    const Vector3 &p = a[1] < b[1] ? a : b, &q = a[1] < b[1] ? b : a;
    return (point[2] - p[2]) * (q[1] - p[1]) < (q[2] - p[2]) * (point[1] - p[1]);
  }

  const std::vector<Triangle>& triangles_;
  const SolidSides& bodies_;
  ThrottledCancelPoint pace_;
  std::vector<Sample> samples_; ///< by rows, in each by z
  Box bounds_;                  ///< of their points
  double rowsPerLength_ = 0;
  std::vector<std::uint32_t> samplesOf_;
  std::vector<std::array<std::uint32_t, 3>> crossings_; ///< inner shell, outer shell, sample
};

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
  return NestingSearch(triangles, bodies, cancelPoint).shellsAround();
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
