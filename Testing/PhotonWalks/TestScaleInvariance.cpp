// SPDX-License-Identifier: BSD-3-Clause
#include "EngineRun.h"
#include "MovingScene.h"

#include <gtest/gtest.h>

namespace irradiance
{

namespace
{

using test::MovingScene;

SceneObject scaledModel(const SceneObject& object, double scale)
{
  std::vector<Triangle> triangles;
  for (const Triangle& t : object.body->mesh().triangles())
  {
    triangles.push_back({ t.a * scale, t.b * scale, t.c * scale });
  }
  SceneObject result = object;
  if (object.emission)
  {
    Emission emission = *object.emission;
    for (PointSource& light : emission.points)
    {
      light.position *= scale;
      light.flux[0] *= scale * scale; // as much per m2
    }
    result.emission = std::make_shared<Emission>(emission);
  }
  result.body = std::make_shared<RigidObject>(TriangleMesh(triangles));
  return result;
}

/// The scene in another unit of length: either the models or their poses are scaled.
class ScaledScene
{
public:
  ScaledScene(const SceneObjects& objects, double scale, bool scalesModels)
    : scale_(scale)
    , scalesModels_(scalesModels)
    , objects_(objects)
  {
    objects_.staticObject = scaledModel(objects.staticObject, scale);
    for (SceneObject& object : objects_.dynamicObjects)
    {
      object = scalesModels ? scaledModel(object, scale) : object;
    }
  }

  const SceneObjects& at(const SceneObjects& frame)
  {
    for (std::size_t i = 0; i < frame.dynamicObjects.size(); ++i)
    {
      AffineMap pose = frame.dynamicObjects[i].worldFromObject;
      pose.translation *= scale_;
      pose.linear *= scalesModels_ ? 1 : scale_;
      objects_.dynamicObjects[i].worldFromObject = pose;
    }
    return objects_;
  }

private:
  double scale_;
  bool scalesModels_;
  SceneObjects objects_;
};

/// A few frames in both units: the sums are the same integers, the irradiance is the same double.
void compareAtScale(int exponent, bool scalesModels)
{
  MovingScene scene(1, false, 51, true);
  ScaledScene other(scene.objects(), std::ldexp(1.0, exponent), scalesModels);
  SceneObjects frame = scene.objects();
  EngineSettings settings;
  settings.numberOfWalks = test::scaled(20000);
  IrradianceEngine unit, scaled;
  Execution execution;
  for (int i = 0; i < 4; ++i, scene.nextFrame())
  {
    for (std::size_t k = 0; k < frame.dynamicObjects.size(); ++k)
    {
      frame.dynamicObjects[k].worldFromObject = scene.objects().dynamicObjects[k].worldFromObject;
    }
    const SceneObjects& big = other.at(frame);
    unit.update(frame, settings, execution);
    scaled.update(big, settings, execution);
    ASSERT_TRUE(test::answerOf(unit, frame) == test::answerOf(scaled, big))
      << "2^" << exponent << ", models " << scalesModels << ", frame " << i;
    for (std::uint32_t object = 0; object < frame.size(); ++object)
    {
      for (std::size_t cell = 0; cell < unit.cells().numbers().sizeOf(object); ++cell)
      {
        ASSERT_EQ(unit.irradiance({ object, cell }, 0), scaled.irradiance({ object, cell }, 0));
      }
    }
  }
}

}

TEST(ScaleInvariance, ScaledModels)
{
  for (const int exponent : { -20, -3, 1, 10, 30 })
  {
    compareAtScale(exponent, true);
  }
}

TEST(ScaleInvariance, ScaledPoses)
{
  for (const int exponent : { -20, -3, 1, 10, 30 })
  {
    compareAtScale(exponent, false);
  }
}

// Flux alone in another unit: the same quanta.
TEST(ScaleInvariance, ScaledFlux)
{
  for (const int exponent : { -60, -1, 40 })
  {
    test::Answer answers[2];
    for (const bool isScaled : { false, true })
    {
      test::ObjectBuilder room;
      room.addBox(test::box({ 0, 0, 0 }, { 1, 2, 3 }), 2, test::grey(0.7), true);
      room.addPointLight({ 0.1, 0.7, 2.2 }, isScaled ? std::ldexp(1.7, exponent) : 1.7);
      EngineSettings settings;
      settings.numberOfWalks = test::scaled(5000);
      answers[isScaled ? 1 : 0] = test::freshAnswer({ room.build(), {} }, settings);
    }
    EXPECT_TRUE(answers[0] == answers[1]) << "2^" << exponent;
  }
}

}
