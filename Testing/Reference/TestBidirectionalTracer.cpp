// SPDX-License-Identifier: BSD-3-Clause
// The tracer against closed forms and against itself.
//
// An estimate is the mean of 32 independent passes. That it is off by more than 5 of its standard
// errors happens by chance once in 47,000 times (Student's t, 31 degrees of freedom); each test
// states how many values it compares. Seeds are fixed.
#include "../PhotonWalks/LambertContour.h"
#include "../PhotonWalks/TestScenes.h"
#include "../PhotonWalks/ThreadExecution.h"
#include "BidirectionalTracer.h"
#include "CameraRays.h"
#include "CellSensors.h"

#include <gtest/gtest.h>

#include <cstring>

using namespace irradiance;
using namespace pathtracedroom;

namespace
{

using test::grey;
using test::Look;
using test::ObjectBuilder;

constexpr int kPasses = 32;
constexpr double kLimit = 5;

/// The mean of all bins is one more bin: it shows a bias that is lost in the noise of each.
Estimates estimate(const SceneObjects& objects, const Sensor& sensor, std::uint32_t samples,
  const BidirectionalTracer::Config& config = {})
{
  const BidirectionalTracer tracer(objects, sensor, config);
  Estimates estimates(sensor.numberOfBins() + 1);
  Execution serial;
  for (std::uint64_t pass = 0; pass < kPasses; ++pass)
  {
    std::vector<Spectrum> bins = tracer.trace(pass, samples, serial);
    Spectrum sum = Spectrum::Zero();
    for (const Spectrum& bin : bins)
    {
      sum += bin;
    }
    bins.push_back(sum / static_cast<double>(bins.size()));
    estimates.add(bins);
  }
  return estimates;
}

void expectNear(const Estimates& estimates, std::size_t bin, int band, double truth)
{
  const double mean = estimates.mean(bin)[band], error = estimates.standardError(bin)[band];
  EXPECT_LE(std::abs(mean - truth), kLimit * error)
    << "bin " << bin << ", band " << band << ": " << mean << " +- " << error;
}

/// All bins have this value in these bands. Their mean has to be known with this relative
/// precision.
void expectAll(const Estimates& estimates, double truth, double precision, int bands)
{
  const std::size_t last = estimates.numberOfBins() - 1;
  for (std::size_t bin = 0; bin <= last; ++bin)
  {
    for (int band = 0; band < bands; ++band)
    {
      expectNear(estimates, bin, band, truth);
    }
  }
  EXPECT_LE(estimates.standardError(last).maxCoeff(), precision * truth);
}

void expectSame(const Estimates& a, const Estimates& b, const std::string& name)
{
  for (std::size_t bin = 0; bin < a.numberOfBins(); ++bin)
  {
    const double error =
      std::hypot(a.standardError(bin)[0], b.standardError(bin)[0]) + 1e-12 * a.mean(bin)[0];
    EXPECT_LE(std::abs(a.mean(bin)[0] - b.mean(bin)[0]), kLimit * error)
      << name << ", bin " << bin << ": " << a.mean(bin)[0] << " and " << b.mean(bin)[0] << " +- "
      << error;
  }
}

/// All cells of a scene.
std::vector<CellId> cellsOf(const SceneObjects& objects)
{
  std::vector<CellId> cells;
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    for (std::size_t cell = 0; cell < objects[object].material->numberOfCells; ++cell)
    {
      cells.push_back({ object, cell });
    }
  }
  return cells;
}

/// Emits what it does not reflect.
Look furnaceLook(
  const std::array<double, 3>& diffuse, const std::array<double, 3>& specular, double exponent)
{
  Look look{ diffuse, {}, specular, exponent };
  for (std::size_t band = 0; band < 3; ++band)
  {
    look.exitance[band] = 1 - diffuse[band] - specular[band];
  }
  return look;
}

const std::array<Look, 6> kFurnaceWalls = { furnaceLook({ 0.1, 0.5, 0.9 }, {}, 0),
  furnaceLook({ 0.3, 0.1, 0.2 }, { 0.4, 0.5, 0.1 }, 20),
  furnaceLook({}, { 0.7, 0.6, 0.5 }, kInfinity),
  furnaceLook({ 0.4, 0.1, 0.2 }, { 0.3, 0.4, 0.1 }, kInfinity),
  furnaceLook({}, { 0.8, 0.3, 0.5 }, 200), furnaceLook({ 0.6, 0.2, 0 }, {}, 0) };

/// A closed room with a ball: matt, glossy, mirror-like, and mixed; all colours differ.
SceneObjects furnace()
{
  ObjectBuilder room(3), ball(3);
  for (int side = 0; side < 6; ++side)
  {
    room.addSide(test::box({ 0, 0, 0 }, { 2, 2, 2 }), side, 1,
      kFurnaceWalls[static_cast<std::size_t>(side)], true);
  }
  ball.addSphere({ 0, 0, 0 }, 0.5, 3, furnaceLook({ 0.5, 0.2, 0.3 }, { 0.2, 0.3, 0.4 }, 5));
  return { room.build(), { ball.build(test::shift({ 1, 1, 1 })) } };
}

CameraRays smallCamera(const Vector3& position, const Vector3& lookedAt, double angle = 1)
{
  return CameraRays({ position, lookedAt - position, { 0, 0, 1 }, angle, 4, 3 });
}

}

// 3 bands of 13 and of 25 values: a false alarm in 0.3 %.
TEST(Furnace, EveryPixelHasTheRadianceOneOverPi)
{
  const SceneObjects objects = furnace();
  expectAll(
    estimate(objects, smallCamera({ 0.2, 0.3, 0.4 }, { 1, 1, 1 }), 128), 1 / M_PI, 0.005, 3);
}

TEST(Furnace, EveryCellReceivesOneWatt)
{
  const SceneObjects objects = furnace();
  expectAll(estimate(objects, CellIrradiance(objects, cellsOf(objects)), 64), 1, 0.01, 3);
}

// What the walls do not emit. 3 bands of 6 values: 0.04 %.
TEST(Furnace, EveryWallReflectsItsPart)
{
  const SceneObjects objects = furnace();
  std::vector<CellId> walls = cellsOf(objects);
  walls.resize(6);
  const Estimates estimates =
    estimate(objects, CellRadiance(objects, walls, { 0.2, 0.3, 0.4 }), 256);
  for (std::size_t wall = 0; wall < 6; ++wall)
  {
    for (std::size_t band = 0; band < 3; ++band)
    {
      expectNear(
        estimates, wall, static_cast<int>(band), (1 - kFurnaceWalls[wall].exitance[band]) / M_PI);
    }
  }
}

// A white box stands on the floor. No light gets in, and nothing absorbs what looks for it there.
TEST(Roulette, EndsBetweenWhiteWalls)
{
  ObjectBuilder floor, white;
  floor.addQuad({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 1, 1, grey(0.5));
  floor.addPointLight({ 0, 0, 2 }, 1);
  white.addBox(test::box({ -0.5, -0.5, 0.1 }, { 0.5, 0.5, 1 }), 1, grey(1));
  const SceneObjects objects{ floor.build(), { white.build() } };
  const Estimates estimates = estimate(objects, CellIrradiance(objects, { { 1, 5 } }), 16);
  const double truth = test::meanOverRectangle({ -0.5, -0.5, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, 40,
    [](const Vector3& p) { return 1 / (4 * M_PI * std::pow(1 + p[0] * p[0] + p[1] * p[1], 1.5)); });
  expectNear(estimates, 0, 0, truth); // of its upper side, which sees the lamp alone
}

namespace
{

/// The irradiance of a black cell in the light of a lamp of unit exitance.
void expectViewFactor(const Vector3& u, const Vector3& v, const Vector3& corner,
  const Vector3& lampU, const Vector3& lampV, double truth, std::uint32_t samples)
{
  ObjectBuilder builder;
  builder.addQuad({ 0, 0, 0 }, lampU, lampV, 1, 1, grey(0, 1));
  builder.addQuad(corner, u, v, 1, 1, grey(0));
  const SceneObjects objects{ builder.build(), {} };
  expectAll(estimate(objects, CellIrradiance(objects, { { 0, 1 } }), samples), truth, 0.005, 1);
}

}

// Howell's catalogue, C-11 and C-14, in exact figures of TestViewFactors. 14 values: 0.03 %.
TEST(ViewFactors, AlignedRectangles)
{
  const struct
  {
    double a, b, c, factor;
  } rows[] = { { 1, 1, 1, 0.19982490 }, { 1, 2, 0.5, 0.50898867 }, { 1, 1, 0.1, 0.82699452 } };
  for (const auto& [a, b, c, factor] : rows)
  {
    expectViewFactor({ 0, b, 0 }, { a, 0, 0 }, { 0, 0, c }, { a, 0, 0 }, { 0, b, 0 }, factor, 4000);
  }
}

TEST(ViewFactors, PerpendicularRectangles)
{
  const struct
  {
    double h, w, l, factor;
  } rows[] = { { 1, 1, 1, 0.20004378 }, { 1, 2, 1, 0.11642630 }, { 2, 1, 1, 0.23285260 },
    { 0.01, 1, 1, 4.89584927e-3 } };
  for (const auto& [h, w, l, factor] : rows)
  {
    expectViewFactor({ 0, l, 0 }, { 0, 0, h }, { 0, 0, 0 }, { w, 0, 0 }, { 0, l, 0 },
      factor * w / h, 4000); // by reciprocity
  }
}

// CIE 171:2006, 5.7: a shining wall behind an obstruction; strips of the opposite wall. 7 values.
TEST(Cie171, DiffuseReflectionWithObstruction57)
{
  const double heights[] = { 2.75, 2.25, 1.75, 1.25, 0.75, 0.25 };
  ObjectBuilder room, obstruction;
  std::vector<double> truth;
  for (const double z : heights)
  {
    room.addQuad({ 4, 0, z - 0.25 }, { -4, 0, 0 }, { 0, 0, 0.5 }, 1, 1, grey(0));
    truth.push_back(test::meanOverRectangle(
      { 0, 0, z - 0.25 }, { 4, 0, 0 }, { 0, 0, 0.5 }, 40, [](const Vector3& p) {
        const double edge = p[2] < 1 ? 2.5 : 2.7; // of the obstruction, over which the lamp is seen
        const double seenFrom = std::max(0.0, p[2] + (1 - p[2]) * 4 / edge);
        return 100 *
          test::lambertIrradiance(
            p, { 0, 1, 0 }, { { 0, 4, seenFrom }, { 4, 4, seenFrom }, { 4, 4, 3 }, { 0, 4, 3 } });
      }));
  }
  room.addQuad({ 0, 4, 0 }, { 4, 0, 0 }, { 0, 0, 3 }, 1, 1, grey(0, 100));
  obstruction.addBox(test::box({ 0, 2.5, 0 }, { 4, 2.7, 1 }), 1, grey(0));
  const SceneObjects objects{ room.build(), { obstruction.build() } };
  std::vector<CellId> cells = cellsOf(objects);
  cells.resize(6);
  const Estimates estimates = estimate(objects, CellIrradiance(objects, cells), 2048);
  for (std::size_t i = 0; i < 6; ++i)
  {
    expectNear(estimates, i, 0, truth[i]);
    EXPECT_LE(estimates.standardError(i)[0], 0.01 * truth[i]);
  }
}

// 5.8: a point light in a cube. The mean over the walls has a closed form; the centre of a wall is
// that of an independent program (indirect) plus the mean of the inverse square law (direct). 8
// values.
TEST(Cie171, InternalReflectedComponent58)
{
  constexpr std::size_t kCells = 15;
  const struct
  {
    double reflectance, center;
  } rows[] = { { 0.5, 112.04 }, { 0.8, 431.1 } };
  const double edge = 4.0 / kCells;
  const double direct =
    test::meanOverRectangle({ 2, -edge / 2, -edge / 2 }, { 0, edge, 0 }, { 0, 0, edge }, 20,
      [](const Vector3& p) { return 10000 * 2 / (4 * M_PI * std::pow(p.norm(), 3)); });
  for (const auto& [reflectance, center] : rows)
  {
    ObjectBuilder builder;
    for (int side = 0; side < 6; ++side)
    {
      builder.addSide(test::box({ -2, -2, -2 }, { 2, 2, 2 }), side, side == 1 ? int{ kCells } : 1,
        grey(reflectance), true);
    }
    builder.addPointLight({ 0, 0, 0 }, 10000);
    const SceneObjects objects{ builder.build(), {} };
    const std::size_t middle = 1 + kCells * kCells / 2, fine = kCells * kCells;
    const Estimates estimates = estimate(objects,
      CellIrradiance(
        objects, { { 0, 0 }, { 0, fine + 1 }, { 0, fine + 2 }, { 0, fine + 3 }, { 0, fine + 4 } }),
      128);
    expectNear(estimates, 5, 0, 10000 / (96 * (1 - reflectance)));
    EXPECT_LE(estimates.standardError(5)[0], 0.01 * estimates.mean(5)[0]);
    const Estimates atCenter = estimate(objects, CellIrradiance(objects, { { 0, middle } }), 1000);
    expectNear(atCenter, 0, 0, direct + center);
    EXPECT_LE(atCenter.standardError(0)[0], 0.01 * atCenter.mean(0)[0]);
  }
}

namespace
{

/// Plates that do not touch, so that each strategy has a finite variance: a lamp over a floor with
/// a tilted sheet between, which is seen from both sides.
SceneObjects plates(const Look& floor, const Look& sheet)
{
  ObjectBuilder builder, moving;
  builder.addQuad({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 1, 1, floor);
  builder.addQuad({ -0.8, -0.8, 2 }, { 0, 1.6, 0 }, { 1.6, 0, 0 }, 1, 1, grey(0.3, 10));
  moving.addQuad({ 0, 0, 0 }, { 1, 0, 0.3 }, { 0, 1, 0 }, 1, 1, sheet);
  return { builder.build(), { moving.build(test::shift({ -0.6, -0.5, 0.8 })) } };
}

BidirectionalTracer::Config only(std::function<bool(int, int)> isUsed)
{
  BidirectionalTracer::Config config;
  config.seed = 2; // independent of what it is compared with
  config.isUsed = std::move(isUsed);
  return config;
}

BidirectionalTracer::Config ofLength(int vertices)
{
  BidirectionalTracer::Config config;
  config.isUsed = [vertices](int s, int t) { return s + t == vertices; };
  return config;
}

/// Each way to find the paths of 2 to 4 vertices, alone and so without weights, against all
/// together.
void expectStrategiesAgree(const SceneObjects& objects, const Sensor& sensor, std::uint32_t samples)
{
  for (int vertices = 2; vertices <= 4; ++vertices)
  {
    const Estimates all = estimate(objects, sensor, samples, ofLength(vertices));
    for (int t = sensor.sharedEyeVertices(); t <= vertices; ++t)
    {
      const auto isUsed = [t, vertices](
                            int light, int eye) { return eye == t && light + eye == vertices; };
      expectSame(estimate(objects, sensor, samples, only(isUsed)), all,
        std::to_string(vertices - t) + " light and " + std::to_string(t) + " eye vertices");
    }
  }
}

}

// 9 strategies of 13 pixels, 12 of 4 cells: a false alarm in 0.4 %.
TEST(Strategies, EachAloneShowsTheSamePixels)
{
  expectStrategiesAgree(
    plates(grey(0.6), grey(0.8)), smallCamera({ 0, -3, 1.5 }, { 0, 0, 0.5 }, 0.4), 256);
}

TEST(Strategies, EachAloneLightsTheSameCells)
{
  const SceneObjects objects = plates(grey(0.6), grey(0.8));
  expectStrategiesAgree(objects, CellIrradiance(objects, cellsOf(objects)), 512);
}

namespace
{

/// Path tracing with connections to lamps, light tracing, and both together, with all path lengths.
void expectTracersAgree(const SceneObjects& objects, const Sensor& sensor, std::uint32_t samples)
{
  const Estimates both = estimate(objects, sensor, samples);
  expectSame(
    estimate(objects, sensor, 2 * samples, only([](int s, int) { return s <= 1; })), both, "eye");
  expectSame(
    estimate(objects, sensor, 2 * samples, only([](int, int t) { return t <= 1; })), both, "light");
}

}

// 26 pixels and 10 cells: 0.08 %. The glossy floor is lit by a point light, too.
TEST(Strategies, PathTracingAndLightTracingAgree)
{
  Look glossy = grey(0.3);
  glossy.specular = { 0.5, 0.5, 0.5 };
  glossy.exponent = 10;
  SceneObjects objects = plates(glossy, grey(0.8));
  ObjectBuilder light;
  light.addPointLight({ 0, 0, 0 }, 20);
  objects.dynamicObjects.push_back(light.build(test::shift({ 1.2, 0.3, 1.5 })));
  expectTracersAgree(objects, smallCamera({ 0, -3, 1.5 }, { 0, 0, 0.5 }, 0.4), 256);
  expectTracersAgree(objects, CellIrradiance(objects, cellsOf(objects)), 512);
}

namespace
{

/// The part x >= 0 of a room, or x <= 0, without the wall in the middle.
void addHalf(ObjectBuilder& builder, bool isLeft, bool hasPoint)
{
  const Box half =
    isLeft ? test::box({ -1, 0, 0 }, { 0, 2, 2 }) : test::box({ 0, 0, 0 }, { 1, 2, 2 });
  builder.addSide(half, isLeft ? 0 : 1, 1, grey(0.7), true);
  for (int side = 2; side < 6; ++side)
  {
    builder.addSide(half, side, 1, grey(0.1 * side), true);
  }
  builder.addQuad(
    { isLeft ? -0.6 : 0.2, 0.5, 1.6 }, { 0, 0.5, 0 }, { 0.4, 0, 0 }, 1, 1, grey(0.5, 10));
  if (hasPoint)
  {
    builder.addPointLight({ isLeft ? -0.7 : 0.7, 1.5, 0.6 }, 5);
  }
}

/// The two rooms.
std::pair<SceneObjects, SceneObjects> mirrored(bool hasPoint)
{
  ObjectBuilder half, whole;
  addHalf(half, false, hasPoint);
  addHalf(whole, false, hasPoint);
  addHalf(whole, true, hasPoint);
  Look mirror;
  mirror.specular = { 1, 1, 1 };
  half.addSide(test::box({ 0, 0, 0 }, { 1, 2, 2 }), 0, 1, mirror, true);
  return { { half.build(), {} }, { whole.build(), {} } };
}

}

// A room with a mirror for a wall is half of a room twice as large. 6 walls and 13 pixels: 0.04 %.
TEST(Mirror, DoublesTheLightOfTheRoom)
{
  const auto [half, whole] = mirrored(true);
  const std::vector<CellId> walls = { { 0, 0 }, { 0, 1 }, { 0, 2 }, { 0, 3 }, { 0, 4 } };
  expectSame(estimate(half, CellIrradiance(half, walls), 256),
    estimate(whole, CellIrradiance(whole, walls), 256, only({})), "walls");
}

// Without the point light: of what it sends by way of the mirror to a wall, and from there by way
// of the mirror into the pinhole, no strategy finds anything.
TEST(Mirror, ShowsTheRoomTwice)
{
  const auto [half, whole] = mirrored(false);
  const CameraRays camera = smallCamera({ 0.9, 0.2, 0.5 }, { 0, 1, 1 });
  expectSame(estimate(half, camera, 128), estimate(whole, camera, 128, only({})), "pixels");
}

namespace
{

std::vector<Spectrum> traced(
  const SceneObjects& objects, const Sensor& sensor, TraversalMode mode, Execution& execution)
{
  BidirectionalTracer::Config config;
  config.traversal = mode;
  return BidirectionalTracer(objects, sensor, config).trace(0, 150, execution);
}

void expectSameBits(const SceneObjects& objects, const Sensor& sensor)
{
  Execution serial;
  test::ThreadExecution threads(3);
  test::BackwardExecution backward;
  const std::vector<Spectrum> one = traced(objects, sensor, TraversalMode::Parallel, serial);
  const auto expectThose = [&](const std::vector<Spectrum>& other) {
    EXPECT_EQ(std::memcmp(one.data(), other.data(), one.size() * sizeof(Spectrum)), 0);
  };
  expectThose(traced(objects, sensor, TraversalMode::Parallel, threads));
  expectThose(traced(objects, sensor, TraversalMode::Parallel, backward));
  expectThose(traced(objects, sensor, TraversalMode::Sequential, serial));
  expectThose(traced(objects, sensor, TraversalMode::OneTree, serial));
}

}

TEST(SameBits, ForAllThreadsAndTraversals)
{
  const SceneObjects objects = furnace();
  expectSameBits(objects, smallCamera({ 0.2, 0.3, 0.4 }, { 1, 1, 1 }));
  expectSameBits(objects, CellIrradiance(objects, cellsOf(objects)));
}
