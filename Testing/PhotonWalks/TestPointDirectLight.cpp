// SPDX-License-Identifier: BSD-3-Clause
#include "DirectLight/PointDirectLight.h"

#include "Kit.h"
#include "LambertContour.h"

namespace irradiance::test
{
namespace
{

/// What points receive in a scene of static objects.
class LitScene
{
public:
  explicit LitScene(const ObjectBuilder& builder, std::uint64_t seed = 1)
  {
    engine_.update({ builder.build(), {} }, Shoot(100).gathered().kept());
    light_ = std::make_unique<PointDirectLight>(
      engine_.frame(), engine_.walks().sets().front().source().knownLamps(), seed);
  }

  double at(const LitPoint& point, std::uint64_t number) const
  {
    return light_->irradiance(point, number)[0];
  }
  double inAir(const Vector3& position, const Vector3& normal, std::uint64_t number) const
  {
    return at({ position, normal }, number);
  }
  LitPoint on(std::uint32_t triangle, bool isFront, const Vector3& place) const
  {
    const TriangleId id{ 0, triangle };
    return LitPoint::onTriangle(engine_.scene().worldTriangle(id), id, isFront, place);
  }

private:
  UpdatedEngine engine_;
  std::unique_ptr<PointDirectLight> light_;
};

constexpr int kPoints = kIsSanitized ? 64 : 4096;

/// |t| > 3.5 of 63 degrees of freedom or more: by chance in less than .1 % of the comparisons.
template <class Irradiance>
void expectMean(const char* name, double truth, const Irradiance& irradiance)
{
  ReplicateMean mean;
  for (int number = 0; number < kPoints; ++number)
  {
    mean.add(irradiance(static_cast<std::uint64_t>(number)));
  }
  EXPECT_TRUE(std::abs(mean.t(truth)) <= 3.5 || std::abs(mean.mean() / truth - 1) < 1e-7) << name;
  if (!kIsSanitized)
  {
    EXPECT_NEAR(mean.mean(), truth, 1e-3 * truth) << name;
  }
}

const std::vector<Vector3> kPanel{ { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } };

/// 10 W/m2, shines down.
ObjectBuilder panel()
{
  ObjectBuilder builder;
  addPanel(builder, kPanel[0], 1, 1, 10);
  return builder;
}

// Lambert's formula, in the air and on a floor, far and very near.
TEST(PointDirectLight, UnderAPanel)
{
  for (const double below : { 3.0, 1.0, 0.1, 0.01 })
  {
    ObjectBuilder builder = panel();
    builder.addQuad({ -5, -5, 1 - below }, { 10, 0, 0 }, { 0, 10, 0 }, 1, 1, grey(0));
    const LitScene scene(builder);
    const Vector3 place(0.3, 0.2, 1 - below), above = place + Vector3(0, 0, 0.3 * below);
    const double truth = 10 * lambertIrradiance(place, { 0, 0, 1 }, kPanel);
    const LitPoint onFloor = scene.on(2, true, place); // y < x: its first triangle
    expectMean("floor", truth, [&](auto number) { return scene.at(onFloor, number); });
    EXPECT_EQ(scene.at(scene.on(2, false, place), 1), 0) << "from below";
    const Vector3 oblique = Vector3(0.2, -0.1, 1).normalized();
    if (below >= 1) // all of the panel is above its horizon
    {
      expectMean("air, oblique", 10 * lambertIrradiance(above, oblique, kPanel),
        [&](auto number) { return scene.inAir(above, oblique, number); });
    }
    EXPECT_EQ(scene.inAir(above, { 0, 0, -1 }, 1), 0) << "turned away";
    EXPECT_EQ(scene.inAir({ 0.5, 0.5, 1.5 }, { 0, 0, -1 }, 1), 0) << "behind the panel";
  }
}

// A sheet hides the half of the panel with x > .5.
TEST(PointDirectLight, InAHalfShadow)
{
  ObjectBuilder builder = panel();
  builder.addQuad({ 0.5, -3, 0.5 }, { 4, 0, 0 }, { 0, 6, 0 }, 8, 8, grey(0));
  const LitScene scene(builder);
  const std::vector<Vector3> seen{ { 0, 0, 1 }, { 0.5, 0, 1 }, { 0.5, 1, 1 }, { 0, 1, 1 } };
  const Vector3 place(0.5, 0.4, 0), up(0, 0, 1);
  expectMean("half shadow", 10 * lambertIrradiance(place, up, seen),
    [&](auto number) { return scene.inAir(place, up, number); });
}

// Sixteen panels of unlike power, and a point light: the choice of a lamp has no bias.
TEST(PointDirectLight, FromManyLamps)
{
  ObjectBuilder builder;
  const Vector3 place(0.1, 0.2, 0), up(0, 0, 1), u(0, 0.4, 0), v(0.4, 0, 0);
  double truth = 0;
  for (int i = 0; i < 16; ++i)
  {
    const Vector3 corner(0.6 * (i % 4) - 1, 0.6 * (i / 4) - 1, 0.5);
    const double exitance = 10 + i % 3 * 20; // one class of power
    builder.addQuad(corner, u, v, 1, 1, grey(0, exitance));
    truth +=
      exitance * lambertIrradiance(place, up, { corner, corner + u, corner + u + v, corner + v });
  }
  const Vector3 lamp(0.5, 0.5, 0.2);
  builder.addPointLight(lamp, 3);
  truth += 3 / (4 * M_PI) * 0.2 / std::pow((lamp - place).norm(), 3);
  const LitScene scene(builder);
  expectMean("many lamps", truth, [&](auto number) { return scene.inAir(place, up, number); });
}

// A strip is chosen from in pieces.
TEST(PointDirectLight, AlongAStrip)
{
  ObjectBuilder builder;
  const std::vector<Vector3> strip{ { 0, 0, 0.05 }, { 0.02, 0, 0.05 }, { 0.02, 3.6, 0.05 },
    { 0, 3.6, 0.05 } };
  builder.addQuad(strip[0], { 0, 3.6, 0 }, { 0.02, 0, 0 }, 1, 1, grey(0, 100));
  const LitScene scene(builder);
  const Vector3 place(0.03, 3.3, 0), up(0, 0, 1);
  expectMean("strip", 100 * lambertIrradiance(place, up, strip),
    [&](auto number) { return scene.inAir(place, up, number); });
}

// A point light has one point: there is no noise. In a corner of the floor walls touch the point
// and hide nothing.
TEST(PointDirectLight, OfAPointLightIsExact)
{
  ObjectBuilder builder = plainRoom({ 4, 3, 2 }, 3, grey(0));
  const Vector3 lamp(1, 1.3, 1.7);
  builder.addPointLight(lamp, 5);
  const LitScene scene(builder);
  const std::uint32_t floor = 2 * 9 * 4; // triangles of four sides before it
  for (const Vector3& place :
    { Vector3(0, 0, 0), Vector3(4. / 3, 0, 0), Vector3(4. / 3, 1, 0), Vector3(0.4, 0.1, 0) })
  {
    const double distance = (lamp - place).norm();
    const double truth = 5 / (4 * M_PI) * 1.7 / std::pow(distance, 3);
    int touching = 0;
    for (std::uint32_t triangle = floor; triangle < floor + 18; ++triangle)
    {
      const LitPoint point = scene.on(triangle, true, place);
      if ((point.position - place).norm() < 1e-6)
      {
        EXPECT_NEAR(scene.at(point, 3), truth, 1e-6 * truth) << place.transpose();
        ++touching;
      }
    }
    EXPECT_GE(touching, 1);
  }
}

// A face in the same place as a lamp receives what the lamp emits, and nothing from behind.
TEST(PointDirectLight, OnALightTable)
{
  ObjectBuilder builder;
  builder.addQuad({ 0, 0, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 1, 1, grey(0, 7));
  builder.addBox(box({ 0.5, 0.5, 0 }, { 1.5, 1.5, 1 }), 1, grey(0));
  const LitScene scene(builder);
  // The lower face of the box in z: side 4.
  for (const std::uint32_t triangle : { 2u + 2 * 4, 2u + 2 * 4 + 1 })
  {
    const LitPoint below = scene.on(triangle, true, { 0.9, 0.9, 0 });
    EXPECT_NEAR(scene.at(below, 1), 7, 1e-12);
    EXPECT_EQ(scene.at(scene.on(triangle, false, { 0.9, 0.9, 0 }), 1), 0) << "inside";
  }
  const LitPoint onLamp = scene.on(0, true, { 1.8, 0.2, 0 });
  EXPECT_EQ(scene.at(onLamp, 1), 0) << "its own light";
}

TEST(PointDirectLight, NumbersAndSeedsChooseTheSamples)
{
  const LitScene scene(panel()), other(panel(), 2);
  const Vector3 place(0.3, 0.2, 0.5), up(0, 0, 1);
  EXPECT_EQ(scene.inAir(place, up, 3), scene.inAir(place, up, 3));
  EXPECT_NE(scene.inAir(place, up, 3), scene.inAir(place, up, 4));
  EXPECT_NE(scene.inAir(place, up, 3), other.inAir(place, up, 3));
}

}
}
