// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/SolidSides.h"

#include "Meshes/MeshEdges.h"
#include "Meshes/ShellNesting.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace irradiance
{

namespace
{

/// Sets of connected triangles. Each triangle knows whether its orientation is opposite to the
/// orientation of the first in its set.
class OrientedSets
{
public:
  explicit OrientedSets(std::size_t size)
    : parent_(size)
    , isTurned_(size, 0)
  {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  std::uint32_t root(std::uint32_t i, bool& isTurned) const
  {
    isTurned = false;
    while (parent_[i] != i)
    {
      isTurned = isTurned != (isTurned_[i] != 0);
      i = parent_[i];
    }
    return i;
  }

  /// False if it contradicts what was joined before.
  bool join(std::uint32_t i, std::uint32_t j, bool isOpposite)
  {
    bool isTurnedI, isTurnedJ;
    std::uint32_t a = root(i, isTurnedI), b = root(j, isTurnedJ);
    const bool isTurned = isOpposite != (isTurnedI != isTurnedJ);
    if (a == b)
    {
      return !isTurned;
    }
    if (size(a) < size(b))
    {
      std::swap(a, b);
    }
    sizes_[a] = size(a) + size(b);
    parent_[b] = a;
    isTurned_[b] = isTurned ? 1 : 0;
    return true;
  }

private:
  std::uint32_t size(std::uint32_t root) const
  {
    const auto found = sizes_.find(root);
    return found == sizes_.end() ? 1 : found->second;
  }

  std::vector<std::uint32_t> parent_;
  std::vector<char> isTurned_;
  std::unordered_map<std::uint32_t, std::uint32_t> sizes_;
};

class ShellSearch
{
public:
  /// Sets the shells, and the shell of each triangle.
  ShellSearch(SolidSides& sides, const std::vector<Triangle>& triangles,
    const std::vector<std::uint32_t>& partOf, const std::vector<bool>& isLamp,
    const CancelPoint& cancelPoint)
    : sides_(sides)
    , triangles_(triangles)
    , partOf_(partOf)
    , isLamp_(isLamp)
    , pace_(cancelPoint)
    , isTurned_(triangles.size(), 0)
  {
    sides.shellOf.assign(triangles.size(), kNoShell);
    std::vector<std::uint32_t> all(triangles.size());
    std::iota(all.begin(), all.end(), 0u);
    find(all, true, false);
    find(open(true), true, false);
    find(open(true), false, false);
    find(open(false), true, true);
  }

  /// True if the triangle has its front inside.
  bool isTurned(std::size_t triangle) const { return isTurned_[triangle] != 0; }

private:
  using Edges = std::vector<MeshEdge>;

  /// The triangles that are in no closed shell yet.
  std::vector<std::uint32_t> open(bool withoutLamps) const
  {
    std::vector<std::uint32_t> open;
    for (std::uint32_t i = 0; i < triangles_.size(); ++i)
    {
      if (sides_.shellOf[i] == kNoShell && !(withoutLamps && isLamp_[i]))
      {
        open.push_back(i);
      }
    }
    return open;
  }

  /// Finds the shells of the chosen triangles and keeps the closed ones, or all.
  void find(const std::vector<std::uint32_t>& chosen, bool byParts, bool keepsOpen)
  {
    Edges edges =
      meshEdges(triangles_, chosen, byParts ? partOf_ : std::vector<std::uint32_t>(), pace_);
    OrientedSets sets(chosen.size());
    std::vector<std::uint32_t> flawed; // at least one triangle of each shell that does not close
    for (std::size_t i = 0; i < edges.size();)
    {
      std::size_t end = i + 1;
      while (end < edges.size() && edges[end].corners == edges[i].corners)
      {
        ++end;
      }
      pace_.step(end - i);
      const bool isPaired = (end - i == 2) ||
        pairAround(chosen, edges.begin() + static_cast<std::ptrdiff_t>(i),
          edges.begin() + static_cast<std::ptrdiff_t>(end));
      for (std::size_t k = i; k < end; ++k)
      {
        const MeshEdge& other = edges[isPaired ? i + ((k - i) ^ 1) : i];
        const bool isJoined =
          sets.join(other.triangle, edges[k].triangle, other.isForward == edges[k].isForward);
        if (!isPaired || !isJoined)
        {
          flawed.push_back(edges[k].triangle);
        }
      }
      i = end;
    }
    keep(chosen, sets, flawed, keepsOpen);
  }

  /// Where several bodies share an edge, orders its triangles in pairs that belong together. Going
  /// around the edge, solid matter begins behind a triangle that runs backward along it and ends
  /// behind the next one that runs forward. False if they do not pair.
  bool pairAround(
    const std::vector<std::uint32_t>& chosen, Edges::iterator begin, Edges::iterator end) const
  {
    const auto forward = std::count_if(begin, end, [](const MeshEdge& e) { return e.isForward; });
    if (2 * forward != end - begin)
    {
      return false;
    }
    const auto corner = [&](const MeshEdge& edge, int k) -> const Vector3& {
      return cornerOf(triangles_[chosen[edge.triangle]], edge.corner + k);
    };
    const Vector3 axis =
      (begin->isForward ? 1.0 : -1.0) * (corner(*begin, 1) - corner(*begin, 0)).normalized();
    const auto across = [&](const MeshEdge& edge) -> Vector3 {
      const Vector3 d = corner(edge, 2) - corner(edge, 0);
      return d - axis.dot(d) * axis;
    };
    const Vector3 zero = across(*begin), quarter = axis.cross(zero);
    std::vector<std::pair<double, MeshEdge>> around;
    for (auto edge = begin; edge != end; ++edge)
    {
      const Vector3 d = across(*edge);
      around.emplace_back(std::atan2(d.dot(quarter), d.dot(zero)), *edge);
    }
    // Of two coinciding triangles, one ends a solid and the other begins the next.
    constexpr double kSameAngle = 1e-6;
    const auto byAngle = [](const auto& a, const auto& b) { return a.first < b.first; };
    std::sort(around.begin(), around.end(), byAngle);
    for (std::size_t i = 1; i < around.size(); ++i)
    {
      if (around[i].first - around[i - 1].first < kSameAngle)
      {
        around[i].first = around[i - 1].first;
      }
    }
    for (auto& [angle, edge] : around)
    {
      angle = angle > kPi - kSameAngle ? -kPi : std::max(angle, -kPi);
    }
    std::sort(around.begin(), around.end(), [](const auto& a, const auto& b) {
      return std::make_pair(a.first, !a.second.isForward) <
        std::make_pair(b.first, !b.second.isForward);
    });
    const auto first = std::find_if(
      around.begin(), around.end(), [](const auto& entry) { return !entry.second.isForward; });
    std::rotate(around.begin(), first, around.end());
    for (std::size_t i = 0; i < around.size(); ++i)
    {
      if (around[i].second.isForward != (i % 2 == 1))
      {
        return false;
      }
      *(begin + static_cast<std::ptrdiff_t>(i)) = around[i].second;
    }
    return true;
  }

  void keep(const std::vector<std::uint32_t>& chosen, const OrientedSets& sets,
    const std::vector<std::uint32_t>& flawed, bool keepsOpen)
  {
    struct Found
    {
      Shell shell;
      Vector3 origin;
      /// Six times the enclosed one; negative if the first triangle has its front inside.
      double volume = 0;
      double given = 0; // the same with the triangles oriented as given
      std::uint32_t number = kNoShell;
    };
    std::unordered_map<std::uint32_t, Found> found;
    bool isTurned;
    for (std::uint32_t i = 0; i < chosen.size(); ++i)
    {
      pace_.step(16);
      const Triangle& t = triangles_[chosen[i]];
      Found& shell = found.try_emplace(sets.root(i, isTurned), Found{ {}, t.a }).first->second;
      const double volume =
        (t.a - shell.origin).dot((t.b - shell.origin).cross(t.c - shell.origin));
      shell.volume += isTurned ? -volume : volume;
      shell.given += volume;
      shell.shell.bounds.add(t.bounds());
      shell.shell.area += t.area();
    }
    for (auto& entry : found)
    {
      constexpr double kFlat = 0x1p-20;
      Found& shell = entry.second;
      const double size = shell.shell.bounds.extent().prod();
      shell.shell.isClosed = std::abs(shell.volume) > kFlat * size;
      shell.shell.volume = std::abs(shell.volume) / 6;
      shell.shell.isTurned = shell.given < -0.5 * std::abs(shell.volume);
    }
    for (const std::uint32_t triangle : flawed)
    {
      found.at(sets.root(triangle, isTurned)).shell.isClosed = false;
    }
    for (std::uint32_t i = 0; i < chosen.size(); ++i)
    {
      Found& shell = found.at(sets.root(i, isTurned));
      if (!shell.shell.isClosed && !keepsOpen)
      {
        continue;
      }
      if (shell.number == kNoShell)
      {
        shell.number = static_cast<std::uint32_t>(sides_.shells.size());
        sides_.shells.push_back(shell.shell);
      }
      sides_.shellOf[chosen[i]] = shell.number;
      isTurned_[chosen[i]] = isTurned != (shell.volume < 0) ? 1 : 0;
    }
  }

  SolidSides& sides_;
  const std::vector<Triangle>& triangles_;
  const std::vector<std::uint32_t>& partOf_;
  const std::vector<bool>& isLamp_;
  ThrottledCancelPoint pace_;
  std::vector<char> isTurned_;
};

}

SolidSides solidSides(const std::vector<Triangle>& triangles,
  const std::vector<std::uint32_t>& partOf, const std::vector<bool>& isLamp, bool mayHoldRooms,
  const CancelPoint& cancelPoint)
{
  SolidSides sides;
  const ShellSearch search(sides, triangles, partOf, isLamp, cancelPoint);
  Box all;
  for (const Shell& shell : sides.shells)
  {
    all.add(shell.bounds);
  }
  for (Shell& shell : sides.shells)
  {
    shell.isOutermost = shell.isClosed && holds(shell.bounds, all);
  }
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
  {
    sides.of.push_back(!sides.shell(i).isClosed ? SolidSide::None
        : search.isTurned(i)                    ? SolidSide::InFront
                                                : SolidSide::Behind);
  }
  markRooms(sides.shells, shellsAround(triangles, sides, cancelPoint), mayHoldRooms, cancelPoint);
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
  {
    if (sides.shell(i).isRoom)
    {
      sides.of[i] = sides.of[i] == SolidSide::Behind ? SolidSide::InFront : SolidSide::Behind;
    }
  }
  return sides;
}

}
