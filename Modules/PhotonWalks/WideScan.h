// No include guard: included once by each of the files that scan, between the marks of its target.

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

/// The segments from the first Lanes::kCount points that may touch the body, a bit for each. With p
/// and p + q the ends, a the squared length and t the place nearest to 0, the distance from 0 is
/// below r if t (t a + 2 p.q) + p.p < r^2; here times a, so that nothing is divided.
template <class Lanes>
inline unsigned nameNear(const float* xs, const float* ys, const float* zs, const ScanBody& body)
{
  using Floats = typename Lanes::Floats;
  const Floats zero = Lanes::all(0);
  const Floats x = Lanes::load(xs), y = Lanes::load(ys), z = Lanes::load(zs);
  const Floats dx = Lanes::load(xs + 1) - x, dy = Lanes::load(ys + 1) - y,
               dz = Lanes::load(zs + 1) - z;
  Floats p[3], q[3];
  for (int row = 0; row < 3; ++row)
  {
    const Floats a = Lanes::all(body.matrix[row]), b = Lanes::all(body.matrix[row + 3]),
                 c = Lanes::all(body.matrix[row + 6]);
    p[row] = dot<Lanes>(a, b, c, x, y, z, Lanes::all(body.offset[row]));
    q[row] = dot<Lanes>(a, b, c, dx, dy, dz, zero);
  }
  const Floats length = dot<Lanes>(q[0], q[1], q[2], q[0], q[1], q[2], zero);
  const Floats along = dot<Lanes>(p[0], p[1], p[2], q[0], q[1], q[2], zero);
  const Floats outside =
    dot<Lanes>(p[0], p[1], p[2], p[0], p[1], p[2], Lanes::all(-body.squaredRadius));
  const Floats nearest = Lanes::least(Lanes::most(along, -length), zero);
  const Floats gap =
    Lanes::mulAdd(nearest, Lanes::mulAdd(Lanes::all(-2), along, nearest), length * outside);
  return Lanes::notAboveZero(gap);
}

/// Those of the first kTogether points.
template <class Lanes>
inline unsigned nameTogether(const float* x, const float* y, const float* z, const ScanBody& body)
{
  unsigned named = 0;
  for (std::size_t i = 0; i < PointScan::kTogether; i += Lanes::kCount)
  {
    named |= nameNear<Lanes>(x + i, y + i, z + i, body) << i;
  }
  return named;
}

template <class Lanes>
inline unsigned nameTagged(const std::uint16_t* tags, std::uint32_t set)
{
  unsigned named = 0;
  for (std::size_t i = 0; i < PointScan::kTogether; i += Lanes::kCount)
  {
    named |= Lanes::tagged(tags + i, set) << i;
  }
  return named;
}

/// The points after the last that are looked at together, with room behind them.
struct LastPoints
{
  float x[PointScan::kTogether + 1] = {}, y[PointScan::kTogether + 1] = {},
                                 z[PointScan::kTogether + 1] = {};
  std::uint16_t tags[PointScan::kTogether + 1] = {};

  LastPoints(const ScanPoints& all, std::size_t first)
  {
    std::copy(all.x + first, all.x + all.count, x);
    std::copy(all.y + first, all.y + all.count, y);
    std::copy(all.z + first, all.z + all.count, z);
    std::copy(all.tags + first, all.tags + all.count, tags);
  }
};

/// Pools are short and lie anywhere, so the machine does not foresee where the scan goes on: each
/// step asks for a line of each array. What is asked for in one go, or so early that a branch on
/// what is found comes between, arrives too late.
inline void fetchAhead(const PointScan& scan, std::size_t first)
{
  constexpr std::size_t kAhead = 1024;
  const std::size_t ahead = first + kAhead;
  const bool isHere = ahead < scan.points.count;
  const ScanPoints& soon = isHere ? scan.points : scan.next;
  const std::size_t i = isHere ? ahead : std::min(ahead - scan.points.count, soon.count);
  prefetch(soon.x + i);
  prefetch(soon.y + i);
  prefetch(soon.z + i);
  prefetch(soon.tags + i);
}

template <class Lanes>
inline void scanForTags(const PointScan& scan, std::size_t steps)
{
  for (std::size_t i = 0; i < steps; ++i)
  {
    scan.named[i] = static_cast<std::uint16_t>(
      nameTagged<Lanes>(scan.points.tags + i * PointScan::kTogether, scan.tags));
  }
}

/// The first body's scan asks the memory for what comes, and looks at the tags as well.
template <class Lanes, bool isFirst>
inline void scanFor(const ScanBody& body, const PointScan& scan, std::size_t steps)
{
  const ScanBody own = body; // can stay in registers
  for (std::size_t i = 0; i < steps; ++i)
  {
    const std::size_t first = i * PointScan::kTogether;
    const ScanPoints& all = scan.points;
    unsigned named = scan.named[i];
    if (isFirst)
    {
      fetchAhead(scan, first);
      named = nameTagged<Lanes>(all.tags + first, scan.tags);
    }
    named |= nameTogether<Lanes>(all.x + first, all.y + first, all.z + first, own);
    scan.named[i] = static_cast<std::uint16_t>(named);
  }
}

template <class Lanes>
inline void runScan(const PointScan& scan)
{
  const std::size_t segments = scan.points.count - 1, steps = segments / PointScan::kTogether;
  if (scan.numberOfBodies == 0)
  {
    scanForTags<Lanes>(scan, steps);
  }
  for (std::size_t i = 0; i < scan.numberOfBodies; ++i)
  {
    i == 0 ? scanFor<Lanes, true>(scan.bodies[i], scan, steps)
           : scanFor<Lanes, false>(scan.bodies[i], scan, steps);
  }
  const LastPoints last(scan.points, steps * PointScan::kTogether);
  unsigned named = nameTagged<Lanes>(last.tags, scan.tags);
  for (std::size_t i = 0; i < scan.numberOfBodies; ++i)
  {
    named |= nameTogether<Lanes>(last.x, last.y, last.z, scan.bodies[i]);
  }
  const unsigned isThere = (1u << (segments - steps * PointScan::kTogether)) - 1;
  scan.named[steps] = static_cast<std::uint16_t>(named & isThere);
}

}
}
