// SPDX-License-Identifier: BSD-3-Clause
#include "BothModes.h"
#include "TestScenes.h"

#include "../RayCasting/RandomVectors.h"

#include <gtest/gtest.h>

namespace irradiance
{

namespace
{

using test::box;
using test::Look;
using test::ObjectBuilder;
using test::ReplicateMean;

constexpr int kFrames = test::kIsSanitized ? 20 : 100;
constexpr int kCellsASide = 3;

/// Every cell has its own reflectance in each band and the exitance 1 - reflectance, so E = 1
/// everywhere.
SceneObject furnace(ObjectBuilder builder, test::RandomVectors& random)
{
  std::vector<double>& reflectance = builder.material().reflectance;
  for (std::size_t i = 0; i < reflectance.size(); ++i)
  {
    reflectance[i] = random.uniform(0, 0.9);
    builder.emission().exitance[i] = 1 - reflectance[i];
  }
  return builder.build();
}

/// The same with a part of the reflectance that is specular, with lobes from wide to mirrors.
SceneObject glossyFurnace(ObjectBuilder builder, test::RandomVectors& random)
{
  SceneObject object = furnace(std::move(builder), random);
  Material material = *object.material;
  const std::array<double, 5> exponents{ 0, 1, 15, 1000, kInfinity };
  std::vector<double> specular, chosen;
  for (double& reflectance : material.reflectance)
  {
    specular.push_back(random.uniform(0, 1) * reflectance);
    reflectance -= specular.back();
  }
  for (std::size_t cell = 0; cell < material.numberOfCells; ++cell)
  {
    chosen.push_back(exponents[random.engine() % exponents.size()]);
  }
  material.setSpecular(specular, chosen);
  object.material = std::make_shared<Material>(material);
  return object;
}

/// An object that reflects all light emits none, so it moves without a change of the lights.
SceneObject white(ObjectBuilder builder)
{
  for (double& reflectance : builder.material().reflectance)
  {
    reflectance = 1;
  }
  return builder.build();
}

ObjectBuilder room(int bands = 1)
{
  ObjectBuilder builder(bands);
  builder.addBox(box({ 0, 0, 0 }, { 4, 3, 5 }), kCellsASide, {}, true);
  return builder;
}

std::vector<ObjectBuilder> movingThings(int bands = 1)
{
  ObjectBuilder a(bands), b(bands);
  a.addBox(box({ -0.5, -0.3, -0.4 }, { 0.5, 0.3, 0.4 }), 1, {});
  b.addSphere({ 0, 0, 0 }, 0.6, 4, {});
  return { a, b };
}

/// The two objects circle without touching each other or a wall.
void setPoses(SceneObjects& objects, int frame)
{
  const double angle = 0.0628 * frame;
  objects.dynamicObjects[0].worldFromObject = {
    Eigen::AngleAxisd(3 * angle, Vector3(1, 2, 2) / 3).toRotationMatrix(),
    { 2 + 0.9 * std::cos(angle), 1.5, 2.5 + 1.5 * std::sin(angle) }
  };
  objects.dynamicObjects[1].worldFromObject = {
    Eigen::AngleAxisd(angle, Vector3(0, 0.6, 0.8)).toRotationMatrix(),
    { 2 - 0.9 * std::cos(angle), 1.5, 2.5 - 1.5 * std::sin(angle) }
  };
}

/// One estimate of a band for each cell, wall and object.
class FurnaceEstimates
{
public:
  explicit FurnaceEstimates(int band = 0)
    : band_(band)
  {
  }

  void add(const IrradianceEngine& engine, const SceneObjects& objects)
  {
    std::size_t cellIndex = 0, areaIndex = 0;
    for (std::uint32_t object = 0; object < objects.size(); ++object)
    {
      const std::vector<double> areas = cellAreas(objects[object]);
      const std::size_t group = object == 0 ? kCellsASide * kCellsASide : areas.size();
      for (std::size_t first = 0; first < areas.size(); first += group)
      {
        double area = 0;
        for (std::size_t cell = first; cell < first + group; ++cell)
        {
          area += areas[cell];
          at(cells_, cellIndex++).add(engine.irradiance({ object, cell }, band_));
        }
        at(areas_, areaIndex++)
          .add(test::wattsOn(engine, object, first, first + group, band_) / area);
      }
    }
  }

  /// `limit` bounds |t| of an area mean. All cells together: chi-square of t, with the variance
  /// n / (n - 2) of Student's t; chance exceeds it once in 10^4 (cells taken as independent).
  void expectOne(double limit) const
  {
    for (const ReplicateMean& area : areas_)
    {
      area.print("area mean", 1);
      EXPECT_LE(std::abs(area.t(1)), limit);
      EXPECT_NEAR(area.mean(), 1, test::kIsSanitized ? 0.15 : 0.03);
    }
    double chiSquare = 0, worst = 0;
    for (const ReplicateMean& cell : cells_)
    {
      chiSquare += cell.t(1) * cell.t(1);
      worst = std::max(worst, std::abs(cell.t(1)));
    }
    const double freedom = cells_[0].count() - 1.0, count = double(cells_.size());
    EXPECT_LE(chiSquare * (freedom - 2) / freedom, test::chiSquareLimit(count, 3.72) * 1.1);
    std::printf("%.0f cells, %d estimates each: chi-square %.1f, largest |t| %.2f\n", count,
      cells_[0].count(), chiSquare * (freedom - 2) / freedom, worst);
  }

private:
  static ReplicateMean& at(std::vector<ReplicateMean>& all, std::size_t i)
  {
    all.resize(std::max(all.size(), i + 1));
    return all[i];
  }

  int band_;
  std::vector<ReplicateMean> cells_, areas_;
};

class Furnace : public test::BothModes
{
protected:
  /// Shoots every frame again, with its own seed.
  static void expectOneInEveryFrame(SceneObjects& objects, std::uint64_t firstSeed)
  {
    IrradianceEngine engine;
    Execution execution;
    std::vector<FurnaceEstimates> estimates;
    for (int band = 0; band < objects.staticObject.material->bands; ++band)
    {
      estimates.emplace_back(band);
    }
    const std::uint32_t walks = test::scaled(8192) * (test::kIsSanitized ? 4 : 1);
    for (int frame = 0; frame < kFrames; ++frame)
    {
      setPoses(objects, frame);
      engine.update(
        objects, settingsFor(firstSeed + static_cast<std::uint64_t>(frame), walks), execution);
      EXPECT_TRUE(isGathered() || engine.balance().escaped.isZero());
      for (FurnaceEstimates& estimate : estimates)
      {
        estimate.add(engine, objects);
      }
    }
    for (const FurnaceEstimates& estimate : estimates)
    {
      estimate.expectOne(3.5);
    }
  }
};

// All cells shine, also on moving objects, so every frame is shot again, with its own seed. 8
// area means, |t| > 3.5 of 99 degrees: a false alarm in 0.6 % of all choices of seeds.
TEST_P(Furnace, EveryCellReceivesOneWattWhileAllCellsShine)
{
  test::RandomVectors random(81);
  SceneObjects objects{ furnace(room(), random), {} };
  for (const ObjectBuilder& thing : movingThings())
  {
    objects.dynamicObjects.push_back(furnace(thing, random));
  }
  expectOneInEveryFrame(objects, 1);
}

// The radiance in a furnace is the same in all directions. A lobe that loses light at some angle,
// or whose light leaves with a distribution that is not reciprocal, changes it. Area means as
// above.
TEST_P(Furnace, EveryCellReceivesOneWattWhereCellsReflectSpecularly)
{
  test::RandomVectors random(83);
  SceneObjects objects{ glossyFurnace(room(), random), {} };
  for (const ObjectBuilder& thing : movingThings())
  {
    objects.dynamicObjects.push_back(glossyFurnace(thing, random));
  }
  expectOneInEveryFrame(objects, 1001);
}

// The same in three bands, each of which walks carry in another share.
TEST_P(Furnace, EveryCellReceivesOneWattInEveryBand)
{
  test::RandomVectors random(84);
  SceneObjects objects{ glossyFurnace(room(3), random), {} };
  for (const ObjectBuilder& thing : movingThings(3))
  {
    objects.dynamicObjects.push_back(glossyFurnace(thing, random));
  }
  expectOneInEveryFrame(objects, 2001);
}

// White objects move in a shining room: walks are verified and repaired from frame to frame. The
// last frames of 16 seeds of 65,536 walks are compared; 8 area means, |t| > 4 of 15 degrees: a
// false alarm in 0.9 %.
TEST_P(Furnace, EveryCellReceivesOneWattAfterManyUpdates)
{
  test::RandomVectors random(82);
  SceneObjects objects{ furnace(room(), random), {} };
  for (const ObjectBuilder& thing : movingThings())
  {
    objects.dynamicObjects.push_back(white(thing));
  }
  FurnaceEstimates estimates;
  const int frames = kFrames / 20;
  for (std::uint64_t seed = 1; seed <= 16; ++seed)
  {
    IrradianceEngine engine;
    Execution execution;
    const EngineSettings settings = settingsFor(seed, test::scaled(65536));
    for (int frame = 0; frame < frames; ++frame)
    {
      setPoses(objects, 20 * frame);
      engine.update(objects, settings, execution);
      EXPECT_EQ(engine.statistics().shootSeconds > 0, frame == 0);
    }
    estimates.add(engine, objects);
  }
  estimates.expectOne(4);
}

INSTANTIATE_TEST_SUITE_P(DirectLight, Furnace, testing::Bool(), test::nameOfMode);

}

}
