// SPDX-License-Identifier: BSD-3-Clause
// No include guard: each kernel of the scan includes this once, between the marks of its target.

namespace irradiance
{
namespace
{

template <class Lanes>
inline typename Lanes::Floats dot(typename Lanes::Floats ax, typename Lanes::Floats ay,
  typename Lanes::Floats az, typename Lanes::Floats bx, typename Lanes::Floats by,
  typename Lanes::Floats bz, typename Lanes::Floats c)
{
  return Lanes::mulAdd(ax, bx, Lanes::mulAdd(ay, by, Lanes::mulAdd(az, bz, c)));
}

/// Segments, one to a lane.
template <class Lanes>
struct Segments
{
  using Floats = typename Lanes::Floats;

  Floats x, y, z;    ///< where they begin
  Floats dx, dy, dz; ///< from the other end to there
  Floats distance;   ///< squared, from 0 to where they begin

  /// The segments between consecutive points.
  Segments(const float* xs, const float* ys, const float* zs)
    : x(Lanes::load(xs))
    , y(Lanes::load(ys))
    , z(Lanes::load(zs))
    , dx(x - Lanes::load(xs + 1))
    , dy(y - Lanes::load(ys + 1))
    , dz(z - Lanes::load(zs + 1))
    , distance(squaredLength(x, y, z))
  {
  }

  /// Makes each of the same segments begin at its end nearer to 0: the error bound grows with the
  /// distance of that end.
  void beginNear(const float* xs, const float* ys, const float* zs)
  {
    const Floats x1 = Lanes::load(xs + 1), y1 = Lanes::load(ys + 1), z1 = Lanes::load(zs + 1);
    const Floats other = squaredLength(x1, y1, z1), zero = Lanes::all(0);
    const auto isNearer = Lanes::isLess(other, distance);
    x = Lanes::choose(isNearer, x1, x);
    y = Lanes::choose(isNearer, y1, y);
    z = Lanes::choose(isNearer, z1, z);
    dx = Lanes::choose(isNearer, zero - dx, dx);
    dy = Lanes::choose(isNearer, zero - dy, dy);
    dz = Lanes::choose(isNearer, zero - dz, dz);
    distance = Lanes::least(other, distance);
  }

private:
  static Floats squaredLength(Floats a, Floats b, Floats c)
  {
    return dot<Lanes>(a, b, c, a, b, c, Lanes::all(0));
  }
};

/// Flags the segments that may touch the body, a bit for each. With p and p - q the ends in the
/// body's frame, p - t q is nearest to its centre for t = p.q / q.q.
template <class Lanes>
inline unsigned flagNear(const Segments<Lanes>& segments, const ScanBody& body)
{
  using Floats = typename Lanes::Floats;
  const Floats zero = Lanes::all(0);
  Floats p[3], q[3];
  for (int row = 0; row < 3; ++row)
  {
    const Floats a = Lanes::all(body.matrix[row]), b = Lanes::all(body.matrix[row + 3]),
                 c = Lanes::all(body.matrix[row + 6]);
    p[row] = dot<Lanes>(a, b, c, segments.x, segments.y, segments.z, Lanes::all(body.offset[row]));
    q[row] = dot<Lanes>(a, b, c, segments.dx, segments.dy, segments.dz, zero);
  }
  const Floats length = dot<Lanes>(q[0], q[1], q[2], q[0], q[1], q[2], zero);
  const Floats along = dot<Lanes>(p[0], p[1], p[2], q[0], q[1], q[2], zero);
  // A segment of length 0 gives NaN, which becomes 0.
  const Floats t = Lanes::least(Lanes::most(along / length, zero), Lanes::all(1));
  for (int row = 0; row < 3; ++row)
  {
    p[row] = Lanes::subtractMul(p[row], t, q[row]);
  }
  const Floats reach =
    Lanes::mulAdd(segments.distance, Lanes::all(body.byDistance), Lanes::all(body.squaredRadius));
  return Lanes::notAbove(dot<Lanes>(p[0], p[1], p[2], p[0], p[1], p[2], zero), reach);
}

/// Flags which of the first kGroupSize segments may touch any of the bodies.
template <class Lanes>
inline unsigned flagGroup(const float* x, const float* y, const float* z, const PointScan& scan)
{
  unsigned flagged = 0;
  for (std::size_t i = 0; i < PointScan::kGroupSize; i += Lanes::kCount)
  {
    Segments<Lanes> segments(x + i, y + i, z + i);
    constexpr unsigned kAll = (1u << Lanes::kCount) - 1;
    if (Lanes::notAbove(segments.distance, Lanes::all(scan.squaredNear)) != kAll)
    {
      segments.beginNear(x + i, y + i, z + i);
    }
    unsigned near = 0;
    for (std::size_t body = 0; body < scan.numberOfBodies; ++body)
    {
      near |= flagNear<Lanes>(segments, scan.bodies[body]);
    }
    flagged |= near << i;
  }
  return flagged;
}

template <class Lanes>
inline unsigned flagTagged(const std::uint16_t* tags, std::uint32_t set)
{
  unsigned flagged = 0;
  for (std::size_t i = 0; i < PointScan::kGroupSize; i += Lanes::kCount)
  {
    flagged |= Lanes::tagged(tags + i, set) << i;
  }
  return flagged;
}

/// The points left after the last full group of kGroupSize, filled up with zeros.
struct LastPoints
{
  float x[PointScan::kGroupSize + 1] = {}, y[PointScan::kGroupSize + 1] = {},
                                  z[PointScan::kGroupSize + 1] = {};
  std::uint16_t tags[PointScan::kGroupSize + 1] = {};

  LastPoints(const ScanPoints& all, std::size_t first)
  {
    std::copy(all.x + first, all.x + all.count, x);
    std::copy(all.y + first, all.y + all.count, y);
    std::copy(all.z + first, all.z + all.count, z);
    std::copy(all.tags + first, all.tags + all.count, tags);
  }
};

/// Pools are short and scattered, so the hardware does not foresee where the scan continues. Each
/// step prefetches a line of each array. Lines that are requested all at once, or so early that a
/// branch on what is found comes between, arrive too late.
inline void prefetchAhead(const PointScan& scan, std::size_t first)
{
  constexpr std::size_t kAhead = 1024;
  const std::size_t ahead = first + kAhead;
  const bool isHere = ahead < scan.points.count;
  const ScanPoints& soon = isHere ? scan.points : scan.next;
  const std::size_t i = isHere ? ahead : std::min(ahead - scan.points.count, soon.count);
  prefetchLine(soon.x + i);
  prefetchLine(soon.y + i);
  prefetchLine(soon.z + i);
  prefetchLine(soon.tags + i);
}

template <class Lanes>
inline void runScan(const PointScan& scan)
{
  const ScanPoints& all = scan.points;
  const std::size_t segments = all.count - 1, steps = segments / PointScan::kGroupSize;
  for (std::size_t i = 0; i < steps; ++i)
  {
    const std::size_t first = i * PointScan::kGroupSize;
    prefetchAhead(scan, first);
    scan.flagged[i] = static_cast<std::uint16_t>(flagTagged<Lanes>(all.tags + first, scan.tags) |
      flagGroup<Lanes>(all.x + first, all.y + first, all.z + first, scan));
  }
  const LastPoints last(all, steps * PointScan::kGroupSize);
  const unsigned isThere = (1u << (segments - steps * PointScan::kGroupSize)) - 1;
  scan.flagged[steps] = static_cast<std::uint16_t>(isThere &
    (flagTagged<Lanes>(last.tags, scan.tags) | flagGroup<Lanes>(last.x, last.y, last.z, scan)));
}

}
}
