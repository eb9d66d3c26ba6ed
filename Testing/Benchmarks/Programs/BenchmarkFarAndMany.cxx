// SPDX-License-Identifier: BSD-3-Clause
/**
 * What verification costs when a scene has far objects, and when many objects move: a small ball
 * that moves in a room of 4 m, with another ball, a light or a lamp that is far; and 1 to 1000
 * balls that all move. The cases take turns, frame by frame, and before any time counts each of
 * them has to have the answer of a fresh engine. One thread, CPU time.
 *
 * Arguments: [walks = 200000] [frames = 25]
 */
#include "../../PhotonWalks/TestScenes.h"
#include "Measuring/EngineTiming.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"

#include <algorithm>
#include <cmath>
#include <list>

using namespace irradiance;

namespace
{

constexpr double kKilometre = 1000;

const Vector3 kLight(3, 1, 2);
constexpr double kLampHeight = 3.5;
constexpr int kBallSegments = 6;
constexpr double kSmallBall = 0.04;

/// A room without a ceiling, a lamp and a point light, and small balls that stay.
SceneObject makeRoom(
  const Vector3& light, double lampHeight, const std::vector<Vector3>& balls = {})
{
  constexpr int kWalls = 5, kCells = 8;
  test::ObjectBuilder room;
  for (int side = 0; side < kWalls; ++side)
  {
    room.addSide(test::box({ 0, 0, 0 }, { 4, 4, 4 }), side, kCells, test::grey(0.5), true);
  }
  room.addQuad({ 1, 1, 3.75 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1, test::grey(0, 1));
  room.addQuad({ 2, 2, lampHeight }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1, test::grey(0, 1));
  room.addPointLight(light, 1);
  for (const Vector3& center : balls)
  {
    room.addSphere(center, kSmallBall, kBallSegments, test::grey(0.5));
  }
  return room.build();
}

SceneObject makeBall(double radius)
{
  test::ObjectBuilder ball;
  ball.addSphere({ 0, 0, 0 }, radius, kBallSegments, test::grey(0.5));
  return ball.build();
}

/// A scene, frame by frame, and the engine that follows it.
struct Case
{
  /// The small balls circle, each around its own place.
  void move(int frame)
  {
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      const double angle = 0.3 * frame + static_cast<double>(i);
      objects.dynamicObjects[i].worldFromObject =
        test::shift(places[i] + 0.1 * Vector3(std::cos(angle), std::sin(angle), 0));
    }
  }

  void verify(const EngineSettings& settings)
  {
    seconds = timeUpdate(engine, objects, settings).verification;
  }

  std::string name;
  SceneObjects objects;
  std::vector<Vector3> places; ///< of the small balls
  IrradianceEngine engine;
  double seconds; ///< of the verification of this frame
};

using Cases = std::list<Case>; // an engine stays where it is

/// One small ball moves, another ball rests where it is put in turn.
void addFarCase(Cases& cases, const char* name, const EngineSettings& settings,
  const Vector3& light, double lampHeight, const std::vector<Vector3>& stops)
{
  constexpr double kSmall = 0.1, kLarge = 0.25;
  Case& one = cases.emplace_back();
  one.name = name;
  one.objects = { makeRoom(light, lampHeight), { makeBall(kSmall), makeBall(kLarge) } };
  one.places = { Vector3(2, 2, 2) };
  one.move(0);
  for (const Vector3& stop : stops)
  {
    one.objects.dynamicObjects[1].worldFromObject = test::shift(stop);
    one.verify(settings);
  }
}

void addManyCase(Cases& cases, std::size_t count, const EngineSettings& settings)
{
  Case& one = cases.emplace_back();
  one.name = std::to_string(count);
  one.objects = { makeRoom(kLight, kLampHeight), { count, makeBall(kSmallBall) } };
  // Spread evenly (Roberts 2018: the generalized golden ratio).
  const Vector3 step(0.8191725134, 0.6710436067, 0.5497004779);
  while (one.places.size() < count)
  {
    const Vector3 unit = (static_cast<double>(one.places.size()) * step).unaryExpr([](double x) {
      return x - std::floor(x);
    });
    one.places.push_back(Vector3(Vector3::Constant(0.4) + 3.0 * unit));
  }
  one.move(0);
  one.verify(settings);
}

/// Calls `reportFrame` for each case in each frame. The first frame warms up and is checked.
template <class ReportFrame>
void follow(
  Cases& cases, const EngineSettings& settings, int frames, const ReportFrame& reportFrame)
{
  for (int frame = 0; frame <= frames; ++frame)
  {
    for (Case& one : cases)
    {
      one.move(frame + 1);
      one.verify(settings);
      if (frame == 0)
      {
        IrradianceEngine fresh;
        timeUpdate(fresh, one.objects, settings);
        requireEqualAnswers(one.engine, fresh, one.objects);
      }
    }
    if (frame > 0)
    {
      std::for_each(cases.begin(), cases.end(), reportFrame);
    }
  }
}

void timeFarThings(const EngineSettings& settings, int frames)
{
  const Vector3 light = kLight, rest(3, 3, 1), away = kKilometre * Vector3(0.6, 0, 0.8);
  constexpr double kLamp = kLampHeight;
  Cases cases;
  addFarCase(cases, "all near", settings, light, kLamp, { rest });
  addFarCase(cases, "ball went 1 km away", settings, light, kLamp, { rest, away });
  addFarCase(cases, "ball shot 1 km away", settings, light, kLamp, { away });
  addFarCase(cases, "ball came back from 1 km", settings, light, kLamp, { rest, away, rest });
  addFarCase(cases, "point light 1 km away", settings, away, kLamp, { rest });
  addFarCase(cases, "point light 100 km away", settings, 100 * away, kLamp, { rest });
  addFarCase(cases, "lamp 1 km away", settings, light, kKilometre, { rest });
  addFarCase(cases, "lamp 100 km away", settings, light, 100 * kKilometre, { rest });
  follow(cases, settings, frames, [&](const Case& one) {
    const auto segments = static_cast<double>(one.engine.balance().segments);
    report("FarThings", one.name, "ms", 1e3 * one.seconds);
    report("FarThings", one.name, "ns a segment", 1e9 * one.seconds / segments);
    report("FarThings", one.name, "time / all near", one.seconds / cases.front().seconds);
  });
}

void timeManyThings(const EngineSettings& settings, int frames)
{
  Cases cases;
  for (const std::size_t count : { 1, 8, 9, 64, 128, 129, 200, 500, 1000 })
  {
    addManyCase(cases, count, settings);
  }
  const Case& eight = *std::next(cases.begin());
  follow(cases, settings, frames, [&](const Case& one) {
    const auto each = [&](const Case& any) {
      return any.seconds / static_cast<double>(any.places.size());
    };
    report("ManyThings", one.name, "ms", 1e3 * one.seconds);
    report("ManyThings", one.name, "ms each", 1e3 * each(one));
    report("ManyThings", one.name, "each / each of 8", each(one) / each(eight));
  });
}

/// First shooting beside many objects that may move, by turns in fresh engines: each object with a
/// tree of its own, all in one tree over single triangles, and the same triangles among the static
/// ones.
void timeManyShootings(const EngineSettings& settings, int rounds)
{
  Cases cases;
  for (const std::size_t count : { 1, 9, 64, 200, 1000 })
  {
    addManyCase(cases, count, settings);
  }
  for (int round = 0; round < rounds; ++round)
  {
    double first = 0;
    for (const Case& one : cases)
    {
      SceneObjects flattened = one.objects;
      for (SceneObject& object : flattened.dynamicObjects)
      {
        object.isFlattened = true;
      }
      const SceneObjects allStatic{ makeRoom(kLight, kLampHeight, one.places), {} };
      const std::pair<const char*, const SceneObjects*> ways[] = { { "instanced", &one.objects },
        { "flattened", &flattened }, { "static", &allStatic } };
      for (const auto& [way, objects] : ways)
      {
        IrradianceEngine engine;
        timeUpdate(engine, *objects, settings);
        const double seconds =
          engine.statistics().shootSeconds / static_cast<double>(engine.balance().segments);
        first = first == 0 ? seconds : first;
        report("ManyShootings", one.name, std::string(way) + ", ns a segment", 1e9 * seconds);
        report("ManyShootings", one.name, std::string(way) + " / one instanced", seconds / first);
      }
    }
  }
}

}

void run(const Arguments& arguments)
{
  EngineSettings settings;
  settings.numberOfWalks = arguments.number(0, 200000u);
  const int frames = arguments.number(1, 25);
  timeFarThings(settings, frames);
  timeManyThings(settings, frames);
  timeManyShootings(settings, (frames + 4) / 5);
}
