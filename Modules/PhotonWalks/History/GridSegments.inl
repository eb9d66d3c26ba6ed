// SPDX-License-Identifier: BSD-3-Clause
// No include guard: the kernel of each instruction set includes this once, between the marks of its
// target. Plain loops over lanes: what they compute is the same on all.

namespace irradiance
{
namespace
{

constexpr std::size_t kGridLanes = 8;
static_assert(RayColumns::kPadding >= kGridLanes && GridSegments::kSize % kGridLanes == 0);

/// Some rays on the grid: origin + t * along is where a ray is at distance t.
struct GridRays
{
  double origin[3][kGridLanes], along[3][kGridLanes], reach[kGridLanes];

  __attribute__((always_inline))
  GridRays(const PointGrid& grid, const RayColumns& rays, std::size_t first)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const double center = grid.center[axis], perStep = grid.perStep[axis];
      for (std::size_t i = 0; i < kGridLanes; ++i)
      {
        origin[axis][i] = (rays.origin[axis][first + i] - center) * perStep;
        along[axis][i] = static_cast<double>(rays.direction[axis][first + i]) * perStep;
      }
    }
    for (std::size_t i = 0; i < kGridLanes; ++i)
    {
      reach[i] = rays.distance[first + i];
    }
  }
};

/// Rounds to the nearest place within reach, ties to even. NaN is anywhere.
__attribute__((always_inline)) inline void roundToGrid(const double* from, std::int16_t* to)
{
  constexpr double kRounder = 0x1.8p52, kReach = PointGrid::kReach;
  std::int32_t places[kGridLanes];
  for (std::size_t i = 0; i < kGridLanes; ++i)
  {
    double place = from[i] < kReach ? from[i] : kReach;
    place = place > -kReach ? place : -kReach;
    places[i] = static_cast<std::int32_t>((place + kRounder) - kRounder);
  }
  for (std::size_t i = 0; i < kGridLanes; ++i)
  {
    to[i] = static_cast<std::int16_t>(places[i]);
  }
}

/// Writes the rays' segments; returns how many of them are not whole within the grid.
__attribute__((always_inline)) inline int placeWhole(
  const GridRays& rays, std::int64_t* isCut, GridSegments& segments, std::size_t at)
{
  constexpr double kReach = PointGrid::kReach;
  std::int64_t isIn[kGridLanes];
  std::fill_n(isIn, kGridLanes, 1);
  for (int axis = 0; axis < 3; ++axis)
  {
    double end[kGridLanes];
    for (std::size_t i = 0; i < kGridLanes; ++i)
    {
      const double from = rays.origin[axis][i], to = from + rays.reach[i] * rays.along[axis][i];
      // An escape ends at infinity, or at NaN where it runs along another axis.
      isIn[i] &=
        std::int64_t{ std::fabs(from) <= kReach } & std::int64_t{ std::fabs(to) <= kReach };
      end[i] = to;
    }
    roundToGrid(rays.origin[axis], segments.ends[axis] + at);
    roundToGrid(end, segments.ends[3 + axis] + at);
  }
  std::int64_t cut = 0;
  for (std::size_t i = 0; i < kGridLanes; ++i)
  {
    isCut[i] = 1 - isIn[i];
    cut += isCut[i];
  }
  return static_cast<int>(cut);
}

/// The distances between which rays are within the grid.
struct GridSpan
{
  double from[kGridLanes], to[kGridLanes];

  __attribute__((always_inline)) GridSpan(const GridRays& rays, const std::int64_t* isCut)
  {
    constexpr double kReach = PointGrid::kReach;
    for (std::size_t i = 0; i < kGridLanes; ++i)
    {
      from[i] = 0;
      to[i] = rays.reach[i];
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      for (std::size_t i = 0; i < kGridLanes; ++i)
      {
        const double lower = (-kReach - rays.origin[axis][i]) / rays.along[axis][i],
                     upper = (kReach - rays.origin[axis][i]) / rays.along[axis][i];
        const double enters = lower < upper ? lower : upper, leaves = lower > upper ? lower : upper;
        // NaN, from a ray along a face of the grid, changes nothing.
        from[i] = isCut[i] != 0 && enters > from[i] ? enters : from[i];
        to[i] = isCut[i] != 0 && leaves < to[i] ? leaves : to[i];
      }
    }
  }
};

/// Writes the same segments again, cut.
__attribute__((always_inline)) inline void placeCut(
  const GridRays& rays, const std::int64_t* isCut, GridSegments& segments, std::size_t at)
{
  const GridSpan span(rays, isCut);
  for (int axis = 0; axis < 3; ++axis)
  {
    double begin[kGridLanes], end[kGridLanes];
    for (std::size_t i = 0; i < kGridLanes; ++i)
    {
      const bool isInside = span.from[i] <= span.to[i];
      const double from = rays.origin[axis][i] + span.from[i] * rays.along[axis][i],
                   to = rays.origin[axis][i] + span.to[i] * rays.along[axis][i];
      begin[i] = isInside ? from : PointGrid::kReach;
      end[i] = isInside ? to : PointGrid::kReach;
    }
    roundToGrid(begin, segments.ends[axis] + at);
    roundToGrid(end, segments.ends[3 + axis] + at);
  }
  for (std::size_t i = 0; i < kGridLanes; ++i)
  {
    const bool isNear = std::fabs(rays.origin[0][i]) < GridSegments::kFarthest &&
      std::fabs(rays.origin[1][i]) < GridSegments::kFarthest &&
      std::fabs(rays.origin[2][i]) < GridSegments::kFarthest;
    segments.states[at + i] = isCut[i] == 0 ? GridSegments::Whole
      : isNear                              ? GridSegments::Cut
                                            : GridSegments::TooFar;
  }
}

__attribute__((always_inline)) inline void placeAllOnGrid(const PointGrid& grid,
  const RayColumns& columns, std::size_t first, std::size_t count, GridSegments& segments)
{
  for (std::size_t at = 0; at < count; at += kGridLanes)
  {
    const GridRays rays(grid, columns, first + at);
    std::int64_t isCut[kGridLanes];
    for (std::size_t i = 0; i < kGridLanes; ++i)
    {
      segments.states[at + i] = GridSegments::Whole;
    }
    if (placeWhole(rays, isCut, segments, at) > 0)
    {
      placeCut(rays, isCut, segments, at);
    }
  }
}

}
}
