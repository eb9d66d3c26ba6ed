// SPDX-License-Identifier: BSD-3-Clause
#include "FrontWorld.h"
#include "Kit.h"
#include "Sampling/DirectionSampling.h"
#include "Shooting/FrontLoops.h"
#include "Shooting/WalkFront.h"

namespace irradiance::test
{
namespace
{

constexpr std::uint32_t kFrontWalks = 1000; // the last group is not full

/// Triangles at random, thin ones and small ones among them, in two objects, of which one is
/// placed; each with a reflectance of its own.
SceneObjects someTriangles()
{
  RandomVectors random(5);
  const auto some = [&](double exitance) {
    ObjectBuilder builder;
    for (int i = 0; i < 200; ++i)
    {
      const double size = random.powerOfTwo(-12, 0), thin = random.powerOfTwo(-20, 0);
      const Vector3 place = random.inCube(), along = size * random.direction();
      const Vector3 aside = size * thin * random.direction();
      const double reflectance = i % 10 == 0 ? 0 : i % 10 == 1 ? 1 : random.uniform(0, 1);
      builder.addCell({ { place, place + along, place + aside } },
        grey(reflectance, i % 3 == 0 ? exitance * random.uniform(0, 1) : 0));
    }
    return builder.build();
  };
  SceneObjects objects{ some(1), { some(0) } };
  objects.dynamicObjects[0].worldFromObject = { random.rotation(), random.inCube() };
  return objects;
}

/// Samples of a walk as integers.
std::array<std::uint32_t, 2> integersOf(
  const SobolSequence& samples, std::uint32_t walk, std::uint32_t bounce, SampleUse use)
{
  const std::array<double, 2> sample = samples.sample(walk, bounce, use);
  const auto integer = [](double x) { return static_cast<std::uint32_t>((x - 0x1p-33) * 0x1p32); };
  return { integer(sample[0]), integer(sample[1]) };
}

enum class Bounces
{
  Same,  ///< all walks at one
  Mixed, ///< as after repairs
  Few,   ///< likewise, but none beyond the usual ones
  Late,  ///< all walks at one that is unusual
  Runs   ///< groups of one and groups of several
};

std::uint32_t bounceOf(Bounces bounces, std::uint32_t i)
{
  static_assert(SobolSequence::kKnownBounces == 32);
  const std::uint32_t mixed = i * 7 % 50, few = i * 7 % 31;
  const std::uint32_t runs[] = { 2, few, mixed, 30, 31 };
  return bounces == Bounces::Same ? 3
    : bounces == Bounces::Mixed   ? mixed
    : bounces == Bounces::Few     ? few
    : bounces == Bounces::Late    ? 40
                                  : runs[i / 100 % 5];
}

/// Walks with hits at random, also with none.
void fill(WalkFront& front, const FrontWorld& world, Bounces bounces, std::uint32_t firstWalk)
{
  RandomVectors random(7);
  world.enter(front, firstWalk, kFrontWalks);
  for (std::uint32_t i = 0; i < kFrontWalks; ++i)
  {
    const Vector3 direction = random.direction();
    front.directionX[i] = static_cast<float>(direction[0]);
    front.directionY[i] = static_cast<float>(direction[1]);
    front.directionZ[i] = static_cast<float>(direction[2]);
    front.bounce[i] = bounceOf(bounces, i);
    front.start[i] = static_cast<std::uint32_t>(random.engine() % world.triangles().size());
    front.hit[i] = i % 9 == 0
      ? WalkFront::kNone
      : static_cast<std::uint32_t>(random.engine() % world.triangles().size());
    const double root = std::sqrt(random.uniform(0, 1)), part = random.uniform(0, 1);
    front.weightB[i] = i % 50 == 0 ? 1.0F : i % 50 == 1 ? 0.0F : static_cast<float>(root * part);
    front.weightC[i] = i % 50 <= 2 ? 0.0F : static_cast<float>(root * (1 - part));
    front.side[i] = front.hitSide[i] = static_cast<std::uint8_t>(random.engine() % 2);
    front.slot[i] = 0x10000 + 3 * i;
    front.leaving[i] = Leaving::Diffuse;
    front.originX[i] = i;
    front.originY[i] = 2.0 * i;
    front.originZ[i] = 3.0 * i;
    for (int band = 0; band < Power::kMaxBands; ++band)
    {
      front.power[band].reserve(kFrontWalks);
      front.power[band][i] = (std::int64_t{ 1 } << 40) + 3 * i + band;
    }
  }
}

Vector3 directionOf(const WalkFront& front, std::size_t i)
{
  return { front.directionX[i], front.directionY[i], front.directionZ[i] };
}

/// What a walk takes along from its hit into the next front, `next` or `front`.
auto onwards(const WalkFront& next, std::size_t i)
{
  return std::tuple(next.walk[i], next.start[i], next.bounce[i], next.parent[i], next.block[i],
    next.weightB[i], next.weightC[i], next.side[i]);
}
auto fromHit(const WalkFront& front, std::size_t i)
{
  return std::tuple(front.walk[i], front.hit[i], front.bounce[i] + 1, front.slot[i], front.block[i],
    front.weightB[i], front.weightC[i], front.hitSide[i]);
}

/// The plans of one and of several replicates.
std::vector<WalkPlan> somePlans()
{
  return { WalkPlan(5000, 5000, 1), WalkPlan(5000, 5000, 16), WalkPlan(5000, 5000, 7, 1000),
    WalkPlan(5000, 5000, 1, 0xfffff000u - 5000) };
}

/// Calls test(world, bounces) on each instruction set, for each plan and kind of bounces.
template <class Test>
void onAll(const Test& test)
{
  const SceneObjects objects = someTriangles();
  for (const WalkPlan& plan : somePlans())
  {
    const FrontWorld world(objects, plan, 11);
    for (const SimdLevel level : simdLevels())
    {
      const SimdLimit limit(level);
      for (const Bounces bounces :
        { Bounces::Same, Bounces::Mixed, Bounces::Few, Bounces::Late, Bounces::Runs })
      {
        test(world, bounces);
      }
    }
  }
}

TEST(WalkStages, WalksStartWhereTheirSamplesSay)
{
  onAll([](const FrontWorld& world, Bounces) {
    WalkFront front;
    const std::uint32_t first = world.plan().rounds().front().firstWalk;
    world.enter(front, first, kFrontWalks);
    world.stages().start(front);
    for (std::uint32_t i = 0; i < kFrontWalks; ++i)
    {
      const auto chosen = world.samples().sample(first + i, 0, SampleUse::Light);
      const Light& light = world.lights()[world.lights().choose(chosen[0])];
      ASSERT_EQ(front.start[i], world.triangles().numberOf(light.triangle()));
      ASSERT_EQ(front.bounce[i], 0u);
      ASSERT_EQ(front.parent[i], WalkFront::kNone);
      ASSERT_EQ(front.side[i], 1);
      const Vector3 weights =
        sampleTriangle(world.samples().sample(first + i, 0, SampleUse::Position));
      ASSERT_NEAR(front.weightB[i], weights[1], 0x1p-22);
      ASSERT_NEAR(front.weightC[i], weights[2], 0x1p-22);
      ASSERT_LE(double{ front.weightB[i] } + double{ front.weightC[i] }, 1 + 0x1p-23);
    }
  });
}

TEST(WalkStages, WalksSurviveAsTheirSamplesSay)
{
  onAll([](const FrontWorld& world, Bounces bounces) {
    WalkFront front, next;
    const std::uint32_t first = world.plan().rounds().front().firstWalk;
    fill(front, world, bounces, first);
    world.stages().absorb(front, next);
    std::size_t kept = 0;
    for (std::uint32_t i = 0; i < kFrontWalks; ++i)
    {
      const TriangleId id = world.triangles().idOf(front.hit[i]);
      const double sample =
        world.samples().sample(first + i, front.bounce[i] + 1, SampleUse::Survival)[0];
      if (front.hit[i] != WalkFront::kNone &&
        sample < world.stages().materialOf(id.object).surviving()[world.stages().cellOf(id)])
      {
        ASSERT_LT(kept, next.size);
        ASSERT_TRUE(onwards(next, kept) == fromHit(front, i)) << "walk " << first + i;
        ++kept;
      }
    }
    EXPECT_EQ(kept, next.size);
  });
}

TEST(WalkStages, PackingKeepsOrderAndLosesNothing)
{
  const FrontWorld world(someTriangles(), WalkPlan(5000, 5000, 1), 11);
  RandomVectors random(9);
  for (const SimdLevel level : simdLevels())
  {
    const SimdLimit limit(level);
    for (int trial = 0; trial < 300; ++trial)
    {
      WalkFront front, next;
      fill(front, world, Bounces::Mixed, 0);
      front.size = trial < 40 ? static_cast<std::size_t>(trial) : 1 + random.engine() % kFrontWalks;
      next.reserve(front.size, 3);
      for (std::size_t group = 0; group < front.groups(); ++group)
      {
        front.survivors[group] = static_cast<std::uint32_t>(trial % 4 == 0 ? 0xffffffffu
            : trial % 4 == 1                                               ? 0
                                                                           : random.engine());
      }
      frontLoops().pack(front, next, true, 3);
      std::size_t kept = 0;
      for (std::size_t i = 0; i < front.size; ++i)
      {
        if ((front.survivors[i / 32] >> i % 32 & 1) == 0)
        {
          continue;
        }
        ASSERT_TRUE(onwards(next, kept) == fromHit(front, i)) << "row " << i;
        ASSERT_EQ(next.leaving[kept], front.leaving[i]);
        ASSERT_EQ(world.rayOf(next, kept).origin, world.rayOf(front, i).origin);
        ASSERT_EQ(directionOf(next, kept), directionOf(front, i));
        ASSERT_EQ(next.powerAt(kept, 3), front.powerAt(i, 3));
        ++kept;
      }
      ASSERT_EQ(next.size, kept);
    }
  }
}

// Bit for bit from the point that SurfacePoint finds, in the direction that the samples of the
// sequence choose; never into the surface.
TEST(WalkStages, RaysLeaveFromSurfacePoints)
{
  onAll([](const FrontWorld& world, Bounces bounces) {
    WalkFront front;
    const std::uint32_t first = world.plan().rounds().front().firstWalk;
    fill(front, world, bounces, first);
    WalkFront before;
    fill(before, world, bounces, first);
    world.stages().leave(front);
    for (std::uint32_t i = 0; i < kFrontWalks; ++i)
    {
      const double b = front.weightB[i], c = front.weightC[i];
      SurfacePoint point = surfacePoint(
        world.scene().worldTriangle(world.triangles().idOf(front.start[i])), { 1 - b - c, b, c });
      point.turn(before.side[i] != 0);
      ASSERT_EQ(front.side[i] != 0, point.isFront);
      ASSERT_EQ(world.rayOf(front, i).origin, point.clearPosition());
      const auto sample =
        integersOf(world.samples(), first + i, front.bounce[i], SampleUse::Direction);
      const CosineDirectionInFloat expected(static_cast<float>(point.normal[0]),
        static_cast<float>(point.normal[1]), static_cast<float>(point.normal[2]), sample[0],
        sample[1]);
      ASSERT_EQ(directionOf(front, i), Vector3(expected.x, expected.y, expected.z));
      ASSERT_GT(directionOf(front, i).dot(point.normal), 0);
    }
  });
}

TEST(WalkStages, SidesAreThoseThatTheRaysComeFrom)
{
  onAll([](const FrontWorld& world, Bounces bounces) {
    WalkFront front;
    fill(front, world, bounces, 0);
    world.stages().findSides(front);
    for (std::uint32_t i = 0; i < kFrontWalks; ++i)
    {
      const bool isFront = front.hit[i] == WalkFront::kNone ||
        directionOf(front, i).dot(Vector3(world.triangles().records()[front.hit[i]].normal)) <= 0;
      ASSERT_EQ(front.hitSide[i] != 0, isFront);
    }
  });
}

TEST(WalkStages, ReplicatesAreThoseOfTheDivision)
{
  RandomVectors random(13);
  ReplicateLanes lanes;
  for (int trial = 0; trial < 20000; ++trial)
  {
    const auto count =
      2 + static_cast<std::uint32_t>(random.engine() >> (32 + random.engine() % 31));
    const auto first = static_cast<std::uint32_t>(trial % 2 == 0 ? 0 : random.engine());
    const Replicates replicates(count, first);
    std::uint32_t walks[ReplicateLanes::kSize];
    for (std::uint32_t& walk : walks)
    {
      // Any, and on both sides of a multiple.
      const auto any = static_cast<std::uint32_t>(random.engine());
      walk = first + (any % 2 == 0 ? any : any / count * count - any % 3);
    }
    lanes.set(walks, first, count);
    for (unsigned lane = 0; lane < ReplicateLanes::kSize; ++lane)
    {
      ASSERT_EQ(lanes.replicate[lane], replicates.replicateOf(walks[lane]))
        << walks[lane] << ' ' << count;
      ASSERT_EQ(lanes.number[lane], replicates.numberWithin(walks[lane]));
    }
  }
}

// A direction may graze by less than its rounding to float.
TEST(WalkStages, RoundedDirectionsStayOutOfTheSurface)
{
  RandomVectors random(12);
  for (int i = 0; i < 1000000; ++i)
  {
    const Vector3 normal = random.direction();
    const Vector3 along = normal.cross(random.direction()).normalized();
    const double height = i % 10 == 0 ? 0 : random.powerOfTwo(-60, 0);
    const Vector3 direction = (along + height * normal).normalized();
    const Vector3 rounded = roundedDirection(direction, normal);
    ASSERT_GT(rounded.dot(normal), 0x1p-31);
    ASSERT_LE((rounded - direction).norm(), 0x1p-21);
    for (int axis = 0; axis < 3; ++axis)
    {
      ASSERT_EQ(rounded[axis], static_cast<double>(static_cast<float>(rounded[axis])));
    }
  }
}

TEST(WalkStages, WalksThatNeverEndAreNamed)
{
  const FrontWorld world(someTriangles(), WalkPlan(5000, 5000, 1), 11);
  WalkFront front, next;
  fill(front, world, Bounces::Same, 0);
  std::fill_n(front.bounce.data(), kFrontWalks, (1u << 20) - 1);
  world.stages().absorb(front, next);
  std::fill_n(front.bounce.data(), kFrontWalks, 1u << 20);
  EXPECT_THROW(world.stages().absorb(front, next), std::runtime_error);
}

/// All columns of a row but for its power.
auto columnsOf(WalkFront& front, std::size_t i)
{
  return std::tie(front.originX[i], front.originY[i], front.originZ[i], front.directionX[i],
    front.directionY[i], front.directionZ[i], front.start[i], front.side[i], front.distance[i],
    front.hit[i], front.weightB[i], front.weightC[i], front.hitSide[i], front.candidate[i],
    front.walk[i], front.bounce[i], front.block[i], front.slot[i], front.parent[i],
    front.leaving[i]);
}

int bandsOfPower(const WalkFront& front)
{
  return front.bands > 1 ? front.bands : 0;
}

/// Every column tells the number of the row, each in another way.
void write(WalkFront& front, std::size_t place, std::uint32_t number)
{
  std::uint32_t column = 0;
  const auto set = [&](auto& value) {
    value = static_cast<std::decay_t<decltype(value)>>(number + 1000 * ++column);
  };
  std::apply([&](auto&... values) { (set(values), ...); }, columnsOf(front, place));
  for (int band = 0; band < bandsOfPower(front); ++band)
  {
    front.power[band][place] = (std::int64_t{ ++column } << 40) + number;
  }
}

void expectRow(WalkFront& front, std::size_t place, std::uint32_t number)
{
  WalkFront expected;
  expected.reserve(1, front.bands);
  write(expected, 0, number);
  ASSERT_TRUE(columnsOf(front, place) == columnsOf(expected, 0)) << "row " << place;
  ASSERT_EQ(front.powerAt(place, bandsOfPower(front)), expected.powerAt(0, bandsOfPower(front)));
}

TEST(WalkFront, TakesWholeRowsBehindItsOwn)
{
  constexpr std::uint32_t kRows = 500;
  RandomVectors random(3);
  for (const int bands : { 1, 2, 3 })
  {
    WalkFront from, to;
    from.reserve(kRows, bands);
    from.size = kRows;
    for (std::uint32_t i = 0; i < kRows; ++i)
    {
      write(from, i, i);
    }
    std::vector<std::uint32_t> expected;
    for (int trial = 0; trial < 50; ++trial)
    {
      const std::size_t first = random.engine() % (kRows + 1);
      const std::size_t count = trial % 3 == 0 ? 0 : random.engine() % (kRows - first + 1);
      to.take(from, first, count);
      for (std::size_t i = first; i < first + count; ++i)
      {
        expected.push_back(static_cast<std::uint32_t>(i));
      }
      ASSERT_EQ(to.size, expected.size());
    }
    ASSERT_EQ(to.bands, bands);
    for (std::size_t i = 0; i < to.size; ++i)
    {
      ASSERT_NO_FATAL_FAILURE(expectRow(to, i, expected[i]));
    }
    to.pad(); // there is room
  }
}

}
}
