// SPDX-License-Identifier: BSD-3-Clause
#include "Features.h"
#include "Sheets.h"
#include "Skies.h"

#include "Views/StoredSensors.h"
#include "Views/WalkPaths.h"

namespace irradiance::test
{
namespace
{

constexpr int kFrames = kIsSanitized ? 4 : 6;

/// Motions of all kinds.
std::function<Film()> moving(const EngineSettings& settings, int bands, bool isClosed,
  unsigned seed, bool isGlossy = false, bool hasSky = false)
{
  return [=] {
    MovingScene scene(bands, isClosed, seed, isGlossy);
    Film film;
    for (int frame = 0; frame < kFrames; ++frame, scene.nextFrame())
    {
      film.push_back({ hasSky ? underSky(scene.objects()) : scene.objects(), settings });
    }
    return film;
  };
}

/// Objects get other reflectances, the room as well if `paintsRoom`, while things move or rest. In
/// the end all look as they did.
std::function<Film()> painting(const EngineSettings& settings, int bands, unsigned seed,
  bool isGlossy = false, bool paintsRoom = true)
{
  return [=] {
    MovingScene scene(bands, true, seed, isGlossy);
    RandomVectors random(seed);
    const SceneObjects first = scene.objects();
    SceneObjects painted = first;
    Film film;
    for (int frame = 0; frame < kFrames; ++frame)
    {
      SceneObjects objects = scene.objects();
      for (std::size_t i = 0; i < objects.dynamicObjects.size(); ++i)
      {
        objects.dynamicObjects[i].material = painted.dynamicObjects[i].material;
      }
      objects.staticObject.material = painted.staticObject.material;
      film.push_back({ objects, settings });
      frame % 2 == 0 ? scene.nextFrame() : void();
      const bool isGloss = isGlossy && random.engine() % 4 > 0;
      paint(painted.dynamicObjects[random.engine() % 6], random, isGloss);
      paintsRoom ? paint(painted.staticObject, random, isGloss) : void();
      painted = frame == kFrames - 2 ? first : painted;
    }
    return film;
  };
}

/// The number of walks rises and falls while things move and are painted. There is one source.
std::function<Film()> resizing(const EngineSettings& settings, int bands)
{
  return [=] {
    RandomVectors random(61);
    SceneObjects objects{ litRoom(4, bands).build(),
      { ball({}, 0.4, 4, grey(0.5), bands),
        block({ 3, 3, 0.3 }, { 0.3, 0.2, 0.3 }, 1, grey(0.5), bands) } };
    Film film;
    for (const double times : { 1.0, 2.0, 2.1, 0.7, 1.0, 1.0 })
    {
      const bool isMoving = film.size() % 3 > 0, isPainted = film.size() % 2 > 0;
      objects.dynamicObjects[0].worldFromObject.translation =
        isMoving ? Vector3(random.uniform(1, 3), 1.5, 1) : Vector3(2, 1.5, 1);
      isPainted ? paint(objects.staticObject, random) : void();
      film.push_back({ objects, settings });
      film.back().settings.numberOfWalks =
        static_cast<std::uint32_t>(times * settings.numberOfWalks);
    }
    return film;
  };
}

/// Parts of a room come, go in the midst of others, and become things that move, and back. In the
/// end one touches the lamp, if `touchesLamp`.
std::function<Film()> rebuilding(
  const EngineSettings& settings, int bands, bool touchesLamp = false)
{
  return [=] {
    const Look look = grey(0.6);
    const SceneObject room = litRoom(3, bands).build(),
                      cupboard = block({ 0.5, 3, 0.9 }, { 0.3, 0.5, 0.9 }, 2, look, bands),
                      shelf = block({ 2.5, 2, 0.7 }, { 0.5, 0.4, 0.2 }, 2, look, bands),
                      lid = block({ 1.8, 2, 2.8 }, { 0.2, 0.2, 0.1 }, 1, look, bands);
    SceneObject globe = ball({ 3.3, 0.7, 0.5 }, 0.3, 4, look, bands),
                mover = block({ 2, 1.5, 1.6 }, { 0.3, 0.2, 0.3 }, 1, look, bands);
    Film film;
    SceneObjects objects{ nothing(bands), {} };
    const auto show = [&](const std::vector<SceneObject>& statics,
                        const std::vector<SceneObject>& dynamics) {
      objects = { merged(statics, objects.staticObject), dynamics };
      film.push_back({ objects, settings });
    };
    show({ room, cupboard }, { mover });
    show({ room, cupboard, shelf }, { mover });
    mover.worldFromObject.translation[1] += 0.4;
    show({ room, shelf, globe }, { mover });
    show({ room, shelf }, { mover, globe });
    globe.worldFromObject.translation[2] += 0.5;
    show({ room, shelf }, { mover, globe });
    touchesLamp ? show({ room, lid, globe, shelf }, { mover })
                : show({ room, globe, shelf }, { mover });
    show({ room }, { mover });
    return film;
  };
}

/// A random program of all changes.
std::function<Film()> changing(const EngineSettings& settings, int bands, unsigned seed)
{
  return [=] {
    RandomVectors random(seed);
    const auto below = [&](std::size_t count) { return random.engine() % count; };
    const auto newPart = [&] {
      const Vector3 size(0.1 + 0.1 * double(below(4)), 0.2, 0.1 + 0.1 * double(below(4)));
      return block(Vector3(2, 2, 1.4) + 1.2 * random.inCube(), size, 1, grey(0.5), bands);
    };
    std::vector<SceneObject> statics{ litRoom(3, bands).build(), newPart() }, dynamics{ newPart() };
    FilmFrame frame{ { nothing(bands), {} }, settings };
    Film film;
    for (int step = 0; step < 3 * kFrames; ++step)
    {
      frame.objects = { merged(statics, frame.objects.staticObject), dynamics };
      film.push_back(frame);
      for (std::size_t changes = 1 + below(2); changes > 0; --changes)
      {
        switch (below(7))
        {
          case 0:
            dynamics[below(dynamics.size())].worldFromObject.translation =
              Vector3(2, 2, 1.4) + 1.2 * random.inCube();
            break;
          case 1:
            paint(statics[below(statics.size())], random);
            break;
          case 2:
            paint(dynamics[below(dynamics.size())], random);
            break;
          case 3:
            statics.insert(
              statics.begin() + 1 + static_cast<int>(below(statics.size())), newPart());
            break;
          case 4:
            if (statics.size() > 1)
            {
              below(2) == 0 ? dynamics.push_back(statics[1]) : void();
              statics.erase(statics.begin() + 1);
            }
            break;
          case 5:
            if (dynamics.size() > 1)
            {
              statics.push_back(dynamics.back());
              dynamics.pop_back();
            }
            break;
          default:
            frame.settings.numberOfWalks =
              static_cast<std::uint32_t>((1 + 0.5 * double(below(3))) * settings.numberOfWalks);
        }
      }
    }
    return film;
  };
}

/// An object goes from place to place.
Film going(SceneObjects objects, const EngineSettings& settings, const std::vector<Vector3>& places)
{
  Film film;
  for (const Vector3& place : places)
  {
    objects.dynamicObjects[0].worldFromObject = shift(place);
    film.push_back({ objects, settings });
  }
  return film;
}

/// The less light the shade leaves, the more walks.
std::function<Film()> shaded(const EngineSettings& settings)
{
  return [=] {
    Film film;
    for (const double height : { 1.5, 0.1, 0.12, 1.0, 0.05, 1.7, 0.2, 0.15 })
    {
      film.push_back({ shadedRoom(height), settings });
      // The dial is turned as well.
      film.back().settings.targetRelativeError *= film.size() % 4 == 0 ? 1.5 : 1;
    }
    return film;
  };
}

/// Rays and walks rise and fall by motions and by the target.
std::function<Film()> gatheringTowards(const EngineSettings& settings)
{
  return [=] {
    const SceneObjects objects{ litRoom(4).build(),
      { ball({}, 0.4, 4), block({ 0.5, 0.5, 0.2 }, { 0.2, 0.2, 0.2 }, 1) } };
    const Vector3 middle(2.4, 1.5, 1), belowLamp(1.8, 2, 2.4);
    Film film = going(objects, settings, { middle, belowLamp, middle, { 2.4, 1.5, 1.01 }, middle });
    const double targets[] = { 0.25, 0.25, 0.15, 0.15, 0.3 };
    for (std::size_t i = 0; i < film.size(); ++i)
    {
      film[i].settings.targetRelativeError = targets[i];
    }
    return film;
  };
}

/// Bodies that touch lamps exactly, nearly, or not.
std::function<Film()> touching(const EngineSettings& settings)
{
  return [=] {
    std::mt19937_64 random(5);
    const auto step = [&](int low, int high) {
      return std::uniform_int_distribution<int>(low, high)(random);
    };
    SceneObjects objects{ lightTable(), { makeBox(0.5), makeBox(0.5), makeBox(1) } };
    Film film;
    for (int frame = 0; frame < (kIsSanitized ? 10 : 40); ++frame)
    {
      for (SceneObject& object : objects.dynamicObjects)
      {
        if (frame == 0 || step(0, 2) > 0)
        {
          const double x = 0.25 * step(-6, 8), y = 0.25 * step(-6, 8);
          const double heights[] = { 0, 0, 1e-11, 0.5, 1 };
          const Eigen::AngleAxisd turn(0.25 * M_PI * step(0, 3), Vector3::UnitZ());
          object.worldFromObject = { turn.toRotationMatrix(), { x, y, heights[step(0, 4)] } };
        }
      }
      film.push_back({ objects, settings });
    }
    return film;
  };
}

/// A ball passes over a lamp near to the floor, through it, and through the light of it. Beside it
/// are a panel, and a strip along a wall.
std::function<Film()> passingNearLamps(const EngineSettings& settings)
{
  return [=] {
    ObjectBuilder room = plainRoom({ 4, 4, 3 }, 6, grey(0.5));
    addPanel(room, { 1.5, 1.5, 2.5 }, 1, 1, 8);
    addPanel(room, { 1.5, 1.5, 0.05 }, 0.05, 0.05, 1200);
    room.addQuad({ 0.2, 0.05, 2 }, { 3.6, 0, 0 }, { 0, 0, 0.03 }, 1, 1, grey(0, 28));
    std::vector<Vector3> places;
    for (int i = 0; i < 8; ++i)
    {
      places.emplace_back(0.4 + 0.3 * i, 1.55, 0.25);
    }
    return going({ room.build(), { ball({}, 0.2, 4) } }, settings, places);
  };
}

/// Warm walls, which are no brighter than the scene, beside a lamp.
std::function<Film()> inAnOven(const EngineSettings& settings)
{
  return [=] {
    ObjectBuilder oven = plainRoom({ 4, 4, 3 }, 6, grey(0.5, 10));
    addPanel(oven, { 1.5, 1.5, 2.9 }, 1, 1, 500);
    return going({ oven.build(), { ball({}, 0.4, 6) } }, settings,
      { { 1, 1, 1 }, { 2, 2, 2 }, { 2, 2, 2.8 }, { 5, 2, 1 }, { 1, 1, 1 } });
  };
}

/// A ball and a block before a house, in the light of a clear sky, of its sun, and of a lamp.
std::function<Film()> outdoors(const EngineSettings& settings, int bands, double sunRadius)
{
  return [=] {
    ObjectBuilder yard(bands);
    yard.addQuad({ -2, -2, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 5, 5, grey(0.4));
    yard.addBox(box({ -2, -1, 0 }, { -1, 1, 1.5 }), 2, grey(0.6));
    addPanel(yard, { -1, -0.25, 1.25 }, 0.5, 0.5, 8);
    Sky sky = skyOf(box({ -2.5, -2.5, -0.25 }, { 2.5, 2.5, 2 }), cieSky(12, 120), 0.3, bands);
    sky.towardsSun = skyDirection(30, 120);
    sky.sunIrradiance = { 5, 4, 3 };
    sky.sunIrradiance.resize(static_cast<std::size_t>(bands));
    sky.bandWeights.back() = 0.5;
    sky.sunRadius = sunRadius;
    return going({ yard.build(),
                   { ball({}, 0.3, 4, grey(0.5), bands),
                     block({ 0.5, -1, 0.5 }, { 0.3, 0.2, 0.5 }, 2, grey(0.7), bands) },
                   std::make_shared<const Sky>(sky) },
      settings, { { 0, 0.5, 0.5 }, { 0.5, 0, 0.5 }, { 0.5, 0, 1.5 }, { -0.9, 0.2, 1.4 } });
  };
}

/// Something moves in the light of a far lamp, above cells that see less than a quantum of it.
std::function<Film()> belowAFarLamp(const EngineSettings& settings)
{
  return [=] {
    ObjectBuilder land, plate, speck;
    land.addQuad({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 12, 12, grey(0.3));
    land.addPointLight({ 2e7, 1e7, 6e7 }, 1e19);
    plate.addQuad({ -0.35, -0.35, 0 }, { 0.7, 0, 0 }, { 0, 0.7, 0 }, 3, 3, grey(0));
    speck.addQuad({ 0, 0, 0 }, { 1e-5, 0, 0 }, { 0, -1e-5, 0 }, 2, 2, grey(0));
    return going({ land.build(), { plate.build(), speck.build(shift({ 0.3, 0, 0.2 })) } }, settings,
      { { -0.4, 0.1, 0.5 }, { -0.2, 0.1, 0.5 }, { 0, 0.1, 0.5 }, { 0.2, 0.1, 0.5 } });
  };
}

/// A coarse part comes near a statue of small cells, touches it, and stands on the lamp.
std::function<Film()> besideAStatue(const EngineSettings& settings, int bands)
{
  return [=] {
    return going(roomWithStatue({ 0, 0, 0 }, bands), settings,
      { { 3, 2, 1 }, { 2, 1.2, 0.7 }, { 2.75, 1.25, 0.75 }, { 0.75, 0.75, 0.25 },
        { 0.75, 0.75, 0.251 } });
  };
}

/// Objects move, leave and come back, the first in part as something else, and settings change that
/// need no new walks.
std::function<Film()> comingAndGoing(const EngineSettings& settings, unsigned seed)
{
  return [=] {
    RandomVectors random(seed);
    const auto isOneOf = [&](unsigned count) { return random.engine() % count == 0; };
    MovingScene scene(1, true, seed, !settings.gathersDirectLight);
    std::vector<bool> isAway(MovingScene::kObjects, false);
    SceneObject other;
    FilmFrame frame{ {}, settings };
    Film film;
    for (int step = 0; step < 2 * kFrames; ++step, scene.nextFrame())
    {
      if (settings.cellEstimate != CellEstimate::Gathered)
      {
        frame.settings.cellEstimate = isOneOf(2) ? CellEstimate::Sums : CellEstimate::Spread;
      }
      frame.settings.cacheStaticHits = isOneOf(2);
      frame.settings.separateSides = frame.settings.separateSides != isOneOf(8);
      frame.settings.replicates = isOneOf(8) ? 5 - frame.settings.replicates : settings.replicates;
      frame.objects = seed % 2 == 0 ? underSky(scene.objects()) : scene.objects();
      for (std::size_t i = 0; i < isAway.size(); ++i)
      {
        isAway[i] = isAway[i] != isOneOf(3);
        frame.objects.dynamicObjects[i].isPresent = !isAway[i];
      }
      SceneObject& first = frame.objects.dynamicObjects[0];
      if (isAway[0] && isOneOf(3))
      {
        const Look look{ { 0.3 }, {}, { settings.gathersDirectLight ? 0 : 0.5 }, 9 };
        other = ball({}, 0.4, 3 + static_cast<int>(random.engine() % 3), look);
      }
      first.body = other.body ? other.body : first.body;
      first.material = other.body ? other.material : first.material;
      film.push_back(frame);
    }
    return film;
  };
}

/// A luminaire below the ceiling, one in the air, and one that goes, turns, is mirrored, or rests
/// while a body passes.
std::function<Film()> underLuminaires(const EngineSettings& settings, double specular = 0)
{
  return [=] {
    ObjectBuilder room = variedRoom(2, 3, specular), thing(3);
    std::size_t first = room.numberOfCells();
    addPanel(room, { 1.2, 1.6, 2.9 }, 1.2, 0.8, 0);
    room.addOpening(first, lopsidedLamp({ 30, 20, 10 }));
    room.addPointLuminaire({ 3, 1, 2 }, lopsidedLamp({ 5, 5, 20 }, true));
    thing.addBox(box({ -0.2, -0.15, -0.1 }, { 0.2, 0.15, 0.1 }), 1, grey(0.4));
    thing.addOpening(0, lopsidedLamp({ 5, 20, 10 }, true));
    SceneObjects objects{ room.build(), { thing.build(), ball({}, 0.4, 3, grey(0.5), 3) } };
    AffineMap &lamp = objects.dynamicObjects[0].worldFromObject,
              &body = objects.dynamicObjects[1].worldFromObject;
    const Matrix3 turned = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).matrix();
    lamp.translation = { 1.5, 2, 1.6 };
    body.translation = { 2.4, 1.2, 0.7 };
    Film film;
    for (int frame = 0; frame < kFrames; ++frame)
    {
      body.translation[1] += frame % 2 == 1 ? 0.4 : 0;
      lamp.linear = frame < 2 ? Matrix3::Identity() : turned;
      lamp.translation[0] += frame == 5 ? 1 : 0;
      film.push_back({ objects, settings });
      if (frame == 4)
      {
        lamp.linear.col(0) *= -1;
        film.back().objects.dynamicObjects[0] = mirrored(objects.dynamicObjects[0], lamp);
      }
    }
    return film;
  };
}

/// A pane, a sleeve and a ball move in a room with sheets.
std::function<Film()> amongSheets(const EngineSettings& settings, int bands)
{
  return [=] {
    SceneObjects objects = glazedRoom(bands);
    AffineMap &pane = objects.dynamicObjects[0].worldFromObject,
              &sleeve = objects.dynamicObjects[1].worldFromObject,
              &body = objects.dynamicObjects[2].worldFromObject;
    Film film;
    for (int frame = 0; frame < kFrames; ++frame)
    {
      film.push_back({ objects, settings });
      pane.translation += Vector3(frame % 2 == 0 ? 0.3 : 0, 0.1, 0);
      pane.linear = Eigen::AngleAxisd(0.4 * frame, Vector3::UnitX()).matrix();
      sleeve.translation[1] += frame % 3 == 1 ? 0.5 : 0;
      body.translation = frame % 2 == 1 ? sleeve.translation : body.translation;
    }
    return film;
  };
}

/// A sheet and a ball move below a roof that lets light of the sky and of the sun through.
std::function<Film()> belowASheet(const EngineSettings& settings)
{
  return [=] {
    ObjectBuilder yard;
    yard.addQuad({ -2, -2, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 5, 5, grey(0.4));
    const std::size_t roof = yard.numberOfCells();
    yard.addQuad({ -1, -1, 1.5 }, { 2, 0, 0 }, { 0, 2, 0 }, 2, 2, grey(0.1));
    SceneObject fixed = yard.build();
    makeSheets(fixed, roof, { 0.2, { 0.6, 0.6, 0.6 } });
    Sky sky = skyOf(box({ -2.5, -2.5, -0.25 }, { 2.5, 2.5, 2 }), cieSky(12, 120), 0.3);
    sky.towardsSun = skyDirection(30, 120);
    sky.sunIrradiance = { 5 };
    sky.sunRadius = 0.005;
    return going(
      { fixed, { sheet(0.8, 2, grey(0.1), straight(0.5)), ball({ 0.3, 0, 0.5 }, 0.3, 4) },
        std::make_shared<const Sky>(sky) },
      settings, { { 0, 0, 1 }, { 0.2, 0, 1 }, { 0.5, 0, 1.7 }, { 0.5, 0.1, 0.4 } });
  };
}

/// So many that casts search them by lists, by balls or by a tree.
std::function<Film()> amongMany(int movers, double radius, const EngineSettings& settings)
{
  return [=] {
    ObjectBuilder room = plainRoom({ 4, 4, 4 }, 3, grey(0.7));
    room.addPointLight({ 2, 2, 2 }, 3);
    SceneObjects objects{ room.build(),
      std::vector<SceneObject>(static_cast<std::size_t>(movers), ball({}, radius, 4)) };
    Film film;
    for (int frame = 0; frame < 3; ++frame)
    {
      for (int i = 0; i < movers; ++i)
      {
        const auto at = [&](double step) { return 0.5 + 3 * std::fmod(step * (i + 1), 1.0); };
        objects.dynamicObjects[static_cast<std::size_t>(i)].worldFromObject =
          shift({ at(0.8191725134), at(0.6710436067) + 0.1 * frame, at(0.5497004779) });
      }
      film.push_back({ objects, settings });
    }
    return film;
  };
}

template <class Light>
void addLights(const std::vector<Light>& lights, Answer& answer)
{
  for (const Light& light : lights)
  {
    for (const auto& bands : { light.value, light.standardError })
    {
      std::for_each(bands.begin(), bands.end(), [&](double band) { addBits(answer, band); });
    }
  }
}

std::vector<Sensor> sensorsIn(double unit)
{
  std::vector<Sensor> sensors = randomSensors(30);
  for (Sensor& sensor : sensors)
  {
    sensor.position *= unit;
  }
  return sensors;
}

/// Of sensors all together and, as they may be divided, each alone.
View bySensors()
{
  return [](const auto& engine, const Asking& asking, Answer& answer) {
    const std::vector<Sensor> sensors = sensorsIn(asking.unit);
    const auto lights = gathered(*engine, sensors, 16);
    addLights(lights, answer);
    const SensorFinalGather gather(*engine, 16, asking.execution);
    for (std::size_t i = 0; i < sensors.size(); ++i)
    {
      EXPECT_TRUE(areSame(lightsAt(gather, sensors, { i }), { lights[i] }));
    }
  };
}

/// Of sensors whose rays are kept.
View byStoredSensors()
{
  return [stored = std::make_shared<StoredSensors>()](
           const auto& engine, const Asking& asking, Answer& answer) {
    stored->update(engine, sensorsIn(asking.unit), 16, true, asking.execution);
    addLights(stored->lights(), answer);
  };
}

/// Of a near and a far eye, all cells together and each alone.
View byEyes()
{
  return [](const auto& engine, const Asking& asking, Answer& answer) {
    const std::vector<SceneCell> cells = cellsOf(engine->objects());
    const OutgoingRadiance radiance(*engine, 2, asking.execution);
    for (const Eye& eye :
      { Eye{ asking.unit * Vector3(0.1, 0.2, 0.3) }, Eye{ { 0, 0.6, 0.8 }, true } })
    {
      const SeenLights lights = radiance.at(cells, eye);
      addLights(lights, answer);
      for (std::size_t i = 0; i < cells.size(); i += 7)
      {
        EXPECT_TRUE(areSame(SeenLights{ radiance.at(cells[i], eye) }, SeenLights{ lights[i] }));
      }
    }
  };
}

/// Of stored walks: all, and those that touch a cell.
View byPaths()
{
  return [](const auto& engine, const Asking& asking, Answer& answer) {
    const WalkPaths paths(*engine);
    for (const auto& walks :
      { paths.first(1000000), paths.first(50), paths.touching({ 1, 0 }, 50, asking.execution) })
    {
      for (const WalkPath& path : paths.paths(walks, asking.execution))
      {
        answer.insert(answer.end(), { path.walk, path.power[0], path.escapes, path.isStale });
        answer.push_back(asking.withRepairs ? static_cast<std::int64_t>(path.firstRepaired) : 0);
        for (const Vector3& point : path.points)
        {
          std::for_each(point.data(), point.data() + 3,
            [&](double coordinate) { addBits(answer, coordinate / asking.unit); });
        }
      }
    }
  };
}

/// Of photons in their leaves.
View byNearestPhotons()
{
  return [](const auto& engine, const Asking& asking, Answer& answer) {
    engine->collectPhotons(asking.execution);
    engine->prepareSurfaces(asking.execution);
    const NearestPhotons photons = engine->nearestPhotons();
    for (const Sensor& sensor : sensorsIn(asking.unit))
    {
      const std::optional<Foot> foot = photons.footOf(sensor);
      if (foot)
      {
        NearPhotons found = photons.find(*foot, 20, 0.5 * asking.unit);
        std::sort(found.photons.begin(), found.photons.end());
        addBits(answer, found.radius / asking.unit);
        for (const SegmentRef& photon : found.photons)
        {
          answer.insert(answer.end(), { photon.walk, photon.bounce });
        }
      }
    }
  };
}

/// Of eyes and nearest photons.
View byAll()
{
  return [](const auto& engine, const Asking& asking, Answer& answer) {
    byEyes()(engine, asking, answer);
    byNearestPhotons()(engine, asking, answer);
  };
}

}

std::vector<Feature> features()
{
  const std::uint32_t walks = scaled(3000), few = scaled(1100); // two blocks at least
  return {
    { "Walks", moving(Shoot(walks), 1, false, 21) },
    { "SidesInColour", moving(Shoot(walks).bySide().cached(), 3, true, 22) },
    { "Gloss", moving(Shoot(walks).cached(), 1, true, 24, true) },
    { "GlossInColour", moving(Shoot(few).bySide(), 3, false, 25, true) },
    { "ErrorBars", moving(Shoot(walks).errors(16).cached(), 1, false, 71, true) },
    { "ErrorBarsInColour", moving(Shoot(walks).errors(16).bySide(), 3, true, 72) },
    { "UnderASky", moving(Shoot(walks).errors(16), 3, false, 11, false, true) },
    { "Target", shaded(Shoot(3001).errors(16).target(0.2, 100000)), {}, true },
    { "TargetUnderASky", moving(Shoot(few).errors(16).target(0.5, 20000), 3, false, 6, false, true),
      {}, true },
    { "GatheredLight", moving(Shoot(walks).gathered(), 1, false, 26) },
    { "GatheredLightInColour",
      moving(Shoot(few).gathered().bySide().errors(3), 3, false, 27, true) },
    { "GatheredLightUnderASky",
      moving(Shoot(few).gathered().errors(16), 3, false, 9, false, true) },
    { "TargetOfGatheredLight", shaded(Shoot(3001).gathered().errors(16).target(0.2, 100000)), {},
      true },
    { "Spread", moving(Shoot(walks).spread(400).errors(4), 1, false, 73) },
    { "SpreadInColour", moving(Shoot(few).spread(100).errors(4).bySide(), 3, true, 73) },
    { "SpreadUnderASky", moving(Shoot(walks).spread(60), 3, false, 5, false, true) },
    { "SpreadOfGatheredLight",
      moving(Shoot(walks).spread(200).gathered().errors(4), 1, false, 74) },
    { "SpreadTarget", moving(Shoot(few).spread(100).errors(8).target(0.35, 30000), 1, true, 75), {},
      true },
    { "FinalGather", moving(Shoot(10000).finalGather(16), 1, false, 76) },
    { "FinalGatherInColour", moving(Shoot(10000).finalGather(8).errors(4).bySide(), 3, true, 71) },
    { "FinalGatherEverywhere", moving(Shoot(10000).finalGather(8).everywhere(), 1, true, 72) },
    { "FinalGatherUnbiased", besideAStatue(Shoot(5000).finalGather(8).everywhere().unbiased(), 3) },
    { "FinalGatherOfGloss", besideAStatue(Shoot(10000).finalGather(16).errors(4), 3) },
    { "FinalGatherTarget",
      gatheringTowards(
        Shoot(3000).finalGather(16).everywhere().errors(8).target(0.25, 24000).mostRays(128)),
      {}, true },
    { "FinalGatherTargetUnbiased",
      gatheringTowards(Shoot(1000)
                         .finalGather(8)
                         .everywhere()
                         .unbiased()
                         .bySide()
                         .errors(8)
                         .target(0.3, 4000)
                         .mostRays(16)),
      {}, true },
    { "FinalGatherWhilePartsComeAndGo", comingAndGoing(Shoot(5000).finalGather(7), 79), {}, true },
    { "PartsThatComeAndGo", comingAndGoing(Shoot(300).spread(60).keptByAll(), 1), byAll, true },
    { "PartsThatComeAndGoUnderASky", comingAndGoing(Shoot(300).spread(60).keptByAll(), 2), byAll,
      true },
    { "Contacts", touching(Shoot(walks).bySide().cached()) },
    { "ContactsOfGatheredLight", touching(Shoot(few).gathered().bySide()) },
    { "NearLamps", passingNearLamps(Shoot(walks).gathered().errors(16)) },
    { "DimLights", inAnOven(Shoot(walks).gathered().errors(4)) },
    { "DimLightsOfFinalGather", inAnOven(Shoot(5000).finalGather(8)) },
    { "Luminaires", underLuminaires(Shoot(walks).errors(16).bySide().cached(), 0.2), {}, true },
    { "LuminairesOfGatheredLight", underLuminaires(Shoot(few).gathered().errors(4)), {}, true },
    { "LuminairesOfSpread", underLuminaires(Shoot(few).spread(100).errors(4)), {}, true },
    { "LuminairesOfFinalGather",
      underLuminaires(Shoot(5000).finalGather(8).everywhere().unbiased()), {}, true },
    { "LuminairesOfTarget", underLuminaires(Shoot(few).gathered().errors(8).target(0.4, 8000)), {},
      true },
    { "LuminairesSeen", underLuminaires(Shoot(scaled(500)).gathered().errors(3).keptByAll(), 0.2),
      byEyes, true },
    { "AFarLamp", belowAFarLamp(Shoot(2000).gathered().errors(4)), {}, false, true },
    { "AFarLampOfSpread", belowAFarLamp(Shoot(2000).gathered().spread(250).errors(4)), {}, false,
      true },
    { "AFarLampOfFinalGather", belowAFarLamp(Shoot(2000).finalGather(16).errors(4)), {}, false,
      true },
    { "Sky", outdoors(Shoot(walks).errors(16).cached(), 1, 0) },
    { "SunAndSkyOfGatheredLight", outdoors(Shoot(walks).gathered().errors(4).bySide(), 3, 0.01) },
    { "SkyOfFinalGather", outdoors(Shoot(5000).finalGather(8).everywhere().errors(4), 3, 0.005) },
    { "SensorsUnderTheSky", outdoors(Shoot(walks).gathered().errors(3).keptByAll(), 3, 0.01),
      bySensors },
    { "Painted", painting(Shoot(walks).cached(), 1, 51) },
    { "PaintedGloss", painting(Shoot(few).errors(4), 1, 52, true) },
    { "PaintedGlossInColour", painting(Shoot(few).bySide().cached(), 3, 53, true) },
    { "PaintedSpread", painting(Shoot(few).spread(100).errors(4), 1, 54) },
    { "PaintedTarget", painting(Shoot(few).errors(8).target(0.5, 20000), 1, 55), {}, true },
    { "PaintedThingsInGatheredLight", painting(Shoot(few).gathered(), 3, 56, true, false) },
    { "PaintedThingsOfFinalGather", painting(Shoot(5000).finalGather(8), 1, 57, false, false) },
    { "PaintedRoomOfFinalGather", painting(Shoot(5000).finalGather(8).errors(3), 3, 58), {}, true },
    { "PaintedBeforeEyes", painting(Shoot(scaled(500)).keptByAll(), 1, 59, true), byAll },
    { "PaintedBeforeStoredSensors", painting(Shoot(few).keptByAll(), 1, 60), byStoredSensors },
    { "Resized", resizing(Shoot(walks).cached(), 1), {}, true },
    { "ResizedInColour", resizing(Shoot(walks).bySide().errors(3), 3), {}, true },
    { "ResizedSpread", resizing(Shoot(few).spread(100).errors(4), 1), {}, true },
    { "ResizedBeforeEyes", resizing(Shoot(scaled(500)).keptByAll(), 1), byAll, true },
    { "Rebuilt", rebuilding(Shoot(walks).cached(), 1) },
    { "RebuiltInColour", rebuilding(Shoot(few).bySide().errors(3), 3) },
    { "RebuiltAtTheLamp", rebuilding(Shoot(walks), 1, true) },
    { "RebuiltSpread", rebuilding(Shoot(few).spread(100).errors(4), 1) },
    { "RebuiltTarget", rebuilding(Shoot(few).errors(8).target(0.5, 20000), 1), {}, true },
    { "RebuiltInGatheredLight", rebuilding(Shoot(few).gathered(), 1), {}, true },
    { "RebuiltBeforeEyes", rebuilding(Shoot(scaled(500)).keptByAll(), 1), byAll },
    { "AnyChange", changing(Shoot(few).cached(), 1, 77), {}, true },
    { "AnyChangeInColour", changing(Shoot(few).bySide().errors(3), 3, 72), {}, true },
    { "AnyChangeOfSpread", changing(Shoot(few).spread(60), 1, 73), {}, true },
    { "AnyChangeInGatheredLight", changing(Shoot(scaled(500)).gathered(), 1, 74), {}, true },
    { "AnyChangeOfFinalGather", changing(Shoot(2000).finalGather(8), 3, 75), {}, true },
    { "ManyMovers", amongMany(24, 0.2, Shoot(walks)) },
    { "ManySmallMovers", amongMany(40, 0.05, Shoot(4 * walks)) },
    { "VeryManyMovers", amongMany(520, 0.04, Shoot(walks)) },
    { "Sheets", amongSheets(Shoot(walks).cached().keptByAll(), 1), byPaths },
    { "SheetsInColour", amongSheets(Shoot(walks).bySide().errors(4), 3) },
    { "SheetsInGatheredLight", amongSheets(Shoot(walks).gathered().errors(3), 3) },
    { "SheetsInSpreadLight", amongSheets(Shoot(walks).gathered().spread(400), 1) },
    { "SheetsOfFinalGather", amongSheets(Shoot(5000).finalGather(8).everywhere().errors(4), 3) },
    { "SheetsUnderTheSky", belowASheet(Shoot(walks).gathered().errors(3).keptByAll()), bySensors },
    { "SheetsUnderTheSkyOfFinalGather",
      belowASheet(Shoot(5000).finalGather(8).everywhere().errors(4)) },
    { "SensorsAmongSheets", amongSheets(Shoot(few).gathered().keptByAll().errors(3), 1),
      byStoredSensors },
    { "EyesAmongSheets", amongSheets(Shoot(few).bySide().keptByAll(), 1), byAll },
    { "Sensors", moving(Shoot(few).errors(3).keptByAll(), 1, false, 92), bySensors },
    { "SensorsInColour", moving(Shoot(few).gathered().bySide().errors(3), 3, false, 93),
      bySensors },
    { "StoredSensors", moving(Shoot(few).keptByAll(), 1, false, 41), byStoredSensors },
    { "StoredSensorsInColour", moving(Shoot(few).gathered().keptByAll().errors(4), 3, false, 42),
      byStoredSensors },
    { "StoredSensorsBySide", moving(Shoot(few).gathered().bySide().errors(4), 1, true, 43),
      byStoredSensors },
    { "Eyes", moving(Shoot(scaled(500)).keptByAll(), 1, false, 91, true), byEyes },
    { "EyesInColour",
      moving(Shoot(scaled(500)).gathered().bySide().errors(3).keptByAll(), 3, true, 91, true),
      byEyes },
    { "EyesWithATarget",
      moving(Shoot(few).errors(8).target(1, 16000).keptByAll(), 1, true, 93, true), byEyes, true },
    { "Paths", moving(Shoot(walks).kept(), 1, false, 34, true, true), byPaths },
    { "PathsOfGatheredLight", moving(Shoot(walks).kept().gathered(), 3, true, 33, true, true),
      byPaths },
    { "NearestPhotons", moving(Shoot(walks).keptByAll(), 1, true, 31, true), byNearestPhotons },
    { "NearestPhotonsOfGatheredLight", moving(Shoot(walks).keptByAll().gathered(), 1, false, 36),
      byNearestPhotons },
  };
}

Answer FilmRun::told(const Asking& asking) const
{
  Answer answer = shownAnswer(*engine_);
  const double watts = engine_->watts(engine_->balance().emitted.total());
  addBits(answer, watts / (asking.unit * asking.unit));
  expectBalance(*engine_);
  if (view_)
  {
    view_(engine_, asking, answer);
  }
  return answer;
}

namespace
{

/// Objects in another unit of length, each body once.
class Scaling
{
public:
  explicit Scaling(double scale)
    : scale_(scale)
  {
  }

  void apply(SceneObject& object, bool scalesModel)
  {
    if (object.emission)
    {
      auto& emission = emissions_[object.emission];
      emission = emission ? emission : scaled(*object.emission, scalesModel ? scale_ : 1);
      object.emission = emission;
    }
    object.worldFromObject.translation *= scale_;
    object.worldFromObject.linear *= scalesModel ? 1 : scale_;
    if (scalesModel && object.body)
    {
      auto& body = bodies_[object.body];
      body = body ? body : scaled(object.body->mesh());
      object.body = body;
    }
  }

  void apply(std::shared_ptr<const Sky>& sky) const
  {
    if (sky)
    {
      Sky other = *sky;
      other.lit = { sky->lit.lower * scale_, sky->lit.upper * scale_ };
      sky = std::make_shared<const Sky>(std::move(other));
    }
  }

private:
  std::shared_ptr<const RigidObject> scaled(const TriangleMesh& mesh) const
  {
    std::vector<Triangle> triangles;
    for (const Triangle& t : mesh.triangles())
    {
      triangles.push_back({ t.a * scale_, t.b * scale_, t.c * scale_ });
    }
    return std::make_shared<RigidObject>(TriangleMesh(triangles));
  }
  /// As much per m2.
  std::shared_ptr<const Emission> scaled(Emission emission, double lengths) const
  {
    for (PointSource& light : emission.points)
    {
      light.position *= lengths;
      for (double& flux : light.flux)
      {
        flux *= scale_ * scale_;
      }
    }
    for (Luminaire& lamp : emission.luminaires)
    {
      for (double& flux : lamp.flux)
      {
        flux *= scale_ * scale_;
      }
      for (Vector3& face : lamp.faces)
      {
        face *= lengths * lengths;
      }
    }
    return std::make_shared<Emission>(std::move(emission));
  }

  double scale_;
  std::map<std::shared_ptr<const RigidObject>, std::shared_ptr<const RigidObject>> bodies_;
  std::map<std::shared_ptr<const Emission>, std::shared_ptr<const Emission>> emissions_;
};

}

Film scaledFilm(const Film& film, double scale, bool scalesModels)
{
  Scaling scaling(scale);
  Film all = film;
  for (FilmFrame& frame : all)
  {
    scaling.apply(frame.objects.staticObject, true);
    for (SceneObject& object : frame.objects.dynamicObjects)
    {
      scaling.apply(object, scalesModels);
    }
    scaling.apply(frame.objects.sky);
  }
  return all;
}

}
