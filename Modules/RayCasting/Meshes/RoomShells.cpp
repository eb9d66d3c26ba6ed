// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/RoomShells.h"

#include "Meshes/ShellNesting.h"

#include <algorithm>
#include <numeric>

namespace irradiance
{

namespace
{

/// A sheet as large as a side of the box lies against it. A smaller one lies in it, or lights it.
bool isSmallerThanASide(const Box& inner, const Box& outer)
{
  const double rounding = 0x1p-32 * outer.magnitude();
  return (inner.extent().array() < outer.extent().array() - rounding).count() >= 2;
}

/// Finds the closed shells that are solid outside: rooms, and the cavities of bodies.
class RoomSearch
{
public:
  /// `around`: see shellsAround().
  RoomSearch(std::vector<Shell>& shells, const std::vector<std::uint32_t>& around)
    : shells_(shells)
    , around_(around)
    , byX_(shells.size())
  {
    std::iota(byX_.begin(), byX_.end(), 0u);
    std::sort(byX_.begin(), byX_.end(),
      [&](std::uint32_t i, std::uint32_t k) { return lowerX(i) < lowerX(k); });
  }

  void markRooms(const CancelPoint& cancelPoint)
  {
    ThrottledCancelPoint pace(cancelPoint);
    for (std::uint32_t i = 0; i < shells_.size(); ++i)
    {
      Shell& shell = shells_[i];
      if (shell.isClosed)
      {
        const std::vector<std::uint32_t> cavities = shell.isTurned ? Numbers() : cavitiesOf(i);
        shell.isRoom =
          shell.isTurned == shell.isOutermost ? shell.isOutermost : isFurnished(i, cavities, pace);
        shell.isOutermost = shell.isOutermost && (shell.isRoom || cavities.empty());
      }
    }
  }

  /// A shell with its front inside that lies in the solid of a body. Larger ones first, as a cavity
  /// has no solid inside.
  void markCavities()
  {
    Numbers bySize(byX_);
    const auto size = [&](std::uint32_t i) { return shells_[i].bounds.extent().squaredNorm(); };
    std::sort(bySize.begin(), bySize.end(),
      [&](std::uint32_t i, std::uint32_t k) { return size(i) > size(k); });
    for (const std::uint32_t i : bySize)
    {
      shells_[i].isRoom =
        shells_[i].isRoom || (around_[i] != kNoShell && !shells_[around_[i]].isRoom);
    }
  }

private:
  using Numbers = std::vector<std::uint32_t>;

  double lowerX(std::uint32_t shell) const { return shells_[shell].bounds.lower[0]; }

  /// If the closed shell should be a body.
  Numbers cavitiesOf(std::uint32_t number) const
  {
    Numbers cavities;
    for (std::uint32_t i = 0; i < shells_.size() && shells_[number].isOutermost; ++i)
    {
      if (around_[i] == number)
      {
        cavities.push_back(i);
      }
    }
    return cavities;
  }

  /// Whether a shell holds something that is not, or in, one of its cavities. What touches the
  /// outside of a body with cavities is not in it.
  bool isFurnished(std::uint32_t number, const Numbers& cavities, ThrottledCancelPoint& pace) const
  {
    const Box& outer = shells_[number].bounds;
    const double rounding = 0x1p-32 * outer.magnitude();
    Box within = outer;
    within.inflate(cavities.empty() ? 0 : -4 * rounding);
    auto i = std::lower_bound(byX_.begin(), byX_.end(), within.lower[0] - rounding,
      [&](std::uint32_t shell, double x) { return lowerX(shell) < x; });
    for (; i != byX_.end() && lowerX(*i) <= within.upper[0]; ++i)
    {
      pace.step();
      const Box& inner = shells_[*i].bounds;
      const auto isOfCavity = [&](std::uint32_t cavity) {
        return holds(shells_[cavity].bounds, inner);
      };
      if (*i != number && holds(within, inner) && isSmallerThanASide(inner, outer) &&
        std::none_of(cavities.begin(), cavities.end(), isOfCavity))
      {
        return true;
      }
    }
    return false;
  }

  std::vector<Shell>& shells_;
  const Numbers& around_;
  Numbers byX_; ///< the shells by the lower bounds along x
};

}

void markRooms(std::vector<Shell>& shells, const std::vector<std::uint32_t>& around,
  bool mayHoldRooms, const CancelPoint& cancelPoint)
{
  RoomSearch rooms(shells, around);
  if (mayHoldRooms)
  {
    rooms.markRooms(cancelPoint);
  }
  rooms.markCavities();
}

}
