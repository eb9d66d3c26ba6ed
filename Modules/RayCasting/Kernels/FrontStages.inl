// SPDX-License-Identifier: BSD-3-Clause
// No include guard: each kernel includes it once, between the marks of its target, after
// "Kernels/FrontStages.h" and the other headers it uses. Kernels name their lanes twice: `Boxes` for
// the boxes of a treelet, and for balls, `Lanes` for triangles.

#include "Kernels/WideQuery.inl"

namespace irradiance
{
namespace
{

/// For squared lengths of directions in double; rays whose direction is shorter or longer pass the
/// tests of ellipsoids and balls.
constexpr double kShortest = 0x1p-200, kLongest = 0x1p200;

/// Tests 16 rays from `first` on against the ellipsoid around an object, wherever they end: most
/// miss most objects. Returns those that may touch it, one bit each.
///
/// The loops over lanes are functions of their own: within others, GCC 12 makes no SIMD of them.
template <class Real>
__attribute__((noinline)) unsigned passing(const TreeRays& rays, const Real* const (&directions)[3],
  std::uint32_t first, const EllipsoidFilter& filter)
{
  /// Of the two squares whose difference is a squared distance; some 16 roundings of 2^-24.
  constexpr float kCancelled = 0x1p-19F;
  const double *ox = rays.origin[0] + first, *oy = rays.origin[1] + first,
               *oz = rays.origin[2] + first;
  const Real *dx = directions[0] + first, *dy = directions[1] + first, *dz = directions[2] + first;
  const double centerX = filter.center[0], centerY = filter.center[1], centerZ = filter.center[2],
               scale = filter.scale;
  const float* const w = filter.roundFromScaled;
  const float w0 = w[0], w1 = w[1], w2 = w[2], w3 = w[3], w4 = w[4], w5 = w[5], w6 = w[6],
              w7 = w[7], w8 = w[8];
  const float squaredRadius = filter.squaredRadius, byDistance = filter.byDistance;
  alignas(64) float gap[TreeRays::kLanes];
  for (unsigned lane = 0; lane < TreeRays::kLanes; ++lane)
  {
    const float x = static_cast<float>((centerX - ox[lane]) * scale),
                y = static_cast<float>((centerY - oy[lane]) * scale),
                z = static_cast<float>((centerZ - oz[lane]) * scale);
    const float px = w0 * x + w1 * y + w2 * z, py = w3 * x + w4 * y + w5 * z,
                pz = w6 * x + w7 * y + w8 * z;
    // Directions in floats have length 1.
    const double squaredLength = std::is_same_v<Real, float>
      ? 1.0
      : dx[lane] * dx[lane] + dy[lane] * dy[lane] + dz[lane] * dz[lane];
    const double unit = std::is_same_v<Real, float> ? 1.0 : 1 / __builtin_sqrt(squaredLength);
    const float ex = static_cast<float>(dx[lane] * unit), ey = static_cast<float>(dy[lane] * unit),
                ez = static_cast<float>(dz[lane] * unit);
    const float qx = w0 * ex + w1 * ey + w2 * ez, qy = w3 * ex + w4 * ey + w5 * ez,
                qz = w6 * ex + w7 * ey + w8 * ez;
    const float towards = px * qx + py * qy + pz * qz;
    const float along = towards > 0 ? towards : 0;
    const float distance = px * px + py * py + pz * pz, length = qx * qx + qy * qy + qz * qz;
    const float reach =
      squaredRadius + byDistance * (x * x + y * y + z * z) + kCancelled * distance;
    // By Pythagoras, times the length: without a division or a root, but with cancellation.
    const bool isExact = (squaredLength > kShortest) & (squaredLength < kLongest);
    gap[lane] = isExact ? (distance * length - along * along) - reach * length : 0.0F;
  }
  unsigned bits = 0;
  for (unsigned lane = 0; lane < TreeRays::kLanes; ++lane)
  {
    bits |= (gap[lane] > 0 ? 0u : 1u) << lane; // NaN passes
  }
  return bits;
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
    for (unsigned some = passing(rays, directions, first, filter) & isThere; some != 0;
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

/**
 * The lines of 16 rays in the frame of BodyBalls: each by its point closest to the centre there, so
 * that floats serve wherever a ray begins. Documentation/Theory.md, section 3, derives what pays
 * for rounding.
 */
struct BallLanes
{
  static constexpr unsigned kSize = TreeRays::kLanes;

  alignas(64) float point[3][kSize]; ///< times -2
  alignas(64) float direction[3][kSize];
  alignas(64) float square[kSize]; ///< of the point's distance

  template <class Real>
  __attribute__((noinline)) void place(const UnitFrame& frame, const TreeRays& rays,
    const Real* const (&directions)[3], std::uint32_t first)
  {
    // Of a ray that begins farther away, in the frame, that point is not exact enough: then all
    // balls are near.
    constexpr double kFarthest = 0x1p12;
    const double *ox = rays.origin[0] + first, *oy = rays.origin[1] + first,
                 *oz = rays.origin[2] + first;
    const Real *dx = directions[0] + first, *dy = directions[1] + first,
               *dz = directions[2] + first;
    const double centerX = frame.center[0], centerY = frame.center[1], centerZ = frame.center[2],
                 scale = frame.scale;
    // The columns are not the lanes' own memory.
#pragma GCC ivdep
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      const double x = (ox[lane] - centerX) * scale, y = (oy[lane] - centerY) * scale,
                   z = (oz[lane] - centerZ) * scale;
      const double u = dx[lane], v = dy[lane], w = dz[lane];
      const double squaredLength = u * u + v * v + w * w;
      const double way = (x * u + y * v + z * w) / squaredLength;
      const double px = x - way * u, py = y - way * v, pz = z - way * w;
      // Directions in floats have length 1.
      const double length = std::is_same_v<Real, float> ? 1.0 : __builtin_sqrt(squaredLength);
      const double squaredDistance = x * x + y * y + z * z;
      point[0][lane] = static_cast<float>(-2 * px);
      point[1][lane] = static_cast<float>(-2 * py);
      point[2][lane] = static_cast<float>(-2 * pz);
      direction[0][lane] = static_cast<float>(u / length);
      direction[1][lane] = static_cast<float>(v / length);
      direction[2][lane] = static_cast<float>(w / length);
      const bool isExact = (squaredDistance < kFarthest * kFarthest) & (squaredLength > kShortest) &
        (squaredLength < kLongest);
      square[lane] = isExact ? static_cast<float>(px * px + py * py + pz * pz) : -__builtin_inff();
    }
  }

  /// Of kCount rays, from the lane `from` on.
  template <class Lanes>
  std::uint32_t findNear(unsigned from, unsigned isThere, std::uint32_t first,
    const BodyBalls& balls, NearRays* found) const
  {
    using Floats = typename Lanes::Floats;
    const Floats px = Lanes::load(point[0] + from), py = Lanes::load(point[1] + from),
                 pz = Lanes::load(point[2] + from), dx = Lanes::load(direction[0] + from),
                 dy = Lanes::load(direction[1] + from), dz = Lanes::load(direction[2] + from),
                 squares = Lanes::load(square + from);
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
        x, px, Lanes::mulAdd(y, py, Lanes::mulAdd(z, pz, squares + Lanes::all(ball.power))));
      const unsigned near =
        isThere & ~Lanes::bits(Lanes::isLess(along * along, gap)); // NaN is near
      // Few are near, and it cannot be foreseen which: there is no branch.
      found[count] = { first, static_cast<std::uint16_t>(body), static_cast<std::uint16_t>(near) };
      count += near != 0 ? 1 : 0;
    }
    return count;
  }
};

template <class Lanes, class Real>
inline std::uint32_t findNearAll(
  const TreeRays& rays, const Real* const (&directions)[3], const BodyBalls& balls, NearRays* found)
{
  BallLanes lanes;
  std::uint32_t count = 0;
  for (std::uint32_t first = 0; first < rays.count; first += BallLanes::kSize)
  {
    lanes.place(balls.frame(), rays, directions, first);
    for (unsigned from = 0; from < BallLanes::kSize && first + from < rays.count;
         from += Lanes::kCount)
    {
      const std::uint32_t left = std::min(rays.count - first - from, Lanes::kCount + 0u);
      count += lanes.findNear<Lanes>(from, (1u << left) - 1, first + from, balls, found + count);
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

template <class Real>
inline void prepareAll(
  const TreeRays& rays, const Real* const (&directions)[3], FrontSearches& searches)
{
  PrepareLanes<Real> lanes;
  searches.count = 0;
  searches.otherCount = 0;
  for (std::uint32_t first = 0; first < rays.count; first += TreeRays::kLanes)
  {
    prepareSome<Real>(lanes, searches.tree, rays, directions, first);
    lanes.write(rays, first, searches);
  }
}

inline void prepareRays(const TreeRays& rays, FrontSearches& searches)
{
  rays.direction[0] ? prepareAll<float>(rays, rays.direction, searches)
                    : prepareAll<double>(rays, rays.exactDirection, searches);
}

__attribute__((noinline)) void intersectSome(IntersectionLanes& lanes)
{
  lanes.intersect();
}

template <class Real>
inline void setRays(IntersectionLanes& lanes, const TreeRays& rays, std::uint32_t first,
  const Real* const (&directions)[3])
{
  const double *ox = rays.origin[0] + first, *oy = rays.origin[1] + first,
               *oz = rays.origin[2] + first;
  const Real *dx = directions[0] + first, *dy = directions[1] + first, *dz = directions[2] + first;
  for (unsigned lane = 0; lane < IntersectionLanes::kSize; ++lane)
  {
    lanes.origin.x[lane] = ox[lane];
    lanes.origin.y[lane] = oy[lane];
    lanes.origin.z[lane] = oz[lane];
    lanes.direction.x[lane] = static_cast<double>(dx[lane]);
    lanes.direction.y[lane] = static_cast<double>(dy[lane]);
    lanes.direction.z[lane] = static_cast<double>(dz[lane]);
  }
}

/// Rays without a candidate are given the first triangle.
inline void setTriangles(
  IntersectionLanes& lanes, const std::uint32_t* candidate, const CornerRows& corners)
{
  IntersectionLanes::Points &a = lanes.a, &b = lanes.b, &c = lanes.c;
  for (unsigned group = 0; group < IntersectionLanes::kSize; group += 4)
  {
    const double* rows[4];
    for (unsigned lane = 0; lane < 4; ++lane)
    {
      const std::uint32_t some = candidate[group + lane];
      rows[lane] = corners.of(some == TreeRays::kNone ? 0 : some);
      c.z[group + lane] = rows[lane][8];
    }
    transpose4<double>({ rows[0], rows[1], rows[2], rows[3] },
      { a.x + group, a.y + group, a.z + group, b.x + group });
    transpose4<double>({ rows[0] + 4, rows[1] + 4, rows[2] + 4, rows[3] + 4 },
      { b.y + group, b.z + group, c.x + group, c.y + group });
  }
}

/// Keeps the hits that are closer than what the columns hold.
__attribute__((noinline)) void keepSome(const IntersectionLanes& lanes, const TreeRays& rays,
  std::uint32_t first, const std::uint32_t* candidate)
{
  double* const distances = rays.distance + first;
  std::uint32_t* const hits = rays.hit + first;
  float *const weightsB = rays.weight[0] + first, *const weightsC = rays.weight[1] + first;
  const std::uint32_t firstNumber = rays.first;
  // The columns do not overlap.
#pragma GCC ivdep
  for (unsigned lane = 0; lane < IntersectionLanes::kSize; ++lane)
  {
    const double distance = lanes.distance[lane], oldDistance = distances[lane];
    const std::uint32_t some = candidate[lane], number = firstNumber + some, oldHit = hits[lane];
    const float weightB = static_cast<float>(lanes.weightB[lane]),
                weightC = static_cast<float>(lanes.weightC[lane]);
    const float oldB = weightsB[lane], oldC = weightsC[lane];
    // The distance is NaN where the ray misses.
    const bool isCloser = (some != TreeRays::kNone) & (distance > 0) &
      ((distance < oldDistance) | ((distance == oldDistance) & (number < oldHit)));
    distances[lane] = isCloser ? distance : oldDistance;
    hits[lane] = isCloser ? number : oldHit;
    weightsB[lane] = isCloser ? weightB : oldB;
    weightsC[lane] = isCloser ? weightC : oldC;
  }
}

/// Tests eight rays, next to each other in their columns, with a triangle each.
template <class Real>
inline void confirmAll(const TreeRays& rays, const Real* const (&directions)[3],
  const std::uint32_t* candidate, const CornerRows& corners)
{
  constexpr unsigned kSize = IntersectionLanes::kSize;
  static_assert(TreeRays::kLanes % kSize == 0, "columns have room for the last ones");
  constexpr std::uint32_t kAhead = 2 * kSize;
  IntersectionLanes lanes;
  for (std::uint32_t first = 0; first < rays.count; first += kSize)
  {
    for (unsigned lane = 0; first + kAhead < rays.count && lane < kSize; ++lane)
    {
      const std::uint32_t ahead = candidate[first + kAhead + lane];
      corners.prefetch(ahead == TreeRays::kNone ? 0 : ahead);
    }
    setRays(lanes, rays, first, directions);
    setTriangles(lanes, candidate + first, corners);
    intersectSome(lanes);
    keepSome(lanes, rays, first, candidate + first);
  }
}

inline void confirmRays(
  const TreeRays& rays, const std::uint32_t* candidate, const CornerRows& corners)
{
  rays.direction[0] ? confirmAll<float>(rays, rays.direction, candidate, corners)
                    : confirmAll<double>(rays, rays.exactDirection, candidate, corners);
}

template <class Boxes, class Lanes>
constexpr FrontStages kStages = { pickRays, findNearRays<Boxes>, prepareRays,
  runSearches<Boxes, Lanes>, confirmRays, intersectSome };

}
}
