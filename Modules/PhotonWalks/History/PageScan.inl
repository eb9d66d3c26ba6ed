// SPDX-License-Identifier: BSD-3-Clause
// No include guard: each kernel of the scan includes this once, between the marks of its target.
// Products and sums are rounded one by one, so that all kernels flag the same segments.

#include "History/SegmentLines.inl"

namespace irradiance
{
namespace
{

/// Three numbers a lane.
template <class Lanes>
struct Triple
{
  typename Lanes::Floats x, y, z;
};

template <class Lanes>
inline typename Lanes::Floats dot(const Triple<Lanes>& a, const Triple<Lanes>& b)
{
  return Lanes::add(
    Lanes::add(Lanes::multiply(a.x, b.x), Lanes::multiply(a.y, b.y)), Lanes::multiply(a.z, b.z));
}

template <class Lanes>
inline Triple<Lanes> minus(const Triple<Lanes>& a, const Triple<Lanes>& b)
{
  return { Lanes::subtract(a.x, b.x), Lanes::subtract(a.y, b.y), Lanes::subtract(a.z, b.z) };
}

template <class Lanes>
inline Triple<Lanes> times(typename Lanes::Floats factor, const Triple<Lanes>& a)
{
  return { Lanes::multiply(factor, a.x), Lanes::multiply(factor, a.y),
    Lanes::multiply(factor, a.z) };
}

template <class Lanes>
inline Triple<Lanes> absolute(const Triple<Lanes>& a)
{
  return { Lanes::absolute(a.x), Lanes::absolute(a.y), Lanes::absolute(a.z) };
}

/// A matrix, column by column, times a vector.
template <class Lanes>
inline Triple<Lanes> product(const float* matrix, const Triple<Lanes>& a)
{
  const auto row = [&](int i) {
    return dot<Lanes>(
      { Lanes::all(matrix[i]), Lanes::all(matrix[i + 3]), Lanes::all(matrix[i + 6]) }, a);
  };
  return { row(0), row(1), row(2) };
}

template <class Lanes>
inline Triple<Lanes> plus(const Triple<Lanes>& a, const float* b)
{
  return { Lanes::add(a.x, Lanes::all(b[0])), Lanes::add(a.y, Lanes::all(b[1])),
    Lanes::add(a.z, Lanes::all(b[2])) };
}

/// Segments, one to a lane. Both are whole numbers, hence exact.
template <class Lanes>
struct GridEnds
{
  Triple<Lanes> begin;
  Triple<Lanes> along; ///< from the other end to there

  /// From columns, those of the other ends after those where segments begin.
  template <class Columns>
  GridEnds(const Columns& ends, std::size_t place)
    : begin{ Lanes::load(ends[0] + place), Lanes::load(ends[1] + place),
      Lanes::load(ends[2] + place) }
    , along(minus<Lanes>(begin,
        { Lanes::load(ends[3] + place), Lanes::load(ends[4] + place),
          Lanes::load(ends[5] + place) }))
  {
  }
};

/// Segments on a grid that is stretched to equal steps along all axes, each of at most 1.
template <class Lanes>
struct StretchedEnds
{
  Triple<Lanes> begin, along;
  typename Lanes::Floats perSquare; ///< 1 / their squared lengths

  StretchedEnds(const GridEnds<Lanes>& ends, const float* stretch)
    : begin(stretched(ends.begin, stretch))
    , along(stretched(ends.along, stretch))
    , perSquare(Lanes::divide(Lanes::all(1), dot<Lanes>(along, along)))
  {
  }

  static Triple<Lanes> stretched(const Triple<Lanes>& a, const float* stretch)
  {
    return { Lanes::multiply(a.x, Lanes::all(stretch[0])),
      Lanes::multiply(a.y, Lanes::all(stretch[1])), Lanes::multiply(a.z, Lanes::all(stretch[2])) };
  }
};

/// Squared, from the middle of a ball there.
template <class Lanes>
inline typename Lanes::Floats squaredDistance(
  const StretchedEnds<Lanes>& ends, const GridBall& ball)
{
  const Triple<Lanes> p = minus<Lanes>(ends.begin,
    { Lanes::all(ball.center[0]), Lanes::all(ball.center[1]), Lanes::all(ball.center[2]) });
  const auto place = Lanes::multiply(dot<Lanes>(p, ends.along), ends.perSquare);
  const auto t = Lanes::least(Lanes::most(place, Lanes::all(0)), Lanes::all(1)); // NaN becomes 0
  const Triple<Lanes> nearest = minus<Lanes>(p, times<Lanes>(t, ends.along));
  return dot<Lanes>(nearest, nearest);
}

/// Squared, from the middle of the body's ball to the nearest point of each segment. With p and p -
/// q the ends in the body's frame, p - t q is nearest for t = p.q / q.q.
template <class Lanes>
inline typename Lanes::Floats squaredDistance(const GridEnds<Lanes>& ends, const GridBody& body)
{
  const auto zero = Lanes::all(0);
  const Triple<Lanes> p = plus<Lanes>(product<Lanes>(body.matrix, ends.begin), body.offset),
                      q = product<Lanes>(body.matrix, ends.along);
  // A segment of length 0 gives NaN, which becomes 0.
  const auto t = Lanes::least(
    Lanes::most(Lanes::divide(dot<Lanes>(p, q), dot<Lanes>(q, q)), zero), Lanes::all(1));
  const Triple<Lanes> nearest = minus<Lanes>(p, times<Lanes>(t, q));
  return dot<Lanes>(nearest, nearest);
}

/// Flags the segments that may come within the body's ball, a bit for each.
template <class Lanes>
inline unsigned flagNearBall(const GridEnds<Lanes>& ends, const GridBody& body)
{
  return Lanes::notAbove(squaredDistance<Lanes>(ends, body), Lanes::all(body.squaredRadius));
}

/// Likewise for the body's cube. A segment and a cube have no common point if there is a plane
/// between them that is a face of the cube, or is parallel to the segment and an edge of the cube.
template <class Lanes>
inline unsigned flagNearBox(const GridEnds<Lanes>& ends, const GridBody& body)
{
  const Triple<Lanes> p = plus<Lanes>(product<Lanes>(body.boxMatrix, ends.begin), body.boxOffset),
                      q = product<Lanes>(body.boxMatrix, ends.along);
  // Twice the middle, and twice half the length, along each axis.
  const Triple<Lanes> middle = minus<Lanes>(times<Lanes>(Lanes::all(2), p), q),
                      size = absolute<Lanes>(q);
  const Triple<Lanes> lengths = absolute<Lanes>(ends.along);
  const auto length = Lanes::add(Lanes::add(lengths.x, lengths.y), lengths.z);
  const auto isInSlab = [&](auto place, auto extent, int axis) {
    return Lanes::notAbove(Lanes::absolute(place), Lanes::add(extent, Lanes::all(body.face[axis])));
  };
  const auto isInWedge = [&](auto middleA, auto middleB, auto qA, auto qB, auto sizeA, auto sizeB,
                           int axis) {
    const auto off = Lanes::subtract(Lanes::multiply(middleA, qB), Lanes::multiply(middleB, qA));
    const auto sizes = Lanes::add(sizeA, sizeB);
    return Lanes::notAbove(Lanes::absolute(off),
      Lanes::add(Lanes::add(sizes, sizes), Lanes::multiply(length, Lanes::all(body.slack[axis]))));
  };
  return isInSlab(middle.x, size.x, 0) & isInSlab(middle.y, size.y, 1) &
    isInSlab(middle.z, size.z, 2) & isInWedge(middle.y, middle.z, q.y, q.z, size.y, size.z, 0) &
    isInWedge(middle.z, middle.x, q.z, q.x, size.z, size.x, 1) &
    isInWedge(middle.x, middle.y, q.x, q.y, size.x, size.y, 2);
}

template <class Lanes>
inline unsigned flagNear(const GridEnds<Lanes>& ends, const GridBody& body)
{
  const unsigned near = flagNearBall<Lanes>(ends, body);
  return near != 0 && body.hasBox ? near & flagNearBox<Lanes>(ends, body) : near;
}

/// Likewise for some of these segments, each near the lines of a ball: after these balls.
template <class Lanes>
inline unsigned flagNearListed(
  const GridEnds<Lanes>& ends, const GridBodies& all, const NearBody* near, std::uint32_t count)
{
  const StretchedEnds<Lanes> stretched(ends, all.stretch);
  unsigned flagged = 0;
  for (std::uint32_t k = 0; k < count; ++k)
  {
    const GridBall& ball = all.balls[near[k].body];
    const unsigned lanes = near[k].lanes &
      Lanes::notAbove(squaredDistance<Lanes>(stretched, ball), Lanes::all(ball.squaredRadius));
    flagged |= lanes != 0 ? lanes & flagNear<Lanes>(ends, all.bodies[near[k].body]) : 0;
  }
  return flagged;
}

/// Likewise for any of the bodies, after their balls. `near`: room for all.
template <class Lanes>
inline unsigned flagNearAny(const GridEnds<Lanes>& ends, const GridBodies& all, NearBody* near)
{
  const StretchedEnds<Lanes> stretched(ends, all.stretch);
  std::uint32_t numberNear = 0;
  for (std::uint32_t body = 0; body < all.count; ++body)
  {
    // Few are near, and it cannot be foreseen which: there is no branch.
    const GridBall& ball = all.balls[body];
    const unsigned lanes =
      Lanes::notAbove(squaredDistance<Lanes>(stretched, ball), Lanes::all(ball.squaredRadius));
    near[numberNear] = { body, lanes };
    numberNear += lanes != 0 ? 1 : 0;
  }
  unsigned flagged = 0;
  for (std::uint32_t k = 0; k < numberNear; ++k)
  {
    flagged |= flagNear<Lanes>(ends, all.bodies[near[k].body]) & near[k].lanes;
  }
  return flagged;
}

/// How a scan tests bodies: few large ones at once, as their balls would cost registers; after
/// their balls; after lines.
enum class Tests
{
  Bodies,
  Balls,
  Lines
};

/// Flags which of kGroupSize segments come near a body, from `place` of a page on.
template <class Lanes, Tests kTests>
inline unsigned flagGroup(const BouncePage& page, std::size_t place, const PageScan& scan)
{
  const GridBodies& all = scan.bodies;
  unsigned flagged = 0;
  for (std::size_t i = 0; i < PageScan::kGroupSize && all.count > 0; i += Lanes::kCount)
  {
    const GridEnds<Lanes> ends(page.ends, place + i); // stays in registers
    if constexpr (kTests == Tests::Balls)
    {
      flagged |= flagNearAny<Lanes>(ends, all, scan.near) << i;
      continue;
    }
    unsigned near = 0;
    for (std::uint32_t body = 0; body < all.count; ++body)
    {
      near |= flagNear<Lanes>(ends, all.bodies[body]);
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

/// Likewise all of a page, after the balls of the bodies, and before these by lines. `flagged`: 0
/// at first.
template <class Lanes>
inline void flagAfterLines(
  const BouncePage& page, const BouncePage* next, const PageScan& scan, std::uint16_t* flagged)
{
  constexpr std::size_t kSize = PageScan::kGroupSize, kLines = Lanes::Shorts::kCount,
                        kParts = kLines / Lanes::kCount;
  static_assert(kParts <= PageScan::kMostParts);
  SegmentLines lines;
  findLines(page, scan.bodies.stretch, lines);
  for (std::size_t place = 0; place < BouncePage::kSize; place += kLines)
  {
    for (std::size_t group = place / kSize; next != nullptr && group * kSize < place + kLines;
         ++group)
    {
      prefetchShare(next, group);
    }
    std::uint32_t counts[kParts]{};
    listNearLines<typename Lanes::Shorts>(lines, place, scan.bodies, scan.near, counts);
    for (std::size_t part = 0; part < kParts; ++part)
    {
      if (counts[part] > 0)
      {
        const std::size_t at = place + part * Lanes::kCount;
        const unsigned near = flagNearListed<Lanes>(
          { page.ends, at }, scan.bodies, scan.near + part * scan.bodies.count, counts[part]);
        flagged[at / kSize] = static_cast<std::uint16_t>(flagged[at / kSize] | near << at % kSize);
      }
    }
  }
}

template <class Lanes, Tests kTests>
inline void scanAll(const PageScan& scan)
{
  for (std::size_t i = 0; i < scan.numberOfPages; ++i)
  {
    const BouncePage& page = *scan.pages[i];
    const BouncePage* const next = i + 1 < scan.numberOfPages ? scan.pages[i + 1] : scan.next;
    std::uint16_t* const flagged = scan.flagged + i * PageScan::kGroups;
    constexpr bool isByLines = kTests == Tests::Lines;
    if constexpr (isByLines)
    {
      std::fill_n(flagged, PageScan::kGroups, std::uint16_t{ 0 });
      flagAfterLines<Lanes>(page, next, scan, flagged);
    }
    for (std::size_t group = 0; group < PageScan::kGroups; ++group)
    {
      if (!isByLines && next != nullptr)
      {
        scan.bodies.count > 0 ? prefetchShare(next, group)
                              : prefetchLine(next->tags + group * PageScan::kGroupSize);
      }
      const std::size_t place = group * PageScan::kGroupSize;
      const unsigned near =
        isByLines ? flagged[group] : flagGroup<Lanes, kTests>(page, place, scan);
      flagged[group] = static_cast<std::uint16_t>(
        (near | Lanes::tagged(page.tags + place, scan.tags)) & Lanes::stored(page.tags + place));
    }
  }
}

template <class Lanes>
inline void scanPages(const PageScan& scan)
{
  constexpr std::uint32_t kFewestForLines =
    8; // to find the lines takes as long as to test some balls
  const GridBodies& all = scan.bodies;
  !all.areSmall                   ? scanAll<Lanes, Tests::Bodies>(scan)
    : all.count < kFewestForLines ? scanAll<Lanes, Tests::Balls>(scan)
                                  : scanAll<Lanes, Tests::Lines>(scan);
}

}
}
