// SPDX-License-Identifier: BSD-3-Clause
// No include guard: each kernel includes it once, between the marks of its target.

namespace irradiance
{
namespace
{

/// The loops over lanes are functions of their own: within others, GCC 12 makes no SIMD of them.
template <class Real>
__attribute__((noinline)) unsigned passingSome(const TreeRays& rays,
  const Real* const (&directions)[3], std::uint32_t first, const EllipsoidFilter& filter)
{
  return EllipsoidLanes::passing(rays, directions, first, filter);
}

template <class Real>
std::uint32_t pickAll(const TreeRays& rays, const Real* const (&directions)[3],
  const EllipsoidFilter& filter, std::uint32_t* picked)
{
  std::uint32_t count = 0;
  for (std::uint32_t first = 0; first < rays.count; first += TreeRays::kLanes)
  {
    const std::uint32_t left = rays.count - first;
    const unsigned isThere = left < TreeRays::kLanes ? (1u << left) - 1 : 0xffffu;
    for (unsigned some = passingSome(rays, directions, first, filter) & isThere; some != 0;
         some &= some - 1)
    {
      picked[count++] = first + static_cast<std::uint32_t>(__builtin_ctz(some));
    }
  }
  return count;
}

inline std::uint32_t pickRays(
  const TreeRays& rays, const EllipsoidFilter& filter, std::uint32_t* picked)
{
  return rays.direction[0] ? pickAll(rays, rays.direction, filter, picked)
                           : pickAll(rays, rays.exactDirection, filter, picked);
}

template <class Real>
__attribute__((noinline)) void placeSome(BallLanes& lanes, const UnitFrame& frame,
  const TreeRays& rays, const Real* const (&directions)[3], std::uint32_t first)
{
  lanes.place<Real>(frame,
    { rays.origin[0] + first, rays.origin[1] + first, rays.origin[2] + first },
    { directions[0] + first, directions[1] + first, directions[2] + first });
}

/// Of kCount rays, from the lane `from` on.
template <class Lanes>
inline std::uint32_t findNearSome(const BallLanes& lanes, unsigned from, unsigned isThere,
  std::uint32_t first, const BodyBalls& balls, NearRays* found)
{
  using Floats = typename Lanes::Floats;
  const Floats px = Lanes::load(lanes.point[0] + from), py = Lanes::load(lanes.point[1] + from),
               pz = Lanes::load(lanes.point[2] + from), dx = Lanes::load(lanes.direction[0] + from),
               dy = Lanes::load(lanes.direction[1] + from),
               dz = Lanes::load(lanes.direction[2] + from),
               square = Lanes::load(lanes.square + from);
  std::uint32_t count = 0;
  const std::uint32_t size = balls.size();
  for (std::uint32_t body = 0; body < size; ++body)
  {
    const BodyBalls::Ball& ball = balls.data()[body];
    const Floats x = Lanes::all(ball.center[0]), y = Lanes::all(ball.center[1]),
                 z = Lanes::all(ball.center[2]);
    const Floats along = Lanes::mulAdd(x, dx, Lanes::mulAdd(y, dy, z * dz));
    // Of the point's distance from the centre, less that of the radius.
    const Floats gap = Lanes::mulAdd(
      x, px, Lanes::mulAdd(y, py, Lanes::mulAdd(z, pz, square + Lanes::all(ball.power))));
    const unsigned near = isThere & ~Lanes::bits(Lanes::isLess(along * along, gap)); // NaN is near
    // Few are near, and it cannot be foreseen which: there is no branch.
    found[count] = { first, static_cast<std::uint16_t>(body), static_cast<std::uint16_t>(near) };
    count += near != 0 ? 1 : 0;
  }
  return count;
}

template <class Lanes, class Real>
inline std::uint32_t findNearAll(
  const TreeRays& rays, const Real* const (&directions)[3], const BodyBalls& balls, NearRays* found)
{
  BallLanes lanes;
  std::uint32_t count = 0;
  for (std::uint32_t first = 0; first < rays.count; first += BallLanes::kSize)
  {
    placeSome<Real>(lanes, balls.frame(), rays, directions, first);
    for (unsigned from = 0; from < BallLanes::kSize && first + from < rays.count;
         from += Lanes::kCount)
    {
      const std::uint32_t left = std::min(rays.count - first - from, Lanes::kCount + 0u);
      count +=
        findNearSome<Lanes>(lanes, from, (1u << left) - 1, first + from, balls, found + count);
    }
  }
  return count;
}

template <class Lanes>
inline std::uint32_t findNearRays(const TreeRays& rays, const BodyBalls& balls, NearRays* found)
{
  return rays.direction[0] ? findNearAll<Lanes>(rays, rays.direction, balls, found)
                           : findNearAll<Lanes>(rays, rays.exactDirection, balls, found);
}

template <class Real>
__attribute__((noinline)) void prepareSome(PrepareLanes<Real>& lanes, const TriangleTree& tree,
  const TreeRays& rays, const Real* const (&directions)[3], std::uint32_t first)
{
  lanes.prepare(tree, { rays.origin[0] + first, rays.origin[1] + first, rays.origin[2] + first },
    { directions[0] + first, directions[1] + first, directions[2] + first }, rays.distance + first);
}

__attribute__((noinline)) void intersectSome(IntersectionLanes& lanes)
{
  lanes.intersect();
}

__attribute__((noinline)) void keepSome(
  ConfirmLanes& lanes, const TreeRays& rays, std::uint32_t first, const std::uint32_t* candidate)
{
  lanes.keep(rays, first, candidate);
}

template <class Real>
inline void prepareAll(const TriangleTree& tree, const TreeRays& rays,
  const Real* const (&directions)[3], PreparedQueries& queries)
{
  PrepareLanes<Real> lanes;
  queries.count = 0;
  queries.otherCount = 0;
  for (std::uint32_t first = 0; first < rays.count; first += TreeRays::kLanes)
  {
    prepareSome<Real>(lanes, tree, rays, directions, first);
    lanes.write(tree, rays, first, queries);
  }
}

inline void prepareRays(const TriangleTree& tree, const TreeRays& rays, PreparedQueries& queries)
{
  rays.direction[0] ? prepareAll<float>(tree, rays, rays.direction, queries)
                    : prepareAll<double>(tree, rays, rays.exactDirection, queries);
}

template <class Real>
inline void confirmAll(const TreeRays& rays, const Real* const (&directions)[3],
  const std::uint32_t* candidate, const CornerRows& corners)
{
  constexpr std::uint32_t kAhead = 2 * ConfirmLanes::kSize;
  ConfirmLanes lanes;
  for (std::uint32_t first = 0; first < rays.count; first += ConfirmLanes::kSize)
  {
    for (unsigned lane = 0; first + kAhead < rays.count && lane < ConfirmLanes::kSize; ++lane)
    {
      lanes.prefetch(candidate[first + kAhead + lane], corners);
    }
    lanes.setRays<Real>(rays, first, directions);
    lanes.setTriangles(candidate + first, corners);
    intersectSome(lanes.intersection);
    keepSome(lanes, rays, first, candidate + first);
  }
}

inline void confirmRays(
  const TreeRays& rays, const std::uint32_t* candidate, const CornerRows& corners)
{
  rays.direction[0] ? confirmAll<float>(rays, rays.direction, candidate, corners)
                    : confirmAll<double>(rays, rays.exactDirection, candidate, corners);
}

}
}
