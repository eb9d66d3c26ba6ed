// SPDX-License-Identifier: BSD-3-Clause
// No include guard: the kernel of each instruction set includes this once after PageScan.inl, between the
// marks of its target.

namespace irradiance
{
namespace
{

/// Bodies that may touch something, by number.
struct BodyList
{
  const std::uint32_t* first;
  std::uint32_t size;
};

/// Finds for each of these bodies which of kFanout groups it may touch, a bit for each in `nearOf`; returns
/// those that any may touch.
template <class Lanes>
inline unsigned nearGroups(const IndexScan& scan, const IndexColumns& groups, std::size_t at,
  const BodyList& bodies, std::uint16_t* nearOf)
{
  unsigned any = 0;
  for (std::uint32_t k = 0; k < bodies.size; ++k)
  {
    const GridBody& body = scan.bodies.bodies[bodies.first[k]];
    const GridBall& ball = scan.bodies.balls[bodies.first[k]];
    unsigned near = 0;
    for (std::size_t i = 0; i < IndexScan::kFanout; i += Lanes::kCount)
    {
      const GridEnds<Lanes> ends(groups.ends, at + i);
      const auto radius = Lanes::loadFloats(groups.radius + at + i);
      if (ball.isSmall())
      {
        const StretchedEnds<Lanes> stretched(ends, scan.bodies.stretch);
        const auto reach = Lanes::add(radius, Lanes::all(ball.groupRadius));
        near |=
          Lanes::notAbove(squaredDistance<Lanes>(stretched, ball), Lanes::multiply(reach, reach))
          << i;
        continue;
      }
      const auto reach =
        Lanes::add(Lanes::multiply(radius, Lanes::all(body.stretch)), Lanes::all(body.groupRadius));
      near |= Lanes::notAbove(squaredDistance<Lanes>(ends, body), Lanes::multiply(reach, reach))
        << i;
    }
    nearOf[k] = static_cast<std::uint16_t>(near);
    any |= near;
  }
  return any;
}

/// Those of the bodies that may touch group i, by nearGroups.
inline BodyList bodiesOf(
  unsigned i, const BodyList& bodies, const std::uint16_t* nearOf, std::uint32_t* chosen)
{
  std::uint32_t size = 0;
  for (std::uint32_t k = 0; k < bodies.size; ++k)
  {
    chosen[size] = bodies.first[k];
    size += static_cast<std::uint32_t>(nearOf[k]) >> i & 1u;
  }
  return { chosen, size };
}

/// Flags which of kFanout segments any of the bodies may touch.
template <class Lanes>
inline unsigned nearSegments(
  const IndexScan& scan, const IndexColumns& segments, std::size_t at, const BodyList& bodies)
{
  unsigned any = 0;
  for (std::size_t i = 0; i < IndexScan::kFanout; i += Lanes::kCount)
  {
    const GridEnds<Lanes> ends(segments.ends, at + i);
    any |= flagNearAny<Lanes>(ends, scan.bodies, bodies.first, bodies.size, scan.near) << i;
  }
  return any;
}

inline std::uint32_t* listBits(unsigned bits, std::size_t first, std::uint32_t* found)
{
  for (; bits != 0; bits &= bits - 1)
  {
    *found++ = static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(__builtin_ctz(bits));
  }
  return found;
}

/// Lists what is found in a top.
template <class Lanes>
inline std::uint32_t* scanTop(
  const IndexScan& scan, std::size_t top, const BodyList& bodies, std::uint32_t* found)
{
  const std::size_t group = top * IndexScan::kFanout;
  unsigned groups = nearGroups<Lanes>(scan, scan.groups, group, bodies, scan.nearGroups);
  for (; groups != 0; groups &= groups - 1)
  {
    const auto i = static_cast<unsigned>(__builtin_ctz(groups));
    const BodyList some = bodiesOf(i, bodies, scan.nearGroups, scan.bodiesOfGroup);
    const std::size_t first = (group + i) * IndexScan::kFanout;
    found = listBits(nearSegments<Lanes>(scan, scan.segments, first, some), first, found);
  }
  return found;
}

template <class Lanes>
inline std::size_t scanIndex(const IndexScan& scan)
{
  constexpr std::size_t kFanout = IndexScan::kFanout;
  const BodyList all{ scan.bodies.every, scan.bodies.count };
  std::uint32_t* found = scan.found;
  for (std::size_t at = 0; at < scan.numberOfTops; at += kFanout)
  {
    unsigned tops = nearGroups<Lanes>(scan, scan.tops, at, all, scan.nearTops);
    for (; tops != 0; tops &= tops - 1)
    {
      const auto i = static_cast<unsigned>(__builtin_ctz(tops));
      const BodyList some = bodiesOf(i, all, scan.nearTops, scan.bodiesOfTop);
      found = scanTop<Lanes>(scan, at + i, some, found);
    }
  }
  const std::size_t segments = scan.numberOfTops * kFanout * kFanout;
  for (std::size_t at = 0; at < scan.numberInTail; at += kFanout)
  {
    found = listBits(nearSegments<Lanes>(scan, scan.tail, at, all), segments + at, found);
  }
  return static_cast<std::size_t>(found - scan.found);
}

}
}
