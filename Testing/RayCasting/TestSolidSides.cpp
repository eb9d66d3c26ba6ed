// SPDX-License-Identifier: BSD-3-Clause
// Which side of a triangle is solid: inside bodies, outside rooms, neither for sheets.

#include "Meshes/SolidSides.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace irradiance
{
namespace
{

using Triangles = std::vector<Triangle>;

/// Its front points along (b - a) x (d - a).
Triangles quad(const Vector3& a, const Vector3& b, const Vector3& d)
{
  const Vector3 c = b + d - a;
  return { { a, b, c }, { a, c, d } };
}

Triangles joined(const std::vector<Triangles>& parts)
{
  Triangles all;
  for (const Triangles& part : parts)
  {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

Triangles reversed(Triangles triangles)
{
  for (Triangle& t : triangles)
  {
    std::swap(t.b, t.c);
  }
  return triangles;
}

/// Fronts outside; two triangles per side, the floor first, then the lid.
Triangles box(const Vector3& low, const Vector3& high)
{
  const Vector3 d = high - low;
  const Vector3 x(d[0], 0, 0), y(0, d[1], 0), z(0, 0, d[2]);
  return joined({ quad(low, low + y, low + x), quad(high, high - x, high - y),
    quad(low, low + x, low + z), quad(high, high - z, high - x), quad(low, low + z, low + y),
    quad(high, high - y, high - z) });
}

/// Its front is up.
Triangles sheet(double low, double high, double z)
{
  return quad({ low, low, z }, { high, low, z }, { low, high, z });
}

/// Each part is a run of triangles; all triangles of the parts in `lamps` are lamps.
std::vector<SolidSide> sidesOf(const std::vector<Triangles>& parts,
  const std::vector<std::size_t>& lamps = {}, bool mayHoldRooms = true, bool isOnePart = false)
{
  std::vector<std::uint32_t> partOf;
  std::vector<bool> isLamp;
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    partOf.insert(partOf.end(), parts[i].size(), isOnePart ? 0 : static_cast<std::uint32_t>(i));
    isLamp.insert(isLamp.end(), parts[i].size(), std::count(lamps.begin(), lamps.end(), i) > 0);
  }
  return solidSides(joined(parts), partOf, isLamp, mayHoldRooms, {}).of;
}

std::vector<SolidSide> all(std::size_t count, SolidSide side)
{
  return std::vector<SolidSide>(count, side);
}

std::vector<SolidSide> first(std::vector<SolidSide> sides, std::size_t count)
{
  sides.resize(count);
  return sides;
}

const Vector3 kLow(0, 0, 0), kHigh(1, 1, 1);

}

TEST(SolidSides, WithinClosedSurfaces)
{
  const Triangles cube = box(kLow, kHigh);
  EXPECT_EQ(sidesOf({ cube }, {}, false), all(12, SolidSide::Behind));
  EXPECT_EQ(sidesOf({ reversed(cube) }, {}, false), all(12, SolidSide::InFront));
  Triangles mixed = cube;
  std::vector<SolidSide> expected = all(12, SolidSide::Behind);
  for (const std::size_t i : { 0, 3, 4, 11 })
  {
    std::swap(mixed[i].a, mixed[i].b);
    expected[i] = SolidSide::InFront;
  }
  EXPECT_EQ(sidesOf({ mixed }, {}, false), expected);
}

TEST(SolidSides, NoneOfSheets)
{
  Triangles open = box(kLow, kHigh);
  open.pop_back();
  EXPECT_EQ(sidesOf({ open }), all(11, SolidSide::None));
  EXPECT_EQ(sidesOf({ sheet(0, 1, 0) }), all(2, SolidSide::None));
  // There and back: closed, but with nothing inside.
  EXPECT_EQ(
    sidesOf({ joined({ sheet(0, 1, 0), reversed(sheet(0, 1, 0)) }) }), all(4, SolidSide::None));
}

TEST(SolidSides, BodiesThatTouchAreBodies)
{
  const Triangles cube = box(kLow, kHigh);
  // Stacked, side by side along an edge, and all in one part.
  const Triangles on = box({ 0, 0, 1 }, { 1, 1, 2 }), beside = box({ 1, 1, 0 }, { 2, 2, 1 });
  for (const bool isOnePart : { false, true })
  {
    EXPECT_EQ(sidesOf({ cube, on, beside }, {}, false, isOnePart), all(36, SolidSide::Behind));
    EXPECT_EQ(sidesOf({ beside, on, cube }, {}, false, isOnePart), all(36, SolidSide::Behind));
  }
}

// A light table as large as the box that stands on it shares the box's edges.
TEST(SolidSides, LampsDoNotOpenABody)
{
  const Triangles cube = box(kLow, kHigh);
  for (const bool isOnePart : { false, true })
  {
    EXPECT_EQ(first(sidesOf({ cube, sheet(0, 1, 0) }, { 1 }, true, isOnePart), 12),
      all(12, SolidSide::Behind));
    EXPECT_EQ(first(sidesOf({ cube, sheet(-1, 2, 0) }, { 1 }, true, isOnePart), 12),
      all(12, SolidSide::Behind));
  }
}

TEST(SolidSides, WithoutRooms)
{
  const Triangles cube = box(kLow, kHigh), lamp = sheet(0.25, 0.5, 1);
  // Front outside: a room, because it holds everything and also a lamp.
  EXPECT_EQ(first(sidesOf({ cube, lamp }, { 1 }), 12), all(12, SolidSide::InFront));
  EXPECT_EQ(first(sidesOf({ cube, lamp }, { 1 }, false), 12), all(12, SolidSide::Behind));
  // Front inside: a room if it holds everything, or something smaller than a side.
  EXPECT_EQ(sidesOf({ reversed(cube) }), all(12, SolidSide::Behind));
  const Triangles elsewhere = sheet(3, 4, 0);
  EXPECT_EQ(first(sidesOf({ reversed(cube), lamp, elsewhere }), 12), all(12, SolidSide::Behind));
  EXPECT_EQ(first(sidesOf({ cube, lamp, elsewhere }), 12), all(12, SolidSide::Behind));
  EXPECT_EQ(first(sidesOf({ reversed(cube), elsewhere }), 12), all(12, SolidSide::InFront));
  // A box in it is not a room.
  const Triangles inner = box({ 0.25, 0.25, 0 }, { 0.5, 0.5, 0.5 });
  const std::vector<SolidSide> both = sidesOf({ cube, inner });
  EXPECT_EQ(first(both, 12), all(12, SolidSide::InFront));
  EXPECT_EQ(both.back(), SolidSide::Behind);
}

TEST(SolidSides, PartsCloseTogether)
{
  const Triangles cube = box(kLow, kHigh);
  std::vector<Triangles> sides;
  for (std::size_t i = 0; i < 12; i += 2)
  {
    sides.push_back({ cube[i], cube[i + 1] });
  }
  sides.push_back(sheet(0.25, 0.5, 1));
  EXPECT_EQ(first(sidesOf(sides, { 6 }), 12), all(12, SolidSide::InFront));
}

namespace
{

Triangles cavity(const Vector3& low, const Vector3& high)
{
  return reversed(box(low, high));
}

constexpr SolidSide kBehind = SolidSide::Behind, kInFront = SolidSide::InFront;

}

// A body with a cavity, in it a body with a cavity. Fronts are out of the material throughout, so
// all of it is behind.
TEST(SolidSides, ShellsNest)
{
  const Triangles chamber =
    joined({ box(kLow, kHigh), cavity({ .125, .125, .125 }, { .875, .875, .875 }) });
  const Triangles flask = joined({ box({ .1875, .3125, .125 }, { .625, .8125, .6875 }),
    cavity({ .3125, .375, .1875 }, { .5, .6875, .625 }) });
  const Triangles lamp = sheet(.125, .875, .875), lampOutside = sheet(0, .5, 1);
  for (const bool mayHoldRooms : { false, true })
  {
    for (const bool isOnePart : { false, true })
    {
      const auto sides = [&](const std::vector<Triangles>& parts,
                           const std::vector<std::size_t>& lamps = {}) {
        return first(sidesOf(parts, lamps, mayHoldRooms, isOnePart), 24);
      };
      EXPECT_EQ(sides({ chamber }), all(24, kBehind));
      EXPECT_EQ(sides({ chamber, lamp }, { 1 }), all(24, kBehind));
      EXPECT_EQ(sides({ chamber, lampOutside }, { 1 }), all(24, kBehind));
      EXPECT_EQ(sidesOf({ chamber, flask }, {}, mayHoldRooms, isOnePart), all(48, kBehind));
      EXPECT_EQ(sidesOf({ flask, chamber }, {}, mayHoldRooms, isOnePart), all(48, kBehind));
      // Each wall a part of its own.
      EXPECT_EQ(sidesOf({ cavity({ .125, .125, .125 }, { .875, .875, .875 }), box(kLow, kHigh) },
                  {}, mayHoldRooms, isOnePart),
        all(24, kBehind));
    }
  }
}

// The box of an L holds the corner that is cut out of it; boxes that cross hold a part of each
// other. A shell with its front inside that is in no body is a body.
TEST(SolidSides, OnlyWhatIsInsideOfABodyIsACavity)
{
  const Triangles lower = box(kLow, { 1, 1, .5 }), upper = box({ 0, 0, .5 }, { .5, 1, 1 });
  // Along the shared edges four triangles meet, so the two are one part with the shape of an L, or
  // two bodies.
  const Triangles step = joined({ lower, upper });
  for (const bool isOnePart : { false, true })
  {
    EXPECT_EQ(sidesOf({ cavity({ .625, .125, .625 }, { .875, .875, .875 }), step }, {}, false,
                isOnePart)[0],
      kInFront);
    EXPECT_EQ(sidesOf({ cavity({ .625, .125, .125 }, { .875, .875, .375 }), step }, {}, false,
                isOnePart)[0],
      kBehind);
  }
  const Triangles cube = box(kLow, kHigh);
  EXPECT_EQ(sidesOf({ cavity({ .5, .5, .5 }, { 1.5, .875, .875 }), cube }, {}, false)[0], kInFront);
  EXPECT_EQ(sidesOf({ cavity({ 1, 0, 0 }, { 2, 1, 1 }), cube }, {}, false)[0], kInFront);
  // It touches the body from inside, with a wall of no thickness; it coincides with the body.
  EXPECT_EQ(sidesOf({ cavity({ .5, .5, .5 }, { .875, 1, .875 }), cube }, {}, false)[0], kBehind);
  EXPECT_EQ(sidesOf({ reversed(cube), cube }, {}, false)[0], kInFront);
}

// 20 x 20 x 20 bubbles in a block, every other one with a body in it.
TEST(SolidSides, OfManyShellsTakeNoSquareOfTheirNumber)
{
  std::vector<Triangles> parts{ box(kLow, kHigh) };
  for (int i = 0; i < 8000; ++i)
  {
    const Vector3 low = Vector3(i % 20 + .25, i / 20 % 20 + .25, i / 400 + .25) / 32;
    const Vector3 high = low + Vector3::Constant(1. / 64);
    parts.push_back(cavity(low, high));
    if (i % 2 == 0)
    {
      parts.push_back(box(low + Vector3::Constant(1. / 256), high - Vector3::Constant(1. / 256)));
    }
  }
  EXPECT_TRUE(sidesOf(parts, {}, true, true) == all(12 * parts.size(), kBehind));
}

}
