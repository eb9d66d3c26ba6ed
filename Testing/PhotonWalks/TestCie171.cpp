// SPDX-License-Identifier: BSD-3-Clause
#include "Kit.h"
#include "LambertContour.h"
#include "Sheets.h"
#include "Skies.h"

namespace irradiance::test
{
namespace
{

// |t| > 3 with 15 degrees of freedom happens by chance in 0.9 % of the comparisons; seeds are
// fixed.
constexpr int kSeeds = 16;

class Cie171 : public BothModes
{
protected:
  /// The first so many cells of the static object, W/m2.
  static std::vector<ReplicateMean> irradiances(
    const SceneObjects& objects, std::size_t cells, std::uint32_t walks)
  {
    std::vector<ReplicateMean> estimates(cells);
    overSeeds(objects, kSeeds, walks, [&](const IrradianceEngine& engine) {
      for (std::size_t i = 0; i < cells; ++i)
      {
        estimates[i].add(engine.irradiance({ 0, i }, 0));
      }
    });
    return estimates;
  }
};

// CIE 171:2006, 5.3: 1 x 1 m of exitance 1000 pi in the ceiling of a black room. A strip of 0.5 x
// 0.25 m around each point is compared with the mean of Lambert's formula over the strip.
TEST_P(Cie171, AreaSource53)
{
  const double heights[] = { 2.75, 2.25, 1.75, 1.25, 0.75, 0.25 };
  const double published[] = { 32.677, 75.194, 81.323, 69.061, 53.404, 40.002 };
  ObjectBuilder room;
  const Vector3 up(0, 0, 1), inward(-1, 0, 0), along(0, 0.5, 0), high(0, 0, 0.25);
  for (const double z : heights)
  {
    room.addQuad(Vector3(2, 0.25, z - 0.125), -along, high, 1, 1, grey(0));
  }
  room.addQuad({ -0.5, -0.5, 3 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1, grey(0, 1000 * M_PI));
  const std::vector<Vector3> source = { { -0.5, -0.5, 3 }, { 0.5, -0.5, 3 }, { 0.5, 0.5, 3 },
    { -0.5, 0.5, 3 } };
  const auto exact = [&](const Vector3& p) {
    return 1000 * M_PI * lambertIrradiance(p, inward, source);
  };
  const auto estimates = irradiances({ room.build(), {} }, 6, scaled(65536));
  for (std::size_t i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(exact({ 2, 0, heights[i] }), published[i], 6e-4);
    const double truth =
      meanOverRectangle({ 2, -0.25, heights[i] - 0.125 }, along, high, 40, exact);
    EXPECT_LE(std::abs(estimates[i].t(truth)), 3) << "z " << heights[i];
  }
}

// 5.4: no flux is lost in a black room. What is gathered is an estimate.
TEST_P(Cie171, FluxConservation54)
{
  ObjectBuilder room;
  room.addBox(box({ -2, -2, 0 }, { 2, 2, 3 }), 4, grey(0), true);
  room.addPointLight({ 0.3, -0.2, 2.5 }, 1234.5);
  room.addQuad({ -1, -1, 2 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1, grey(0, 250));
  const SceneObjects objects{ room.build(), {} };
  ReplicateMean received;
  overSeeds(objects, kSeeds, 10007, [&](const IrradianceEngine& engine) {
    received.add(wattsOn(engine, 0, 0, objects.staticObject.material->numberOfCells));
    EXPECT_TRUE(isGathered() || engine.balance().escaped.isZero());
  });
  EXPECT_LE(std::abs(received.t(1484.5)), 3);
  EXPECT_NEAR(received.mean() / 1484.5, 1, isGathered() ? 5e-3 : 1e-12);
}

// As 5.6: a floor patch of 1 x 1 m, which reflects 0.8, shines on the upper part of a black wall. A
// lamp between them, whose back is to the wall, lights the patch; what the wall receives is
// Lambert's formula twice.
TEST_P(Cie171, DiffuseReflection56)
{
  const double heights[] = { 2.75, 2.25, 1.75, 1.25 };
  const Vector3 up(0, 0, 1), inward(-1, 0, 0), along(0, 1, 0), high(0, 0, 0.25);
  ObjectBuilder room;
  for (const double z : heights)
  {
    room.addQuad(Vector3(2, 0.5, z - 0.125), -along, high, 1, 1, grey(0));
  }
  room.addQuad({ -0.5, -0.5, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 3, 3, grey(0.8));
  const std::vector<Vector3> lamp = { { 1, -0.4, 0.05 }, { 1, -0.4, 0.3 }, { 1, 0.4, 0.3 },
    { 1, 0.4, 0.05 } };
  room.addQuad(lamp[0], lamp[1] - lamp[0], lamp[3] - lamp[0], 1, 1, grey(0, 1000));
  const auto onWall = [&](const Vector3& p) {
    return meanOverRectangle(
      { -0.5, -0.5, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 24, [&](const Vector3& q) {
        const Vector3 to = p - q;
        const double square = to.squaredNorm();
        return 0.8 * 1000 * lambertIrradiance(q, up, lamp) * to[2] * -inward.dot(to) /
          (M_PI * square * square);
      });
  };
  const auto estimates = irradiances({ room.build(), {} }, 4, scaled(262144));
  for (std::size_t i = 0; i < 4; ++i)
  {
    const double truth =
      meanOverRectangle({ 2, -0.5, heights[i] - 0.125 }, along, high, 12, onWall);
    EXPECT_LE(std::abs(estimates[i].t(truth)), 3) << "z " << heights[i];
  }
}

// 5.7: a shining wall, of which only the part above the line of sight over an obstruction counts.
// Strips of 4 x 0.5 m of the opposite wall are compared with the mean of Lambert's formula.
TEST_P(Cie171, DiffuseReflectionWithObstruction57)
{
  const double heights[] = { 2.75, 2.25, 1.75, 1.25, 0.75, 0.25 };
  const double published[] = { 16.071, 16.330, 15.399, 13.322, 10.317, 7.079 }; // %
  ObjectBuilder room, obstruction;
  for (const double z : heights)
  {
    room.addQuad({ 4, 0, z - 0.25 }, { -4, 0, 0 }, { 0, 0, 0.5 }, 1, 1, grey(0));
  }
  room.addQuad({ 0, 4, 0 }, { 4, 0, 0 }, { 0, 0, 3 }, 1, 1, grey(0, 100));
  obstruction.addBox(box({ 0, 2.5, 0 }, { 4, 2.7, 1 }), 1, grey(0));
  const auto exact = [](const Vector3& p) {
    const double edge = p[2] < 1 ? 2.5 : 2.7;
    const double seenFrom = std::max(0.0, p[2] + (1 - p[2]) * 4 / edge);
    return 100 *
      lambertIrradiance(
        p, { 0, 1, 0 }, { { 0, 4, seenFrom }, { 4, 4, seenFrom }, { 4, 4, 3 }, { 0, 4, 3 } });
  };
  double wall = 0, wallTruth = 0;
  const auto estimates = irradiances({ room.build(), { obstruction.build() } }, 6, scaled(65536));
  for (std::size_t i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(exact({ 2, 0, heights[i] }), published[i], 6e-4);
    const double truth =
      meanOverRectangle({ 0, 0, heights[i] - 0.25 }, { 4, 0, 0 }, { 0, 0, 0.5 }, 40, exact);
    EXPECT_LE(std::abs(estimates[i].t(truth)), 3) << "z " << heights[i];
    wall += estimates[i].mean() / 6;
    wallTruth += truth / 6;
  }
  EXPECT_NEAR(wall, wallTruth, (kIsSanitized ? 0.05 : 0.01) * wallTruth);
}

// 5.8: the internal reflected component in a 4 m cube. The mean has a closed form; the centre of a
// wall is compared with values of an independent program. The direct part, which has the same bits
// at reflectance 0, is subtracted.
TEST_P(Cie171, InternalReflectedComponent58)
{
  constexpr int kCells = 15;
  const auto room = [&](double reflectance) {
    ObjectBuilder builder;
    builder.addBox(box({ -2, -2, -2 }, { 2, 2, 2 }), kCells, grey(reflectance), true);
    builder.addPointLight({ 0, 0, 0 }, 10000);
    return SceneObjects{ builder.build(), {} };
  };
  const auto meanAndCenter = [&](const IrradianceEngine& engine) {
    double center = 0;
    for (std::size_t wall = 0; wall < 6; ++wall)
    {
      center += engine.irradiance({ 0, wall * kCells * kCells + kCells * kCells / 2 }, 0) / 6;
    }
    return std::array<double, 2>{ wattsOn(engine, 0, 0, 6 * kCells * kCells) / 96, center };
  };
  const struct
  {
    double reflectance, printed, center;
  } rows[] = { { 0.05, 5.48, 6.158 }, { 0.1, 11.6, 0 }, { 0.2, 26.0, 0 }, { 0.3, 44.6, 0 },
    { 0.4, 69.4, 0 }, { 0.5, 104, 112.04 }, { 0.6, 156, 0 }, { 0.7, 243, 0 }, { 0.8, 417, 431.1 },
    { 0.9, 937, 0 }, { 0.95, 1979, 1998.5 } };
  for (const auto& [reflectance, printed, center] : rows)
  {
    if (kIsSanitized && center == 0)
    {
      continue; // they take the ways of the others
    }
    const auto walks = static_cast<std::uint32_t>(scaled(32768) * std::max(0.1, 1 - reflectance));
    std::vector<std::array<double, 2>> direct(kSeeds, { 10000.0 / 96, 0 });
    std::size_t next = 0;
    if (center > 0)
    {
      overSeeds(room(0), kSeeds, walks,
        [&](const IrradianceEngine& engine) { direct[next++] = meanAndCenter(engine); });
    }
    ReplicateMean meanEstimate, centerEstimate;
    overSeeds(room(reflectance), kSeeds, walks, [&](const IrradianceEngine& engine) {
      const auto [all, atCenter] = meanAndCenter(engine);
      const auto& [directAll, directCenter] =
        direct[static_cast<std::size_t>(meanEstimate.count())];
      EXPECT_NEAR(directAll, 10000.0 / 96, isGathered() ? 1e-2 : 1e-9);
      meanEstimate.add(all - directAll);
      centerEstimate.add(atCenter - directCenter);
    });
    const double truth = reflectance * 10000 / (96 * (1 - reflectance));
    EXPECT_NEAR(truth, printed, 0.005 * printed);
    EXPECT_LE(std::abs(meanEstimate.t(truth)), 3);
    EXPECT_NEAR(meanEstimate.mean(), truth, (kIsSanitized ? 0.05 : 0.01) * truth);
    if (center > 0)
    {
      EXPECT_LE(std::abs(centerEstimate.t(center)), 3);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(DirectLight, Cie171, testing::Bool(), nameOfMode);

// 5.9 and 5.11: daylight through openings without glass, of CIE skies whose sun is 60 degrees high,
// in a black room of 4 x 4 x 3 m. The values, in % of the horizontal irradiance, are exact ones of
// an independent program. CIE's own tables are wrong in places: for the roof of 4 x 4 m they have
// at A 37.84 (type 1), 46.74 (5), 66.34 (12) and 39.28 (16), and of type 13 at G 42.07 in place of
// 47.01; type 3 of the small roof is in reverse order; of the facade of 4 x 3 m the walls are off
// by up to 6 %, the last place of the ceiling has 13.59, and the table of type 14 is that of 15.
class Cie171Daylight : public testing::TestWithParam<bool>
{
protected:
  static constexpr double kPart = kIsSanitized ? 0.2 : 0.05;
  static constexpr std::size_t kNoGlass = std::numeric_limits<std::size_t>::max();

  static EngineSettings settings()
  {
    Shoot shoot(100);
    shoot.gathered().bySide().unverified();
    shoot.fewestSamples = { scaled(1 << 15), scaled(1 << 15), scaled(1 << 15) };
    return GetParam() ? shoot.finalGather(1 << 14).everywhere() : shoot;
  }

  /// A cell of 8 cm around a place on a wall.
  static void addSpot(ObjectBuilder& room, const Vector3& place, const Vector3& u, const Vector3& v)
  {
    room.addQuad(place - 0.04 * (u + v), 0.08 * u, 0.08 * v, 1, 1, grey(0));
  }
  /// In the middle of a wall, from its top to its foot, and of the floor or ceiling, all along.
  static void addSpots(ObjectBuilder& room, double wall, double first)
  {
    const Vector3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    for (int i = 0; i < 6; ++i)
    {
      const Vector3 place(2, wall, 2.75 - 0.5 * i);
      wall == 0 ? addSpot(room, place, z, x) : addSpot(room, place, x, z);
    }
    for (int i = 0; i < 8; ++i)
    {
      addSpot(room, { 2, first + (first < 2 ? 0.5 : -0.5) * i, 0 }, x, y);
    }
  }
  /// The walls but one stand 1 mm behind the spots. They are an object of their own, so that no
  /// survey of what rests finds the sky hard to see.
  static void addWalls(ObjectBuilder& room, int open)
  {
    for (int side = 0; side < 6; ++side)
    {
      if (side != open)
      {
        room.addSide(
          box({ -0.001, -0.001, -0.001 }, { 4.001, 4.001, 3.001 }), side, 1, grey(0), true);
      }
    }
  }

  /// With glass if cells from `firstOfGlass` on stand in the opening.
  static void expect(const ObjectBuilder& spots, const ObjectBuilder& walls, int type,
    double sunAzimuth, double groundPart, const std::vector<double>& published,
    const std::string& what, std::size_t firstOfGlass = kNoGlass)
  {
    if (GetParam() && (type != 12 || firstOfGlass != kNoGlass))
    {
      return; // it would find the same, or does not know how panes mirror skies
    }
    SceneObject around = walls.build();
    if (firstOfGlass != kNoGlass)
    {
      makeSheets(around, firstOfGlass, { 0, {}, 1.52, .95842 });
    }
    const RadianceOf radiance = cieSky(type, sunAzimuth);
    const double horizontal = skyIrradiance(radiance, { 0, 0, 1 });
    Box lit = around.mesh().bounds();
    lit.inflate(0.1);
    const Sky sky = skyOf(lit, radiance, groundPart * horizontal / M_PI);
    const UpdatedEngine engine(
      { spots.build(), { around }, std::make_shared<Sky>(sky) }, settings(), ThreadExecution(2));
    double all = 0, allPublished = 0;
    for (std::size_t i = 0; i < published.size(); ++i)
    {
      const double told = 100 * engine.irradiance({ { 0, i }, 0 }, 0) / horizontal;
      // A place below the ceiling has some 300 samples that see the ground: .07 is their noise.
      EXPECT_NEAR(told, published[i], (kIsSanitized ? 3.5 : 1) * (0.15 + kPart * published[i]))
        << what << " of type " << type << ", place " << i;
      all += told;
      allPublished += published[i];
    }
    EXPECT_NEAR(all, allPublished, kPart / 5 * allPublished) << what << " of type " << type;
  }
};

TEST_P(Cie171Daylight, ThroughTheRoof59)
{
  const struct
  {
    int type;
    double opening;
    std::vector<double> published; ///< A to N
  } cases[] = {
    { 1, 1, { .46, 1.64, 2.34, 2.26, 1.88, 1.47, 2.34, 3.11, 3.84, 4.29, 4.29, 3.84, 3.11, 2.34 } },
    { 5, 1,
      { 1.04, 2.39, 2.59, 2.20, 1.70, 1.27, 1.96, 2.52, 3.05, 3.37, 3.37, 3.05, 2.52, 1.96 } },
    { 12, 1,
      { 1.74, 3.76, 4.55, 4.61, 4.24, 3.63, 5.72, 6.00, 5.11, 3.97, 2.90, 2.03, 1.40, .96 } },
    { 13, 1,
      { 1.61, 3.76, 4.87, 5.16, 4.89, 4.26, 6.76, 7.01, 5.79, 4.30, 2.98, 1.99, 1.30, .86 } },
    { 16, 1,
      { .56, 1.78, 2.32, 2.20, 1.82, 1.43, 2.29, 3.07, 3.82, 4.29, 4.29, 3.82, 3.07, 2.29 } },
    { 12, 4,
      { 67.28, 54.43, 44.20, 36.07, 29.52, 24.20, 42.28, 43.88, 43.49, 40.92, 35.90, 29.23, 22.57,
        16.80 } },
    { 16, 4,
      { 37.36, 32.14, 26.72, 21.75, 17.50, 14.03, 31.35, 36.74, 40.68, 42.74, 42.74, 40.68, 36.74,
        31.35 } },
  };
  for (const auto& one : cases)
  {
    ObjectBuilder spots, walls;
    addSpots(spots, 0, 0.25);
    addWalls(walls, 5);
    for (int i = 0; one.opening < 4 && i < 4; ++i)
    {
      const double low = -0.001, high = 4.001, size = high - low;
      const Vector3 corner(i == 3 ? 2.5 : low, i == 1 ? 2.5 : i == 0 ? low : 1.5, 3);
      walls.addQuad(
        corner, { 0, i < 2 ? 1.5 - low : 1, 0 }, { i < 2 ? size : 1.5 - low, 0, 0 }, 1, 1, grey(0));
    }
    expect(spots, walls, one.type, 0, 0, one.published, "roof " + std::to_string(one.opening));
  }
}

TEST_P(Cie171Daylight, ThroughAFacade511)
{
  const struct
  {
    int type;
    bool isWhole;                  ///< 4 x 3 m, or a window of 2 x 1 m
    std::vector<double> published; ///< A to N
  } cases[] = {
    { 1, false,
      { .95, 1.06, 1.25, 1.51, 1.70, 1.86, .87, 1.31, 2.02, 3.20, 5.07, 7.64, 9.32, 5.09 } },
    { 12, false,
      { .95, 1.06, 2.38, 4.93, 5.81, 5.01, 2.00, 2.80, 4.06, 6.13, 9.54, 14.56, 16.37, 5.03 } },
    { 12, true,
      { 7.20, 12.13, 16.24, 19.52, 22.11, 24.12, 9.26, 12.35, 16.78, 23.15, 32.07, 43.02, 54.31,
        64.84 } },
  };
  const double ceiling[2][8] = { { .38, .53, .75, 1.08, 1.56, 2.13, 2.40, 1.24 },
    { 1.74, 2.29, 3.06, 4.13, 5.62, 7.64, 10.24, 13.35 } };
  for (const auto& one : cases)
  {
    ObjectBuilder spots, walls;
    addSpots(spots, 4, 3.75);
    std::vector<double> published = one.published;
    for (int i = 0; i < 8; ++i)
    {
      addSpot(spots, { 2, 3.75 - 0.5 * i, 3 }, { 0, 1, 0 }, { 1, 0, 0 });
      published.push_back(ceiling[one.isWhole ? 1 : 0][i]);
    }
    addWalls(walls, 2);
    for (int i = 0; !one.isWhole && i < 4; ++i)
    {
      const double low = -0.001;
      const Vector3 corner(i == 3 ? 3 : low, 0, i == 1 ? 2 : i == 0 ? low : 1);
      walls.addQuad(corner, { 0, 0, 1.001 }, { i < 2 ? 4.002 : 1.001, 0, 0 }, 1, 1, grey(0));
    }
    expect(spots, walls, one.type, 180, 0.3, published, one.isWhole ? "open facade" : "window");
  }
}

// 5.10 and 5.12: with glass in the small roof and in the window. CIE's glass is a polynomial of the
// cosine of incidence (Tregenza and Sharples), of which a pane of T = .88 is within .5 % up to 75
// degrees.
TEST_P(Cie171Daylight, ThroughGlass510And512)
{
  const double low = -0.001;
  const std::pair<int, std::vector<double>> roofs[] = {
    { 1, { .15, 1.17, 1.91, 1.92, 1.62, 1.28, 2.04, 2.73, 3.38, 3.78, 3.78, 3.38, 2.73, 2.04 } },
    { 12, { .58, 2.65, 3.72, 3.93, 3.66, 3.16, 5.01, 5.28, 4.50, 3.49, 2.55, 1.79, 1.23, .84 } }
  };
  for (const auto& [type, published] : roofs)
  {
    ObjectBuilder spots, walls;
    addSpots(spots, 0, 0.25);
    addWalls(walls, 5);
    for (int i = 0; i < 4; ++i)
    {
      const Vector3 corner(i == 3 ? 2.5 : low, i == 1 ? 2.5 : i == 0 ? low : 1.5, 3);
      walls.addQuad(
        corner, { 0, i < 2 ? 1.501 : 1, 0 }, { i < 2 ? 4.002 : 1.501, 0, 0 }, 1, 1, grey(0));
    }
    const std::size_t glass = walls.numberOfCells();
    walls.addQuad({ 1.5, 1.5, 3 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1, grey(0));
    expect(spots, walls, type, 0, 0, published, "glazed roof", glass);
  }
  ObjectBuilder spots, walls;
  addSpots(spots, 4, 3.75);
  for (int i = 0; i < 8; ++i)
  {
    addSpot(spots, { 2, 3.75 - 0.5 * i, 3 }, { 0, 1, 0 }, { 1, 0, 0 });
  }
  addWalls(walls, 2);
  for (int i = 0; i < 4; ++i)
  {
    const Vector3 corner(i == 3 ? 3 : low, 0, i == 1 ? 2 : i == 0 ? low : 1);
    walls.addQuad(corner, { 0, 0, 1.001 }, { i < 2 ? 4.002 : 1.001, 0, 0 }, 1, 1, grey(0));
  }
  const std::size_t glass = walls.numberOfCells();
  walls.addQuad({ 1, 0, 1 }, { 0, 0, 1 }, { 2, 0, 0 }, 1, 1, grey(0));
  expect(spots, walls, 1, 180, 0.3,
    { .84, .94, 1.10, 1.33, 1.50, 1.63, .77, 1.15, 1.77, 2.78, 4.37, 6.43, 7.19, 2.16, .33, .46,
      .65, .94, 1.34, 1.80, 1.85, .52 },
    "glazed window", glass);
}

INSTANTIATE_TEST_SUITE_P(DirectLight, Cie171Daylight, testing::Bool(),
  [](const auto& info) { return info.param ? "FinalGather" : "Gathered"; });

}
}
