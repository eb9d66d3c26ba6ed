/**
 * What verification costs when a scene has far things, and when many things move: a small ball that
 * moves in a room of 4 m, with another ball near, 1 km away, or back from there; with a light or a
 * lamp that is far; and 8 to 1000 balls that all move. The cases take turns, frame by frame, and
 * before any time counts each of them has to have the sums of a fresh engine. One thread, CPU time.
 *
 * Arguments: [walks = 200000] [frames = 25]
 */
#include "../PhotonWalks/TestScenes.h"
#include "CpuTime.h"
#include "IrradianceEngine.h"
#include "Program.h"
#include "Results.h"

#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

using namespace irradiance;

namespace
{

constexpr double kKilometre = 1000;
const Vector3 kMiddle(2, 2, 2);

/// A room without a ceiling, a lamp and a point light.
SceneObject makeRoom(const Vector3& light, double lampHeight)
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
  return room.build();
}

SceneObject makeBall(double radius)
{
  test::ObjectBuilder ball;
  ball.addSphere({ 0, 0, 0 }, radius, 6, test::grey(0.5));
  return ball.build();
}

/// A scene, frame by frame, and the engine that follows it.
struct Follower
{
  Follower(const SceneObjects& start, const EngineSettings& ownSettings)
    : objects(start)
    , settings(ownSettings)
  {
  }

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

  /// Seconds of CPU time. The engine's own clocks are those on the wall: only their ratio is used.
  double verify()
  {
    const double start = execution.seconds();
    engine.update(objects, settings, execution);
    const EngineStatistics& cost = engine.statistics();
    return (execution.seconds() - start) * cost.verifySeconds /
      (cost.repairSeconds + cost.verifySeconds);
  }

  void check() const
  {
    IrradianceEngine fresh;
    Execution serial;
    fresh.update(objects, settings, serial);
    for (std::uint32_t object = 0; object < objects.size(); ++object)
    {
      for (std::size_t cell = 0; cell < objects[object].material->numberOfCells; ++cell)
      {
        if (engine.sums().sum(object, cell, 0, 0) != fresh.sums().sum(object, cell, 0, 0))
        {
          throw std::runtime_error("The update differs from a fresh engine");
        }
      }
    }
  }

  SceneObjects objects;
  EngineSettings settings;
  std::vector<Vector3> places; ///< of the small balls
  CpuTime execution;
  IrradianceEngine engine;
};

struct Case
{
  std::string name;
  std::unique_ptr<Follower> follower;
  std::vector<double> seconds;
};

/// One small ball moves, another ball rests where it is put in turn.
Case farCase(const std::string& name, const EngineSettings& settings, const Vector3& light,
  double lampHeight, const std::vector<Vector3>& stops)
{
  constexpr double kSmall = 0.1, kLarge = 0.25;
  auto follower = std::make_unique<Follower>(
    SceneObjects{ makeRoom(light, lampHeight), { makeBall(kSmall), makeBall(kLarge) } }, settings);
  follower->places = { kMiddle };
  follower->move(0);
  for (const Vector3& stop : stops)
  {
    follower->objects.dynamicObjects[1].worldFromObject = test::shift(stop);
    follower->verify();
  }
  return { name, std::move(follower), {} };
}

Case manyCase(int count, const EngineSettings& settings)
{
  constexpr double kRadius = 0.04;
  auto follower =
    std::make_unique<Follower>(SceneObjects{ makeRoom({ 3, 1, 2 }, 3.5), {} }, settings);
  const SceneObject ball = makeBall(kRadius);
  // Spread evenly (Roberts 2018: the generalized golden ratio).
  const Vector3 step(0.8191725134, 0.6710436067, 0.5497004779);
  for (int i = 0; i < count; ++i)
  {
    const Vector3 unit = (i * step).unaryExpr([](double x) { return x - std::floor(x); });
    follower->places.push_back(Vector3(Vector3::Constant(0.4) + 3.0 * unit));
    follower->objects.dynamicObjects.push_back(ball);
  }
  follower->move(0);
  follower->verify();
  return { std::to_string(count), std::move(follower), {} };
}

void follow(std::vector<Case>& cases, int frames)
{
  for (int frame = 1; frame <= frames + 1; ++frame)
  {
    for (Case& one : cases)
    {
      one.follower->move(frame);
      const double seconds = one.follower->verify();
      if (frame == 1)
      {
        one.follower->check(); // and warmed up
      }
      else
      {
        one.seconds.push_back(seconds);
      }
    }
  }
}

std::vector<double> scaled(const std::vector<double>& values, double factor)
{
  std::vector<double> scaled;
  for (const double value : values)
  {
    scaled.push_back(factor * value);
  }
  return scaled;
}

void timeFarThings(const EngineSettings& settings, int frames, Results& results)
{
  const Vector3 light(3, 1, 2), rest(3, 3, 1), away = kKilometre * Vector3(0.6, 0, 0.8);
  constexpr double kLamp = 3.5;
  std::vector<Case> cases;
  cases.push_back(farCase("all near", settings, light, kLamp, { rest }));
  cases.push_back(farCase("ball went 1 km away", settings, light, kLamp, { rest, away }));
  cases.push_back(farCase("ball shot 1 km away", settings, light, kLamp, { away }));
  cases.push_back(
    farCase("ball came back from 1 km", settings, light, kLamp, { rest, away, rest }));
  cases.push_back(farCase("point light 1 km away", settings, away, kLamp, { rest }));
  cases.push_back(farCase("point light 100 km away", settings, 100 * away, kLamp, { rest }));
  cases.push_back(farCase("lamp 1 km away", settings, light, kKilometre, { rest }));
  cases.push_back(farCase("lamp 100 km away", settings, light, 100 * kKilometre, { rest }));
  follow(cases, frames);
  for (const Case& one : cases)
  {
    const auto segments = static_cast<double>(one.follower->engine.balance().segments);
    results.add("FarThings", one.name, "ms", scaled(one.seconds, 1e3));
    results.add("FarThings", one.name, "ns a segment", scaled(one.seconds, 1e9 / segments));
    results.add("FarThings", one.name, "time / all near", ratios(one.seconds, cases[0].seconds));
  }
}

void timeManyThings(const EngineSettings& settings, int frames, Results& results)
{
  std::vector<Case> cases;
  for (const int count : { 1, 8, 9, 64, 65, 200, 512, 513, 1000 })
  {
    cases.push_back(manyCase(count, settings));
  }
  follow(cases, frames);
  const auto each = [](const Case& one) {
    return scaled(
      one.seconds, 1e3 / static_cast<double>(one.follower->objects.dynamicObjects.size()));
  };
  for (const Case& one : cases)
  {
    results.add("ManyThings", one.name, "ms", scaled(one.seconds, 1e3));
    results.add("ManyThings", one.name, "ms each", each(one));
    results.add("ManyThings", one.name, "each / each of 8", ratios(each(one), each(cases[1])));
  }
}

void run(int argc, char* argv[])
{
  EngineSettings settings;
  settings.numberOfWalks =
    argc > 1 ? static_cast<std::uint32_t>(std::strtoul(argv[1], nullptr, 10)) : 200000;
  const int frames = argc > 2 ? std::atoi(argv[2]) : 25;
  Results results("BenchmarkFarAndMany");
  timeFarThings(settings, frames, results);
  timeManyThings(settings, frames, results);
  results.finish();
}

}

int main(int argc, char* argv[])
{
  return runProgram(run, argc, argv);
}
