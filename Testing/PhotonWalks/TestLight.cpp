// SPDX-License-Identifier: BSD-3-Clause
#include "Kit.h"
#include "LambertContour.h"
#include "Lights/SeenLight.h"
#include "Sampling/SobolPoint.h"
#include "Sampling/WeightChoice.h"

namespace irradiance::test
{
namespace
{

/// A light of each kind above the plane z = 0; in the air, in a wall, and in a corner of two walls,
/// of which one leans.
std::vector<Light> lightsOfAllKinds()
{
  const Wall ceiling{ { 0, 0, -1 }, 0, 1e-9 }, leaning{ { 0.6, 0, -0.8 }, 0, 1e-9 };
  return { { {}, AreaLight{ { 0, 0 }, { { 0, 0, 1 }, { 0.2, 0.9, 1.2 }, { 0.8, 0, 1.1 } } } },
    { {}, PointLight({ 0.3, 0.4, 1 }, {}) }, { {}, PointLight({ 0.3, 0.4, 1 }, { ceiling }) },
    { {}, PointLight({ 0.3, 0.4, 1 }, { ceiling, leaning }) } };
}

std::vector<SeenLight> seenFrom(const Light& light, const LampPiece& piece, const LitPoint& point)
{
  std::vector<SeenLight> parts;
  SeenLight::addParts(light, piece, point, SeenLight::By::Cosine, parts);
  return parts;
}

LampPiece pieceOf(const Light& light)
{
  std::vector<LampPiece> pieces;
  addPieces(light, 0, kInfinity, pieces);
  return pieces.front();
}

/// W/m2 at a point of a plane for each W.
double arrivingAt(const LitPoint& point, const Light& light, const LampPiece& piece)
{
  constexpr std::uint32_t kSamples = 16;
  double sum = 0;
  for (const SeenLight& part : seenFrom(light, piece, point))
  {
    for (std::uint32_t i = 0; i < kSamples; ++i)
    {
      const std::array<double, 2> u = SobolPoint::inUnitSquare(i, SampleKeys(1));
      const SeenLight::Sample seen = part.sample(u, point);
      sum += seen.isLit() ? seen.perWatt(point.partOf(seen.along)) / kSamples : 0;
    }
  }
  return sum;
}

// What arrives in a square below the light, by what its points see, is the part of the rays that
// leave the light and meet the square: within 5 standard deviations of their number, so one light
// in 1.7e6 fails by chance.
TEST(Light, WhatArrivesIsWhatLeaves)
{
  const std::vector<Light> lights = lightsOfAllKinds();
  for (std::size_t number = 0; number < lights.size(); ++number)
  {
    const Light& light = lights[number];
    const LampPiece piece = pieceOf(light);
    constexpr int kEdge = 64;
    double arriving = 0;
    for (int i = 0; i < kEdge * kEdge; ++i)
    {
      const Vector3 place((i % kEdge + 0.5) / kEdge, (i / kEdge + 0.5) / kEdge, 0);
      arriving += arrivingAt({ place, Vector3::UnitZ() }, light, piece) / (kEdge * kEdge);
    }
    constexpr int kRays = 400000;
    std::mt19937_64 random(number + 1);
    std::uniform_real_distribution<double> uniform(0x1p-53, 1);
    int meeting = 0;
    for (int i = 0; i < kRays; ++i)
    {
      const std::array<double, 2> place{ uniform(random), uniform(random) };
      const Ray ray = light.leaving(place, { uniform(random), uniform(random) });
      ASSERT_EQ(ray.start, light.triangle());
      const Vector3 end = ray.origin - ray.origin[2] / ray.direction[2] * ray.direction;
      meeting += ray.direction[2] < 0 && end[0] > 0 && end[0] < 1 && end[1] > 0 && end[1] < 1;
    }
    const double part = static_cast<double>(meeting) / kRays;
    EXPECT_NEAR(part, arriving, 5 * std::sqrt(arriving * (1 - arriving) / kRays)) << number;
  }
}

// Over all directions the intensity of 1 W is 1 W.
TEST(Light, TheIntensityIntegratesToTheFlux)
{
  const std::vector<Light> lights = lightsOfAllKinds();
  for (std::size_t number = 0; number < lights.size(); ++number)
  {
    const LightPlace from = lights[number].place({ 0.2, 0.3, 0.5 });
    constexpr std::uint32_t kDirections = 65536;
    double sum = 0;
    for (std::uint32_t i = 0; i < kDirections; ++i)
    {
      const Vector3 along = sampleSphere(SobolPoint::inUnitSquare(i, SampleKeys(3)));
      const SurfacePoint to{ from.position() + 2 * along, -along, 0, true };
      sum += from.leaving(to.position) * from.perSteradian(to);
    }
    EXPECT_NEAR(4 * M_PI * sum / kDirections, 1, 2e-3) << number;
  }
}

// The mean of 1 / density over places is the solid angle of what they are chosen from; in the air
// there is one place, and the intensity over the squared distance.
TEST(Light, TheDensityOfPlacesIntegratesToOne)
{
  const std::vector<Light> lights = lightsOfAllKinds();
  const LitPoint point{ { 0.9, 0.8, 0 }, Vector3::UnitZ() };
  for (const Light& light : lights)
  {
    const LampPiece piece = pieceOf(light);
    const std::vector<SeenLight> parts = seenFrom(light, piece, point);
    ASSERT_EQ(parts.size(), 1u);
    constexpr std::uint32_t kSamples = 4096;
    double sum = 0;
    for (std::uint32_t i = 0; i < kSamples; ++i)
    {
      sum += parts[0].sample(SobolPoint::inUnitSquare(i, SampleKeys(5)), point).solidAngle;
    }
    EXPECT_NEAR(sum / kSamples, parts[0].solidAngle(), 1e-3 * parts[0].solidAngle());
    EXPECT_EQ(light.surface() == nullptr, parts[0].solidAngle() == 0);
  }
  const LampPiece inAir = pieceOf(lights[1]);
  const SeenLight::Sample only = seenFrom(lights[1], inAir, point)[0].sample({}, point);
  EXPECT_NEAR(only.perWatt(1), 1 / (4 * M_PI * only.along.squaredNorm()), 1e-15);
}

// A cut lamp has all of its light, and each piece is as large as its share.
TEST(Light, PiecesAreTheWholeLight)
{
  Light strip({}, AreaLight{ { 0, 0 }, { { 0, 0, 1 }, { 0, 0.01, 1 }, { 3, 0, 1 } } });
  strip.flux = { 1, 2, 3 };
  std::vector<LampPiece> pieces;
  addPieces(strip, 7, 0.1, pieces);
  ASSERT_GT(pieces.size(), 4u);
  double flux = 0, area = 0;
  for (const LampPiece& piece : pieces)
  {
    EXPECT_EQ(piece.light, 7u);
    EXPECT_TRUE(piece.cone.isFlat());
    EXPECT_NEAR(piece.triangle.area(), piece.share * strip.surface()->area(), 1e-15);
    flux += piece.flux;
    area += piece.triangle.area();
  }
  EXPECT_NEAR(flux, 6, 1e-12);
  EXPECT_NEAR(area, strip.surface()->area(), 1e-15);
}

// Of weights among which some are 0, the first up to and including which there is more.
TEST(WeightChoice, APartOfTheSumFallsOnAWeight)
{
  std::mt19937_64 random(2);
  for (std::size_t size = 1; size < 40; ++size)
  {
    std::vector<double> cumulative;
    double sum = 0;
    for (std::size_t i = 0; i < size; ++i)
    {
      cumulative.push_back(sum += static_cast<double>(random() % 3));
    }
    for (double at = 0; at <= sum; at += 0.5)
    {
      const auto found = std::upper_bound(cumulative.begin(), cumulative.end() - 1, at);
      EXPECT_EQ(placeByWeight(cumulative, at), std::size_t(found - cumulative.begin()));
    }
  }
}

// One that is halved and one that is not are evenly filled by what a choice leaves.
TEST(WeightChoice, OfTwoTheFirstIsChosenByItsProbability)
{
  double first = 0.1, second = 0.6;
  EXPECT_TRUE(choosesFirst(0.25, first));
  EXPECT_NEAR(first, 0.4, 1e-15);
  EXPECT_FALSE(choosesFirst(0.25, second));
  EXPECT_NEAR(second, 0.35 / 0.75, 1e-15);
}

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

// Lambert's formula for what is above the horizon, for random triangles, of which many cross it.
// The error of 1024 points of low discrepancy is some 1e-4 here, that of a wrong density some 1e-1.
TEST(SeenLight, ByCosineItBringsWhatIsAboveTheHorizon)
{
  RandomVectors random(3);
  int crossing = 0, hidden = 0;
  for (int i = 0; i < (kIsSanitized ? 30 : 300); ++i)
  {
    const LitPoint point{ 0.3 * random.inCube(), random.direction() };
    const Vector3 middle = 2 * random.direction();
    const Triangle lamp{ middle + random.inCube(), middle + random.inCube(),
      middle + random.inCube() };
    const Brought brought = broughtBy(lamp, point, SeenLight::By::Cosine);
    const std::vector<Vector3> above =
      aboveHorizon({ lamp.a, lamp.b, lamp.c }, point.position, point.normal);
    ASSERT_EQ(brought.parts, above.empty() ? 0 : above.size() - 2);
    hidden += above.empty() ? 1 : 0;
    if (above.empty())
    {
      continue;
    }
    const double truth = M_PI * lambertIrradiance(point.position, point.normal, above);
    EXPECT_NEAR(brought.mean, truth, 3e-3 * truth) << i;
    EXPECT_GT(brought.lowest, -1e-9);
    crossing += brought.lowest < 0.05 ? 1 : 0;
  }
  EXPECT_TRUE(kIsSanitized || (crossing > 30 && hidden > 30)) << crossing << ", " << hidden;
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
}
