// SPDX-License-Identifier: BSD-3-Clause
// Luminaires in closed forms, by each estimate of light.

#include "Kit.h"

namespace irradiance::test
{
namespace
{

constexpr double kWatts = 50;

/// W/sr of a lamp with usual axes.
double intensityOf(const Luminaire& lamp, const Vector3& direction)
{
  return kWatts * lamp.intensity->value({ direction.x(), direction.y(), -direction.z() }) /
    lamp.intensity->integral();
}

/// Its body is about the origin.
struct Lamp
{
  const char* name;
  Luminaire lamp;
  ObjectBuilder body{};
};

std::vector<Lamp> lamps(double half)
{
  const Luminaire down = lopsidedLamp({ kWatts }), around = lopsidedLamp({ kWatts }, true);
  std::vector<Lamp> all{ { "point", around }, { "quad", down }, { "box", around },
    { "disc", down } };
  all[0].body.addPointLuminaire({ 0, 0, 0 }, around);
  addPanel(all[1].body, { -half, -half, 0 }, 2 * half, 2 * half, 0);
  all[2].body.addBox(box({ -half, -half, -half / 2 }, { half, half, half / 2 }), 1, {});
  std::vector<Triangle> disc;
  const auto corner = [half](int i) {
    return Vector3(half * std::cos(M_PI * i / 8), -half * std::sin(M_PI * i / 8), 0);
  };
  for (int i = 0; i < 16; ++i)
  {
    disc.push_back({ Vector3::Zero(), corner(i), corner(i + 1) });
  }
  all[3].body.addCell(disc, {});
  for (std::size_t i = 1; i < all.size(); ++i)
  {
    all[i].body.addOpening(0, all[i].lamp);
  }
  return all;
}

/// Of the intensity over the squared distance and the cosine, on a square cell of a static object.
template <class Intensity>
double meanFrom(
  const Vector3& lamp, const Intensity& intensity, const SceneObject& object, std::size_t cell)
{
  constexpr int kParts = 60;
  const auto first = static_cast<std::uint32_t>(2 * cell);
  const Triangle triangle = object.mesh()[first];
  const Vector3 u = triangle.b - triangle.a, v = object.mesh()[first + 1].c - triangle.a;
  double sum = 0;
  for (int i = 0; i < kParts * kParts; ++i)
  {
    const Vector3 to =
      triangle.a + (i % kParts + 0.5) / kParts * u + (i / kParts + 0.5) / kParts * v - lamp;
    const Vector3 direction = to.normalized();
    sum += intensity(direction) * std::max(0.0, -u.cross(v).normalized().dot(direction)) /
      to.squaredNorm();
  }
  return sum / (kParts * kParts);
}

/// Walks, gathered light and the final gather.
std::vector<EngineSettings> estimates(std::uint32_t walks, std::uint32_t rays = 64)
{
  return { Shoot(scaled(walks)).errors(16), Shoot(scaled(walks / 4)).gathered().errors(16),
    Shoot(scaled(walks / 4)).finalGather(rays).everywhere().unbiased().errors(16) };
}

/// Of a static cell; returns the standard error, W. A false alarm of t of 15 degrees beyond 4.5 is
/// once in 2,000.
double expectLight(const IrradianceEngine& engine, std::size_t cell, double truth, const char* name)
{
  const CellSide side{ { 0, cell } };
  // Of a cell without light it is not known.
  const double known = engine.watts(engine.errorEstimate().standardError(side, 0)),
               error = truth > 0 ? known / engine.cells().area({ 0, cell }) : 0;
  EXPECT_NEAR(engine.irradiance(side, 0), truth, 4.5 * error + 0.005 * truth)
    << name << ", cell " << cell << ", estimate " << engine.settings().gathersDirectLight
    << static_cast<int>(engine.settings().cellEstimate);
  EXPECT_LE(error, (kIsSanitized ? 0.5 : 0.2) * truth + 0.05) << name << ", cell " << cell;
  return error * engine.cells().area({ 0, cell });
}

SceneObject blackRoom()
{
  ObjectBuilder room;
  room.addBox(box({ -2, -2, -2 }, { 2, 2, 2 }), 2, {}, true);
  return room.build();
}

/// Where lamps are, which are mirrored.
AffineMap poseOfLamp()
{
  Matrix3 turned = Eigen::AngleAxisd(0.4, Vector3(1, -2, 0.5).normalized()).toRotationMatrix();
  turned.col(1) *= -1;
  return { turned, { 0.3, -0.2, 0.4 } };
}

TEST(Luminaires, LightWallsBySquaredDistance)
{
  const AffineMap pose = poseOfLamp();
  for (const Lamp& lamp : lamps(0.005))
  {
    const SceneObjects objects{ blackRoom(), { mirrored(lamp.body.build(), pose) } };
    const auto intensity = [&](const Vector3& d) {
      return intensityOf(lamp.lamp, pose.linear.transpose() * d);
    };
    std::vector<double> truths;
    for (std::size_t cell = 0; cell < 24; ++cell)
    {
      truths.push_back(meanFrom(pose.translation, intensity, objects.staticObject, cell));
    }
    for (const EngineSettings& settings : estimates(100000))
    {
      const UpdatedEngine engine(objects, settings);
      double squares = 0;
      for (std::size_t cell = 0; cell < 24; ++cell)
      {
        squares += std::pow(expectLight(engine, cell, truths[cell], lamp.name), 2);
      }
      // All that walks start with arrives, to the quantum.
      const double rounding = 1e-12 * kWatts, error = 4.5 * std::sqrt(squares) + 0.001 * kWatts;
      EXPECT_NEAR(
        estimatedWattsOn(engine, 0, 0), kWatts, settings.gathersDirectLight ? error : rounding)
        << lamp.name;
      EXPECT_EQ(estimatedWattsOn(engine, 1, 0), 0) << "of itself";
    }
  }
}

// In the air, with little chance: it chooses the face.
TEST(Luminaires, LightSensorsBySquaredDistance)
{
  RandomVectors random(9);
  const AffineMap pose = poseOfLamp();
  for (const Lamp& lamp : lamps(0.001))
  {
    std::vector<Sensor> sensors;
    std::vector<double> expected;
    while (sensors.size() < 20)
    {
      const Vector3 local = random.direction(), direction = pose.linear * local;
      const Vector3 normal = (random.direction() - 2 * direction).normalized();
      if (intensityOf(lamp.lamp, local) > 0)
      {
        expected.push_back(intensityOf(lamp.lamp, local) * -normal.dot(direction) / (1.3 * 1.3));
        sensors.push_back({ pose.translation + 1.3 * direction, normal });
      }
    }
    const auto lights = gathered({ blackRoom(), { mirrored(lamp.body.build(), pose) } },
      Shoot(1000).gathered().errors(16), sensors, 1024);
    for (std::size_t i = 0; i < sensors.size(); ++i)
    {
      EXPECT_NEAR(
        lights[i].value[0], expected[i], 4.5 * lights[i].standardError[0] + 2e-3 * expected[i])
        << lamp.name << ", sensor " << i;
      EXPECT_LE(lights[i].standardError[0], 0.01 * expected[i]) << lamp.name << ", sensor " << i;
    }
  }
}

// A wide lamp, which reflects, in a room that reflects: all estimates agree near to it.
TEST(Luminaires, EstimatesAgreeNearWideOnes)
{
  for (Lamp& lamp : lamps(0.4))
  {
    for (double& part : lamp.body.material().reflectance)
    {
      part = 0.4;
    }
    ObjectBuilder room;
    room.addBox(box({ -1, -1, -1 }, { 1, 1, 1 }), 3, grey(0.5), true);
    const SceneObjects objects{ room.build(), { mirrored(lamp.body.build(), poseOfLamp()) } };
    const std::vector<EngineSettings> settings = estimates(60000);
    const UpdatedEngine walks(objects, settings[0]);
    for (std::size_t i = 1; i < settings.size(); ++i)
    {
      SCOPED_TRACE(std::string(lamp.name) + ", estimate " + std::to_string(i));
      EXPECT_GE(
        expectAgreement(walks, UpdatedEngine(objects, settings[i])), kIsSanitized ? 30 : 54);
    }
  }
}

// The floor is a mirror: the ceiling has the light of a mirrored lamp below it alone. Rays have to
// meet it.
TEST(Luminaires, ShineByWayOfAMirror)
{
  const Lamp lamp = lamps(0.25)[1];
  ObjectBuilder room;
  const Box walls = box({ -2, -2, 0 }, { 2, 2, 2 });
  Look mirror;
  mirror.specular = { 0.9, 0.9, 0.9 };
  room.addSide(walls, 5, 2, {}, true); // the ceiling
  room.addSide(walls, 4, 1, mirror, true);
  const SceneObjects objects{ room.build(), { lamp.body.build(shift({ 0.3, 0.2, 1 })) } };
  std::array<double, 4> truths{};
  for (int i = 0; i < 16 * 4; ++i)
  {
    const Vector3 place(0.125 * (i / 4 % 4) - 0.1875, 0.125 * (i / 16) - 0.1875, 0);
    const auto cell = static_cast<std::size_t>(i % 4);
    const auto intensity = [&](const Vector3& d) {
      const Vector3 across = place + 2 / d.z() * d; // where it passes the lamp, which hides some
      return across.head<2>().cwiseAbs().maxCoeff() < 0.25
        ? 0
        : 0.9 * intensityOf(lamp.lamp, { d.x(), d.y(), -d.z() });
    };
    truths[cell] +=
      meanFrom(place + Vector3(0.3, 0.2, -1), intensity, objects.staticObject, cell) / 16;
  }
  for (const EngineSettings& settings : estimates(60000, 8192))
  {
    const UpdatedEngine engine(objects, settings);
    for (std::size_t cell = 0; cell < 4; ++cell)
    {
      expectLight(engine, cell, truths[cell], "mirror");
    }
  }
}

// Intensity over the area that is seen, straight and in a mirror.
TEST(Luminaires, ShowTheirRadiance)
{
  const AffineMap pose = poseOfLamp();
  const Vector3 toEye = Vector3(0.3, 0.7, -0.8).normalized();
  for (const Lamp& lamp : lamps(0.2))
  {
    const SceneObject body = mirrored(lamp.body.build(), pose);
    double area = 0;
    std::vector<SceneCell> cells, hidden;
    for (std::uint32_t i = 0; i < body.mesh().size(); ++i)
    {
      const Triangle triangle = transformed(pose, body.mesh()[i]);
      const double seenArea = triangle.areaVector().dot(toEye) / 2;
      area += std::max(0.0, seenArea);
      (seenArea > 0 ? cells : hidden).push_back({ 1, body.material->cellOfTriangle[i] });
    }
    const double expected =
      area > 0 ? intensityOf(lamp.lamp, pose.linear.transpose() * toEye) / area : 0;
    const UpdatedEngine engine({ blackRoom(), { body } }, Shoot(100).kept());
    for (const auto& light : seen(engine, cells, { toEye, true }))
    {
      EXPECT_NEAR(light.value[0], expected, 1e-9 * expected) << lamp.name;
    }
    for (const auto& light : seen(engine, hidden, { toEye, true }))
    {
      EXPECT_EQ(light.value[0], 0) << lamp.name;
    }
  }
  // A panel so wide that the mirror below shows nothing else.
  ObjectBuilder scene;
  Look mirror;
  mirror.specular = { 0.8, 0.8, 0.8 };
  scene.addQuad({ -0.1, -0.1, 0 }, { 0.2, 0, 0 }, { 0, 0.2, 0 }, 1, 1, mirror);
  scene.addQuad({ -4, -4, 2 }, { 0, 8, 0 }, { 8, 0, 0 }, 1, 1, {});
  const Luminaire lamp = lopsidedLamp({ kWatts });
  scene.addOpening(1, lamp);
  const Vector3 eye = Vector3(0.4, -0.3, 1).normalized();
  const double expected = 0.8 * intensityOf(lamp, { eye.x(), eye.y(), -eye.z() }) / 64 / eye.z();
  for (const bool gathers : { false, true })
  {
    EXPECT_NEAR(seen({ scene.build(), {} }, Shoot(100).kept().gathered(gathers), { { 0, 0 } },
                  { eye, true })[0]
                  .value[0],
      expected, 1e-5 * expected);
  }
}

}
}
