// No include guard: each kernel of the scan includes this once, after its GridLanes and
// GridSegments.inl, between the marks of its target. Products and sums are rounded one by one, so
// that all kernels flag the same segments.

namespace irradiance
{
namespace
{

using Lanes = GridLanes;
using Floats = Lanes::Floats;

/// Three numbers a lane.
struct Triple
{
  Floats x, y, z;

  /// The same numbers for each lane.
  static Triple all(const float* numbers)
  {
    return { Lanes::all(numbers[0]), Lanes::all(numbers[1]), Lanes::all(numbers[2]) };
  }
  /// From columns.
  static Triple load(const std::int16_t (*columns)[BouncePage::kSize], std::size_t place)
  {
    return { Lanes::load(columns[0] + place), Lanes::load(columns[1] + place),
      Lanes::load(columns[2] + place) };
  }
};

inline Floats dot(const Triple& a, const Triple& b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline Triple operator+(const Triple& a, const Triple& b)
{
  return { a.x + b.x, a.y + b.y, a.z + b.z };
}

inline Triple operator-(const Triple& a, const Triple& b)
{
  return { a.x - b.x, a.y - b.y, a.z - b.z };
}

/// Number by number.
inline Triple operator*(const Triple& a, const Triple& b)
{
  return { a.x * b.x, a.y * b.y, a.z * b.z };
}

inline Triple times(Floats factor, const Triple& a)
{
  return { factor * a.x, factor * a.y, factor * a.z };
}

inline Triple absolute(const Triple& a)
{
  return { Lanes::absolute(a.x), Lanes::absolute(a.y), Lanes::absolute(a.z) };
}

/// A matrix, column by column, times a vector.
inline Triple product(const float* matrix, const Triple& a)
{
  const auto row = [&](int i) {
    return dot({ Lanes::all(matrix[i]), Lanes::all(matrix[i + 3]), Lanes::all(matrix[i + 6]) }, a);
  };
  return { row(0), row(1), row(2) };
}

/// Segments, one to a lane. Both are whole numbers, hence exact.
struct GridEnds
{
  Triple begin;
  Triple along; ///< from the other end to there

  GridEnds(const BouncePage& page, std::size_t place)
    : begin(Triple::load(page.ends, place))
    , along(begin - Triple::load(page.ends + 3, place))
  {
  }
};

/// Segments on a grid that is stretched to equal steps along all axes, each of at most 1.
struct StretchedEnds
{
  Triple begin, along;
  Floats perSquare; ///< 1 / their squared lengths

  StretchedEnds(const GridEnds& ends, const float* stretch)
    : begin(ends.begin * Triple::all(stretch))
    , along(ends.along * Triple::all(stretch))
    , perSquare(Lanes::all(1) / dot(along, along))
  {
  }

  /// Those that may come within a ball, a bit for each.
  unsigned near(const GridBall& ball) const
  {
    const Triple p = begin - Triple::all(ball.center);
    const Floats place = dot(p, along) * perSquare;
    const Floats t =
      Lanes::least(Lanes::most(place, Lanes::all(0)), Lanes::all(1)); // NaN becomes 0
    const Triple nearest = p - times(t, along);
    return Lanes::notAbove(dot(nearest, nearest), Lanes::all(ball.squaredRadius));
  }
};

/// Flags the segments that may come within the body's ball, a bit for each. With p and p - q the
/// ends in the body's frame, p - t q is nearest to its middle for t = p.q / q.q.
inline unsigned flagNearBall(const GridEnds& ends, const GridBody& body)
{
  const Triple p = product(body.matrix, ends.begin) + Triple::all(body.offset),
               q = product(body.matrix, ends.along);
  // A segment of length 0 gives NaN, which becomes 0.
  const Floats t = Lanes::least(Lanes::most(dot(p, q) / dot(q, q), Lanes::all(0)), Lanes::all(1));
  const Triple nearest = p - times(t, q);
  return Lanes::notAbove(dot(nearest, nearest), Lanes::all(body.squaredRadius));
}

/// Likewise for the body's cube. A segment and a cube have no common point if there is a plane
/// between them that is a face of the cube, or is parallel to the segment and an edge of the cube.
inline unsigned flagNearBox(const GridEnds& ends, const GridBody& body)
{
  const Triple p = product(body.boxMatrix, ends.begin) + Triple::all(body.boxOffset),
               q = product(body.boxMatrix, ends.along);
  // Twice the middle, and twice half the length, along each axis.
  const Triple middle = times(Lanes::all(2), p) - q, size = absolute(q);
  const Triple lengths = absolute(ends.along);
  const Floats length = lengths.x + lengths.y + lengths.z;
  const auto isInSlab = [&](Floats place, Floats extent, int axis) {
    return Lanes::notAbove(Lanes::absolute(place), extent + Lanes::all(body.face[axis]));
  };
  const auto isInWedge = [&](Floats middleA, Floats middleB, Floats qA, Floats qB, Floats sizeA,
                           Floats sizeB, int axis) {
    const Floats off = middleA * qB - middleB * qA, sizes = sizeA + sizeB;
    return Lanes::notAbove(
      Lanes::absolute(off), sizes + sizes + length * Lanes::all(body.slack[axis]));
  };
  return isInSlab(middle.x, size.x, 0) & isInSlab(middle.y, size.y, 1) &
    isInSlab(middle.z, size.z, 2) & isInWedge(middle.y, middle.z, q.y, q.z, size.y, size.z, 0) &
    isInWedge(middle.z, middle.x, q.z, q.x, size.z, size.x, 1) &
    isInWedge(middle.x, middle.y, q.x, q.y, size.x, size.y, 2);
}

inline unsigned flagNear(const GridEnds& ends, const GridBody& body)
{
  const unsigned near = flagNearBall(ends, body);
  return near != 0 && body.hasBox ? near & flagNearBox(ends, body) : near;
}

/// Likewise for some of these segments, each near the lines of a ball: after these balls.
inline unsigned flagNearListed(
  const GridEnds& ends, const PageScan& scan, const NearBody* near, std::uint32_t count)
{
  const StretchedEnds stretched(ends, scan.stretch);
  unsigned flagged = 0;
  for (std::uint32_t k = 0; k < count; ++k)
  {
    const unsigned lanes = near[k].lanes & stretched.near(scan.balls[near[k].body]);
    flagged |= lanes != 0 ? lanes & flagNear(ends, scan.bodies[near[k].body]) : 0;
  }
  return flagged;
}

/// Likewise for any of the bodies, after their balls.
inline unsigned flagNearAny(const GridEnds& ends, const PageScan& scan)
{
  const StretchedEnds stretched(ends, scan.stretch);
  NearBody* const near = scan.near;
  std::uint32_t numberNear = 0;
  for (std::uint32_t body = 0; body < scan.numberOfBodies; ++body)
  {
    // Few are near, and it cannot be foreseen which: there is no branch.
    const unsigned lanes = stretched.near(scan.balls[body]);
    near[numberNear] = { body, lanes };
    numberNear += lanes != 0 ? 1 : 0;
  }
  unsigned flagged = 0;
  for (std::uint32_t k = 0; k < numberNear; ++k)
  {
    flagged |= flagNear(ends, scan.bodies[near[k].body]) & near[k].lanes;
  }
  return flagged;
}

/// Flags which of kGroupSize segments come near a body, from `place` of a page on. Without their
/// balls, which would cost registers, for few large bodies.
template <bool kAfterBalls>
inline unsigned flagGroup(const BouncePage& page, std::size_t place, const PageScan& scan)
{
  unsigned flagged = 0;
  for (std::size_t i = 0; i < PageScan::kGroupSize && scan.numberOfBodies > 0; i += Lanes::kFloats)
  {
    const GridEnds ends(page, place + i); // stays in registers
    if constexpr (kAfterBalls)
    {
      flagged |= flagNearAny(ends, scan) << i;
      continue;
    }
    unsigned near = 0;
    for (std::uint32_t body = 0; body < scan.numberOfBodies; ++body)
    {
      near |= flagNear(ends, scan.bodies[body]);
    }
    flagged |= near << i;
  }
  return flagged;
}

/// Pages are scattered, so the hardware does not foresee where the scan continues: each group
/// requests its share of the next page.
inline void prefetchShare(const BouncePage* page, std::size_t group)
{
  constexpr std::size_t kShare = BouncePage::kScanned / PageScan::kGroups, kLine = 64;
  const char* const first = reinterpret_cast<const char*>(page) + group * kShare;
  for (std::size_t line = 0; line < kShare; line += kLine)
  {
    prefetchLine(first + line);
  }
}

/**
 * The lines of the segments of a page, in whole numbers of 16 bits, of which vectors hold twice as
 * many as of floats: u, along a line, of length 2^15, and b x u, in units of GridBall::kLineUnit,
 * with b where the segment begins. So |b x u - c x u| is how far the line passes from c.
 * Documentation/Theory.md derives what pays for rounding.
 */
struct SegmentLines
{
  alignas(64) std::int16_t along[3][BouncePage::kSize];
  alignas(64) std::int16_t moment[3][BouncePage::kSize];
};

/// A function of its own: within others, GCC 12 makes no SIMD of it.
__attribute__((noinline)) void findLines(
  const BouncePage& page, const float* stretch, SegmentLines& lines)
{
  constexpr float kOne = 32768, kMost = 32767, kPerUnit = 1 / GridBall::kLineUnit;
  constexpr float kShortest = 0x1p-20F; // squared; only a segment without length is shorter
  const float stretchX = stretch[0], stretchY = stretch[1], stretchZ = stretch[2];
  for (std::size_t i = 0; i < BouncePage::kSize; ++i)
  {
    const float bx = stretchX * page.ends[0][i], by = stretchY * page.ends[1][i],
                bz = stretchZ * page.ends[2][i];
    const float x = bx - stretchX * page.ends[3][i], y = by - stretchY * page.ends[4][i],
                z = bz - stretchZ * page.ends[5][i];
    const float square = x * x + y * y + z * z;
    const float perLength = 1 / __builtin_sqrtf(square > kShortest ? square : kShortest);
    const float ux = x * perLength, uy = y * perLength, uz = z * perLength;
    const auto whole = [](float value) {
      return static_cast<std::int16_t>(static_cast<std::int32_t>(value < kMost ? value : kMost));
    };
    lines.along[0][i] = whole(kOne * ux);
    lines.along[1][i] = whole(kOne * uy);
    lines.along[2][i] = whole(kOne * uz);
    lines.moment[0][i] = whole(kPerUnit * (by * uz - bz * uy));
    lines.moment[1][i] = whole(kPerUnit * (bz * ux - bx * uz));
    lines.moment[2][i] = whole(kPerUnit * (bx * uy - by * ux));
  }
}

/// Lists which lines may pass through which balls, from `place` on; apart for each of kParts parts
/// of these lines, with as much room as there are bodies.
template <std::size_t kParts>
inline void listNearLines(const SegmentLines& lines, std::size_t place, const PageScan& scan,
  std::uint32_t (&counts)[kParts])
{
  constexpr std::size_t kLines = Lanes::kShorts / kParts;
  constexpr unsigned kAll = (1u << kLines) - 1;
  const auto ux = Lanes::loadShorts(lines.along[0] + place),
             uy = Lanes::loadShorts(lines.along[1] + place),
             uz = Lanes::loadShorts(lines.along[2] + place),
             mx = Lanes::loadShorts(lines.moment[0] + place),
             my = Lanes::loadShorts(lines.moment[1] + place),
             mz = Lanes::loadShorts(lines.moment[2] + place);
  for (std::uint32_t body = 0; body < scan.numberOfBodies; ++body)
  {
    const GridBall& ball = scan.balls[body];
    const auto x = Lanes::allShorts(ball.lineCenter[0]), y = Lanes::allShorts(ball.lineCenter[1]),
               z = Lanes::allShorts(ball.lineCenter[2]);
    const auto off = [](auto moment, auto a, auto ub, auto b, auto ua) {
      return Lanes::absolute(
        Lanes::add(Lanes::subtract(moment, Lanes::multiply(a, ub)), Lanes::multiply(b, ua)));
    };
    const auto farthest =
      Lanes::most(Lanes::most(off(mx, y, uz, z, uy), off(my, z, ux, x, uz)), off(mz, x, uy, y, ux));
    // Few are near, and it cannot be foreseen which: there is no branch.
    const unsigned passing = Lanes::notAbove(farthest, Lanes::allShorts(ball.lineRadius));
    for (std::size_t part = 0; part < kParts; ++part)
    {
      const unsigned some = passing >> part * kLines & kAll;
      scan.near[part * scan.numberOfBodies + counts[part]] = { body, some };
      counts[part] += some != 0 ? 1 : 0;
    }
  }
}

/// Likewise all of a page, after the balls of the bodies, and before these by lines. `flagged`: 0
/// at first.
inline void flagAfterLines(
  const BouncePage& page, const BouncePage* next, const PageScan& scan, std::uint16_t* flagged)
{
  constexpr std::size_t kSize = PageScan::kGroupSize, kLines = Lanes::kShorts,
                        kParts = kLines / Lanes::kFloats;
  static_assert(kParts <= PageScan::kMostParts);
  SegmentLines lines;
  findLines(page, scan.stretch, lines);
  for (std::size_t place = 0; place < BouncePage::kSize; place += kLines)
  {
    for (std::size_t group = place / kSize; next != nullptr && group * kSize < place + kLines;
         ++group)
    {
      prefetchShare(next, group);
    }
    std::uint32_t counts[kParts]{};
    listNearLines(lines, place, scan, counts);
    for (std::size_t part = 0; part < kParts; ++part)
    {
      if (counts[part] > 0)
      {
        const std::size_t at = place + part * Lanes::kFloats;
        const unsigned near =
          flagNearListed({ page, at }, scan, scan.near + part * scan.numberOfBodies, counts[part]);
        flagged[at / kSize] = static_cast<std::uint16_t>(flagged[at / kSize] | near << at % kSize);
      }
    }
  }
}

template <bool kAfterBalls, bool kAfterLines>
inline void scanAll(const PageScan& scan)
{
  for (std::size_t i = 0; i < scan.numberOfPages; ++i)
  {
    const BouncePage& page = *scan.pages[i];
    const BouncePage* const next = i + 1 < scan.numberOfPages ? scan.pages[i + 1] : scan.next;
    std::uint16_t* const flagged = scan.flagged + i * PageScan::kGroups;
    if constexpr (kAfterLines)
    {
      std::fill_n(flagged, PageScan::kGroups, std::uint16_t{ 0 });
      flagAfterLines(page, next, scan, flagged);
    }
    for (std::size_t group = 0; group < PageScan::kGroups; ++group)
    {
      if (!kAfterLines && next != nullptr)
      {
        scan.numberOfBodies > 0 ? prefetchShare(next, group)
                                : prefetchLine(next->tags + group * PageScan::kGroupSize);
      }
      const std::size_t place = group * PageScan::kGroupSize;
      const unsigned near =
        kAfterLines ? flagged[group] : flagGroup<kAfterBalls>(page, place, scan);
      flagged[group] = static_cast<std::uint16_t>(
        (near | Lanes::tagged(page.tags + place, scan.tags)) & Lanes::stored(page.tags + place));
    }
  }
}

inline void scanPages(const PageScan& scan)
{
  constexpr std::uint32_t kFewestForLines = 8; // to find them takes as long as some balls
  !scan.areSmall                            ? scanAll<false, false>(scan)
    : scan.numberOfBodies < kFewestForLines ? scanAll<true, false>(scan)
                                            : scanAll<true, true>(scan);
}

constexpr BounceLoops kLoops{ scanPages, placeAllOnGrid };

}
}
