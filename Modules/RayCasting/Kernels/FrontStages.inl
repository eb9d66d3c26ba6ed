// SPDX-License-Identifier: BSD-3-Clause
// No include guard: each kernel includes it once, between the marks of its target.

namespace irradiance
{
namespace
{

inline std::uint32_t pickRays(
  const TreeRays& rays, const EllipsoidFilter& filter, std::uint32_t* picked)
{
  std::uint32_t count = 0;
  for (std::uint32_t first = 0; first < rays.count; first += TreeRays::kLanes)
  {
    const std::uint32_t left = rays.count - first;
    const unsigned isThere = left < TreeRays::kLanes ? (1u << left) - 1 : 0xffffu;
    for (unsigned some = EllipsoidLanes::passing(rays, first, filter) & isThere; some != 0;
         some &= some - 1)
    {
      picked[count++] = first + static_cast<std::uint32_t>(__builtin_ctz(some));
    }
  }
  return count;
}

/// The loops over lanes are functions of their own: within others, GCC 12 makes no SIMD of them.
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
