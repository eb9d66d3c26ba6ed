// SPDX-License-Identifier: BSD-3-Clause
#include "Lights/DistantLight.h"

#include "Kit.h"
#include "Skies.h"

namespace irradiance::test
{
namespace
{

const Box kLit = box({ -1, 2, 0.5 }, { 3, 3, 2.5 });

/// m2, seen along a direction.
double seenArea(const Vector3& d)
{
  const Vector3 size = kLit.extent();
  return std::abs(d[0]) * size[1] * size[2] + std::abs(d[1]) * size[0] * size[2] +
    std::abs(d[2]) * size[0] * size[1];
}

Sky tableOf(const std::vector<double>& polarAngles, const std::vector<double>& azimuths)
{
  Sky sky;
  sky.lit = kLit;
  sky.polarAngles = polarAngles;
  sky.azimuths = azimuths;
  sky.radiance.assign(polarAngles.size() * azimuths.size(), 1);
  sky.bandWeights = { 1 };
  return sky;
}

/// The square of random numbers, in (0, 1).
std::array<double, 2> randomSquare(RandomVectors& random)
{
  const double first = random.uniform(0x1p-40, 1 - 0x1p-40);
  return { first, random.uniform(0x1p-40, 1 - 0x1p-40) };
}

// What parts bring together is all of the light, so none is without a part; also that of tables
// that end, begin and are bent anywhere.
TEST(DistantLight, PartsHoldAllOfTheLight)
{
  const double all = 4 * M_PI;
  const struct
  {
    Sky sky;
    double solidAngle; ///< of the parts; 0: not said
  } cases[] = { { tableOf({ 0, 90 }, { 0 }), all / 2 }, { tableOf({ 0, 180 }, { 0 }), all },
    { skyOf(kLit, cieSky(12)), all / 2 }, { skyOf(kLit, uniformSky, 0.1), all },
    { tableOf({ 90, 180 }, { 0, 360 }), all / 2 }, { tableOf({ 0, 11.6 }, { 0 }), 0 },
    { tableOf({ 22.3, 33.8 }, { 44.5, 90.3 }), 0 }, { tableOf({ 89, 90.2 }, { -30, 60 }), 0 },
    { tableOf({ 0, 40, 101 }, { -170, 13, 190 }), 0 },
    { sunOnly(kLit, skyDirection(40, 10), 500, 0.1), 2 * M_PI * (1 - std::cos(0.1)) } };
  for (const auto& one : cases)
  {
    const bool isSun = one.sky.radiance.empty();
    const DistantLight light = isSun ? DistantLight::sunOf(one.sky) : DistantLight(one.sky);
    double flux = 0, solidAngle = 0, brought = 0;
    for (const DistantLight::Part& part : light.parts())
    {
      flux += part.flux;
      solidAngle += part.solidAngle();
      constexpr int kSteps = 48;
      for (int i = 0; i < kSteps * kSteps; ++i)
      {
        const double u = (i / kSteps + 0.5) / kSteps, v = (i % kSteps + 0.5) / kSteps;
        const DistantLight::Sample sample = light.sample(part, { u, v });
        EXPECT_NEAR(sample.solidAngle, part.solidAngle(), 1e-12);
        EXPECT_LE(std::acos(std::min(1.0, sample.direction.dot(part.middle))), part.radius + 1e-7);
        brought += sample.perWatt * seenArea(sample.direction) / kSteps / kSteps;
      }
    }
    EXPECT_NEAR(flux, 1, 1e-3) << "case " << &one - cases;
    EXPECT_NEAR(brought, 1, one.solidAngle > 0 ? 1e-3 : 0.04) << "case " << &one - cases;
    EXPECT_NEAR(solidAngle, one.solidAngle > 0 ? one.solidAngle : solidAngle, 1e-9);
  }
}

// Cauchy: on average over all directions a convex body is seen as a quarter of its surface.
TEST(DistantLight, ExtentIsWhatEntersTheBox)
{
  const Vector3 size = kLit.extent();
  const double surface = 2 * (size[0] * size[1] + size[1] * size[2] + size[2] * size[0]);
  EXPECT_NEAR(DistantLight(tableOf({ 0, 180 }, { 0 })).extent(), M_PI * surface, 1e-3 * surface);
  EXPECT_NEAR(DistantLight(tableOf({ 0, 90 }, { 0 })).extent(), M_PI / 2 * surface, 1e-3 * surface);
  for (const RadianceOf& radiance : { cieSky(1), cieSky(12), cieSky(13) })
  {
    const double truth =
      overDirections([&](const Vector3& d) { return radiance(d) * seenArea(d); }, 720, true);
    EXPECT_NEAR(DistantLight(skyOf(kLit, radiance)).extent(), truth, 1e-3 * truth);
  }
  const Vector3 sun = skyDirection(50, 200);
  EXPECT_NEAR(DistantLight::sunOf(sunOnly(kLit, sun, 1)).extent(), seenArea(sun), 1e-9);
}

TEST(DistantLight, EntersTheBoxOnTheWay)
{
  RandomVectors random(3);
  const DistantLight light(skyOf(kLit, uniformSky));
  for (int i = 0; i < 10000; ++i)
  {
    const Vector3 middle = kLit.center(), half = kLit.extent() / 2;
    const Vector3 within = middle + half.cwiseProduct(random.inCube());
    Vector3 direction = random.direction();
    direction[i % 3] *= i % 7 == 0 ? 0 : 1;
    direction.normalize();
    const Vector3 entry = light.entry(within, direction), way = entry - within;
    EXPECT_NEAR((entry - middle).cwiseAbs().cwiseQuotient(half).maxCoeff(), 1, 1e-12);
    EXPECT_NEAR(way.dot(direction), way.norm(), 1e-12);
    // From outside the way goes on until all of the box is behind.
    const Vector3 outside = middle + 6 * half.norm() * random.direction();
    const Vector3 far = light.entry(outside, direction);
    EXPECT_GT((far - middle).dot(direction), half.dot(direction.cwiseAbs()));
    EXPECT_NEAR((far - outside).dot(direction), (far - outside).norm(), 1e-9);
  }
}

/// Of counts with expected shares of all: by chance beyond in 3e-5 of the comparisons.
void expectShares(const std::vector<int>& counts, const std::vector<double>& shares)
{
  const double all = std::accumulate(counts.begin(), counts.end(), 0.0);
  double square = 0, kinds = 0;
  for (std::size_t i = 0; i < counts.size(); ++i)
  {
    const double expected = all * shares[i];
    kinds += expected > 5 ? 1 : 0;
    square += expected > 5 ? std::pow(counts[i] - expected, 2) / expected : 0;
    EXPECT_TRUE(expected > 5 || counts[i] < 30) << i;
  }
  EXPECT_LT(square, chiSquareLimit(kinds - 1, 4));
  EXPECT_GT(square, chiSquareLimit(kinds - 1, -4));
}

// The faces that the light meets, each in 8 x 8 bins, have shares by their area as it is seen.
TEST(DistantLight, EntersEvenlyOverTheBoxAsItIsSeen)
{
  RandomVectors random(4);
  constexpr int kBins = 8;
  for (const Vector3& sun :
    { skyDirection(30, 20), skyDirection(80, 250), skyDirection(0, 0), skyDirection(135, 100) })
  {
    const DistantLight light = DistantLight::sunOf(sunOnly(kLit, sun, 1));
    std::vector<int> counts(3 * kBins * kBins);
    std::vector<double> shares;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double face = kLit.extent().prod() / kLit.extent()[axis];
      shares.insert(
        shares.end(), kBins * kBins, std::abs(sun[axis]) * face / seenArea(sun) / kBins / kBins);
    }
    for (int i = 0; i < 40000; ++i)
    {
      const std::array<double, 2> place = randomSquare(random);
      const Ray ray = light.leaving(place, randomSquare(random));
      EXPECT_LT((ray.direction + sun).norm(), 1e-12);
      const Vector3 at = (ray.origin - kLit.lower).cwiseQuotient(kLit.extent());
      Eigen::Index axis = 0;
      (at - Vector3(0.5, 0.5, 0.5)).cwiseAbs().maxCoeff(&axis);
      EXPECT_EQ(at[axis], sun[axis] > 0 ? 1 : 0);
      const auto bin = [&](Eigen::Index along) {
        return std::min(kBins - 1, static_cast<int>(at[along % 3] * kBins));
      };
      ++counts[static_cast<std::size_t>((axis * kBins + bin(axis + 1)) * kBins + bin(axis + 2))];
    }
    expectShares(counts, shares);
  }
}

// Bins of 7.5 x 15 degrees have shares by radiance times the area of the box as it is seen.
TEST(DistantLight, ComesFromDirectionsByRadiance)
{
  RandomVectors random(5);
  for (const RadianceOf& radiance : { RadianceOf(uniformSky), cieSky(13, 70) })
  {
    const DistantLight light(skyOf(kLit, radiance));
    const auto bin = [](const Vector3& d) {
      const double polar = std::acos(d[2]) * 180 / M_PI, azimuth = std::atan2(d[0], d[1]) / M_PI;
      return static_cast<std::size_t>(std::min(11.0, polar / 7.5)) * 24 +
        static_cast<std::size_t>(std::floor(12 * (azimuth < 0 ? azimuth + 2 : azimuth))) % 24;
    };
    std::vector<double> shares(288);
    const double all = light.extent();
    overDirections(
      [&](const Vector3& d) {
        const int i = static_cast<int>(std::acos(d[2]) * 720 / M_PI);
        const double weight = std::sin((i + 0.5) * M_PI / 720) * std::pow(M_PI / 720, 2);
        return shares[bin(d)] += weight * radiance(d) * seenArea(d) / all;
      },
      720, true);
    std::vector<int> counts(288);
    for (int i = 0; i < 200000; ++i)
    {
      const std::array<double, 2> place = randomSquare(random);
      ++counts[bin(-light.leaving(place, randomSquare(random)).direction)];
    }
    expectShares(counts, shares);
  }
}

// Once the area of the box as it is seen is taken out, all of the disc is alike.
TEST(DistantLight, SunIsADisc)
{
  RandomVectors random(6);
  for (const double radius : { 0.005, 5 * M_PI / 180 })
  {
    const Vector3 sun = skyDirection(60, 300);
    const DistantLight light = DistantLight::sunOf(sunOnly(kLit, sun, 1, radius));
    const Vector3 across = sun.unitOrthogonal();
    ReplicateMean aside, square, area;
    for (int i = 0; i < 100000; ++i)
    {
      const std::array<double, 2> place = randomSquare(random);
      const Vector3 from = -light.leaving(place, randomSquare(random)).direction;
      const double angle = std::atan2(from.cross(sun).norm(), from.dot(sun));
      ASSERT_LE(angle, radius * (1 + 1e-9));
      const double weight = seenArea(sun) / seenArea(from);
      aside.add(weight * across.dot(from));
      square.add(weight * ((1 - std::cos(angle)) / (1 - std::cos(radius)) - 0.5));
      area.add(weight);
    }
    EXPECT_LE(std::abs(aside.t(0)), 4);
    EXPECT_LE(std::abs(square.t(0)), 4);
    // W for each W/m2 across: the mean area over the mean cosine.
    const double meanCosine = (1 + std::cos(radius)) / 2;
    const double truth = seenArea(sun) / area.mean() / meanCosine;
    EXPECT_NEAR(light.extent(), truth, 1e-3 * truth);
  }
}

}
}
