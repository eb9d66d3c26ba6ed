// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/KeyFrames.h"

#include "Progress/InputError.h"

#include <gtest/gtest.h>

#include <cmath>

namespace irradiance
{

namespace
{

AffineMap turned(double degrees, const Vector3& position = Vector3::Zero())
{
  const Eigen::AngleAxisd turn(degrees * M_PI / 180, Vector3::UnitZ());
  return { turn.toRotationMatrix(), position };
}

void expectNear(const AffineMap& a, const AffineMap& b)
{
  EXPECT_LT((a.linear - b.linear).norm(), 1e-13) << a.linear;
  EXPECT_LT((a.translation - b.translation).norm(), 1e-13) << a.translation.transpose();
}

}

TEST(KeyFrames, AKeyIsItsPoseBitForBit)
{
  const std::vector<KeyFrame> keys{ { "a", 0, turned(10, { 0.1, 0.2, 0.3 }) },
    { "b", 0.7, turned(77, { 1, 0, 0 }) }, { "c", 1, turned(33.3, { 0, 5, 0 }) } };
  for (const auto way :
    { KeyInterpolation::Linear, KeyInterpolation::Spline, KeyInterpolation::Step })
  {
    const KeyFrames frames(keys, way, {});
    for (const KeyFrame& key : keys)
    {
      EXPECT_TRUE(frames.at(key.time) == key.worldFromObject) << key.name;
    }
  }
}

TEST(KeyFrames, BetweenKeys)
{
  const std::vector<KeyFrame> keys{ { "a", 0, turned(170, { 1, 0, 0 }) },
    { "b", 4, turned(-150, { 3, 4, 0 }) } };
  // By the shorter way: 40 degrees, not 320. Two keys have no bend.
  expectNear(KeyFrames(keys, KeyInterpolation::Linear, {}).at(1), turned(180, { 1.5, 1, 0 }));
  expectNear(KeyFrames(keys, KeyInterpolation::Spline, {}).at(1), turned(180, { 1.5, 1, 0 }));
  expectNear(KeyFrames(keys, KeyInterpolation::Step, {}).at(3.9), turned(170, { 1, 0, 0 }));
}

// Catmull and Rom's splines hold parabolas between inner keys, also where distances of keys differ.
TEST(KeyFrames, SplinesKeepParabolas)
{
  const auto pose = [](double t) {
    return turned(20 * t - 3 * t * t, { t * t, 1 - 2 * t, 0.5 * t });
  };
  std::vector<KeyFrame> keys;
  for (const double time : { 0.0, 1.0, 1.5, 3.0, 3.25, 4.0 })
  {
    keys.push_back({ "", time, pose(time) });
  }
  const KeyFrames frames(keys, KeyInterpolation::Spline, {});
  for (double time = 1; time < 3.25; time += 0.125)
  {
    expectNear(frames.at(time), pose(time));
  }
}

TEST(KeyFrames, RefusesShearAndMirrorsBetweenKeys)
{
  AffineMap sheared, mirrored;
  sheared.linear(0, 1) = 0.1;
  mirrored.linear(0, 0) = -1;
  for (const AffineMap& bad : { sheared, mirrored })
  {
    const std::vector<KeyFrame> keys{ { "a", 0, AffineMap() }, { "b", 1, bad } };
    EXPECT_THROW(KeyFrames(keys, KeyInterpolation::Linear, {}), InputError);
    EXPECT_TRUE(KeyFrames(keys, KeyInterpolation::Step, {}).at(1) == bad);
  }
  EXPECT_THROW(
    KeyFrames({ { "a", 1, {} }, { "b", 1, {} } }, KeyInterpolation::Step, {}), InputError);
}

}
