// SPDX-License-Identifier: BSD-3-Clause
#include "Lights/SeenLight.h"

#include "EngineRun.h"
#include "LambertContour.h"

#include "../RayCasting/RandomVectors.h"
#include "Sampling/SobolPoint.h"

#include <gtest/gtest.h>

namespace irradiance
{

namespace
{

constexpr std::uint32_t kSamples = 1024;

/// What samples of all parts bring: pi times the irradiance from a radiance of 1.
struct Brought
{
  std::size_t parts = 0;
  double mean = 0, scatter = 0; ///< the scatter is relative, of the samples of each part
  double solidAngle = 0;        ///< sr: the mean of 1 / density
  double highest = -kInfinity, lowest = kInfinity; ///< cosines
};

Brought broughtBy(const Triangle& lamp, const LitPoint& point, SeenLight::By by)
{
  const Light light({}, AreaLight{ { 0, 0 }, lamp });
  const LampPiece piece{ 0, 1, 1, lamp, {} };
  std::vector<SeenLight> parts;
  SeenLight::addParts(light, piece, point, by, parts);
  Brought all;
  all.parts = parts.size();
  for (const SeenLight& part : parts)
  {
    const SampleKeys keys(7);
    double sum = 0, squares = 0, solidAngles = 0;
    for (std::uint32_t i = 0; i < kSamples; ++i)
    {
      const SeenLight::Sample seen = part.sample(SobolPoint::inUnitSquare(i, keys), point);
      EXPECT_GT(weightsInPlane(lamp, point.position - seen.along).minCoeff(), -1e-12);
      const double cosine = point.partOf(seen.along);
      all.highest = std::max(all.highest, cosine);
      all.lowest = std::min(all.lowest, cosine);
      sum += seen.solidAngle * cosine / kSamples;
      squares += std::pow(seen.solidAngle * cosine, 2) / kSamples;
      solidAngles += seen.solidAngle / kSamples;
    }
    all.mean += sum;
    all.scatter = std::max(all.scatter, std::sqrt(squares / (sum * sum) - 1));
    all.solidAngle += solidAngles;
  }
  return all;
}

}

// Lambert's formula for what is above the horizon, for random triangles, of which many cross it.
// The error of 1024 points of low discrepancy is some 1e-4 here, that of a wrong density some 1e-1.
TEST(SeenLight, ByCosineItBringsWhatIsAboveTheHorizon)
{
  test::RandomVectors random(3);
  int crossing = 0, hidden = 0;
  for (int i = 0; i < (test::kIsSanitized ? 30 : 300); ++i)
  {
    const LitPoint point{ 0.3 * random.inCube(), random.direction() };
    const Vector3 middle = 2 * random.direction();
    const Triangle lamp{ middle + random.inCube(), middle + random.inCube(),
      middle + random.inCube() };
    const Brought brought = broughtBy(lamp, point, SeenLight::By::Cosine);
    const std::vector<Vector3> above =
      test::aboveHorizon({ lamp.a, lamp.b, lamp.c }, point.position, point.normal);
    ASSERT_EQ(brought.parts, above.empty() ? 0 : above.size() - 2);
    hidden += above.empty() ? 1 : 0;
    if (above.empty())
    {
      continue;
    }
    const double truth = M_PI * test::lambertIrradiance(point.position, point.normal, above);
    EXPECT_NEAR(brought.mean, truth, 3e-3 * truth) << i;
    EXPECT_GT(brought.lowest, -1e-9);
    crossing += brought.lowest < 0.05 ? 1 : 0;
  }
  EXPECT_TRUE(test::kIsSanitized || (crossing > 30 && hidden > 30)) << crossing << ", " << hidden;
}

// A small triangle that stands on the horizon, as from afar the cosine is linear on it: with the
// distance s from the corner above, of density 2 s, samples bring (1 - s) / (1 - s^2) up to a
// factor. The squares of that scatter by 9 (1.5 - 2 ln 2) - 1 = .0233. By solid angle it would be
// those of 1 - s: 1/2.
TEST(SeenLight, ByCosineSamplesBringNearlyTheSame)
{
  const LitPoint point{ Vector3::Zero(), Vector3::UnitZ() };
  const Triangle lamp{ { 100, -1, 0 }, { 100, 0, 1 }, { 100, 1, 0 } };
  for (const Triangle& turned :
    { lamp, Triangle{ lamp.b, lamp.c, lamp.a }, Triangle{ lamp.c, lamp.a, lamp.b } })
  {
    const double cosine = broughtBy(turned, point, SeenLight::By::Cosine).scatter;
    const double solidAngle = broughtBy(turned, point, SeenLight::By::SolidAngle).scatter;
    EXPECT_NEAR(cosine, std::sqrt(9 * (1.5 - 2 * std::log(2.0)) - 1), 0.01);
    EXPECT_NEAR(solidAngle, std::sqrt(0.5), 0.01);
  }
}

// In all directions alike: the solid angle, each sample the same.
TEST(SeenLight, WithoutANormalItGoesBySolidAngle)
{
  const LitPoint point{ Vector3::Zero(), Vector3::Zero() };
  const Triangle octant{ { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  const Brought brought = broughtBy(octant, point, SeenLight::By::Cosine);
  EXPECT_NEAR(brought.mean, M_PI / 2, 1e-7); // places keep off the edges a little
  EXPECT_NEAR(brought.solidAngle, M_PI / 2, 1e-12);
  EXPECT_LT(brought.scatter, 1e-7);
}

}
