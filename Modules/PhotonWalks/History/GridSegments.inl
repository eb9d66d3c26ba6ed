// SPDX-License-Identifier: BSD-3-Clause
// No include guard: the kernel of each instruction set includes this once, between the marks of its
// target. Each compiles these vectors to registers of its own size, and computes the same.

namespace irradiance
{
namespace
{

#define IRRADIANCE_LANES inline __attribute__((always_inline))

constexpr std::size_t kGridLanes = 8;
static_assert(RayColumns::kPadding >= kGridLanes && GridSegments::kSize % kGridLanes == 0);

using GridDoubles = double __attribute__((vector_size(8 * kGridLanes)));
using GridFloats = float __attribute__((vector_size(4 * kGridLanes)));
using GridInts = std::int32_t __attribute__((vector_size(4 * kGridLanes)));
using GridShorts = std::int16_t __attribute__((vector_size(2 * kGridLanes)));
using GridBytes = std::int8_t __attribute__((vector_size(kGridLanes)));
using GridMask =
  std::int64_t __attribute__((vector_size(8 * kGridLanes))); ///< -1 or 0 in each lane

/// Some rays on the grid: origin + t * along is where a ray is at distance t.
struct GridRays
{
  GridDoubles origin[3], along[3], reach;

  IRRADIANCE_LANES GridRays(const PointGrid& grid, const RayColumns& rays, std::size_t first)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      GridFloats direction;
      std::memcpy(&origin[axis], rays.origin[axis] + first, sizeof origin[axis]);
      std::memcpy(&direction, rays.direction[axis] + first, sizeof direction);
      origin[axis] = (origin[axis] - grid.center[axis]) * grid.perStep[axis];
      along[axis] = __builtin_convertvector(direction, GridDoubles) * grid.perStep[axis];
    }
    std::memcpy(&reach, rays.distance + first, sizeof reach);
  }
};

/// Rounds to the nearest place within reach, ties to even. NaN is anywhere.
IRRADIANCE_LANES void roundToGrid(const GridDoubles& from, std::int16_t* to)
{
  constexpr double kRounder = 0x1.8p52, kReach = PointGrid::kReach;
  const GridDoubles most = kReach - GridDoubles{}, least = -kReach - GridDoubles{};
  GridDoubles place = from < most ? from : most;
  place = place > least ? place : least;
  const GridInts whole = __builtin_convertvector((place + kRounder) - kRounder, GridInts);
  const GridShorts narrow = __builtin_convertvector(whole, GridShorts);
  std::memcpy(to, &narrow, sizeof narrow);
}

/// Writes the rays' segments; returns in `isIn` those that are whole within the grid.
IRRADIANCE_LANES void placeWhole(
  const GridRays& rays, GridMask& isIn, GridSegments& segments, std::size_t at)
{
  constexpr double kReach = PointGrid::kReach;
  isIn = ~GridMask{};
  for (int axis = 0; axis < 3; ++axis)
  {
    // An escape ends at infinity, or at NaN where it runs along another axis.
    const GridDoubles from = rays.origin[axis], to = from + rays.reach * rays.along[axis];
    isIn &= (from <= kReach) & (from >= -kReach) & (to <= kReach) & (to >= -kReach);
    roundToGrid(from, segments.ends[axis] + at);
    roundToGrid(to, segments.ends[3 + axis] + at);
  }
}

/// Writes the same segments again, cut, except those that are whole.
IRRADIANCE_LANES void placeCut(
  const GridRays& rays, const GridMask& isIn, GridSegments& segments, std::size_t at)
{
  constexpr double kReach = PointGrid::kReach;
  const GridDoubles zero{}, corner = kReach - zero;
  GridDoubles nearest = zero, farthest = rays.reach; // where rays are within the grid
  for (int axis = 0; axis < 3; ++axis)
  {
    const GridDoubles lower = (-kReach - rays.origin[axis]) / rays.along[axis],
                      upper = (kReach - rays.origin[axis]) / rays.along[axis];
    const GridDoubles enters = lower < upper ? lower : upper,
                      leaves = lower > upper ? lower : upper;
    // NaN, from a ray along a face of the grid, changes nothing.
    nearest = enters > nearest ? enters : nearest;
    farthest = leaves < farthest ? leaves : farthest;
  }
  nearest = isIn ? zero : nearest;
  farthest = isIn ? rays.reach : farthest;
  const GridMask isInside = nearest <= farthest;
  GridMask isNear = ~GridMask{};
  for (int axis = 0; axis < 3; ++axis)
  {
    const GridDoubles& origin = rays.origin[axis];
    const GridDoubles from = origin + nearest * rays.along[axis],
                      to = origin + farthest * rays.along[axis];
    roundToGrid(isInside ? from : corner, segments.ends[axis] + at);
    roundToGrid(isInside ? to : corner, segments.ends[3 + axis] + at);
    isNear &= (origin < GridSegments::kFarthest) & (origin > -GridSegments::kFarthest);
  }
  const GridMask cut = std::int64_t{ GridSegments::Cut } - GridMask{},
                 tooFar = std::int64_t{ GridSegments::TooFar } - GridMask{};
  const GridBytes states = __builtin_convertvector(isIn ? GridMask{}
      : isNear                                          ? cut
                                                        : tooFar,
    GridBytes);
  std::memcpy(segments.states + at, &states, sizeof states);
}

inline void placeAllOnGrid(const PointGrid& grid, const RayColumns& columns, std::size_t first,
  std::size_t count, GridSegments& segments)
{
  for (std::size_t at = 0; at < count; at += kGridLanes)
  {
    const GridRays rays(grid, columns, first + at);
    GridMask isIn;
    placeWhole(rays, isIn, segments, at);
    const GridBytes isOut = __builtin_convertvector(~isIn, GridBytes);
    std::uint64_t anyOut;
    static_assert(sizeof anyOut == sizeof isOut);
    std::memcpy(&anyOut, &isOut, sizeof anyOut);
    static_assert(GridSegments::Whole == 0);
    std::memset(segments.states + at, GridSegments::Whole, kGridLanes);
    if (anyOut != 0)
    {
      placeCut(rays, isIn, segments, at);
    }
  }
}

#undef IRRADIANCE_LANES

}
}
