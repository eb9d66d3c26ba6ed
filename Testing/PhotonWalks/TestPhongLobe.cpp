// SPDX-License-Identifier: BSD-3-Clause
#include "Kit.h"
#include "Sampling/DirectionSampling.h"
#include "Sampling/SobolSequence.h"
#include "Surfaces/Absorption.h"
#include "Surfaces/PhongLobe.h"

namespace irradiance::test
{
namespace
{

const double kExponents[] = { 0, 1, 30, 700, 10000 };

/// The integral over the hemisphere of BRDF times cosine times weight(direction), by two product
/// rules of midpoints: a fine one around the mirror direction, where the lobe is, and one around
/// the normal that is dense at grazing angles, where the lobe loses light. The balance heuristic
/// (Veach 1997) joins them; any two densities would do.
template <class Weight>
auto integral(
  const PhongLobe& lobe, const Vector3& normal, const Vector3& toLight, const Weight& weight)
{
  constexpr int kFine = 400, kHeights = 600, kTurns = 300;
  const double n = lobe.exponent();
  const Vector3 mirror = 2 * toLight.dot(normal) * normal - toLight;
  auto sum = weight(normal);
  sum *= 0;
  const auto add = [&](const Vector3& out) {
    const double cosine = out.dot(normal), along = out.dot(mirror);
    if (cosine <= 0)
    {
      return;
    }
    const double inLobe = along > 0 ? (n + 1) / (2 * M_PI) * std::pow(along, n) : 0;
    auto part = weight(out);
    part *= lobe.value(normal, toLight, out) * cosine /
      (kFine * kFine * inLobe + kHeights * kTurns / (4 * M_PI * std::sqrt(cosine)));
    sum += part;
  };
  const auto middle = [](int i, int steps) { return (i + 0.5) / steps; };
  for (int i = 0; i < kFine * kFine; ++i)
  {
    const double along = std::pow(middle(i / kFine, kFine), 1 / (n + 1));
    add(directionAround(
      mirror, along, std::sqrt(std::max(0.0, 1 - along * along)), middle(i % kFine, kFine)));
  }
  for (int i = 0; i < kHeights * kTurns; ++i)
  {
    const double root = middle(i / kTurns, kHeights), cosine = root * root;
    add(
      directionAround(normal, cosine, std::sqrt(1 - cosine * cosine), middle(i % kTurns, kTurns)));
  }
  return sum;
}

/// The samples of a walk at its first bounce.
LobeSample lobeSample(const SobolSequence& samples, std::uint32_t walk)
{
  return { samples.sample(walk, 1, SampleUse::Direction),
    samples.sample(walk, 1, SampleUse::Acceptance)[0],
    samples.sample(walk, 1, SampleUse::Compensation) };
}

Vector3 toLightAt(double cosine)
{
  return { std::sqrt(1 - cosine * cosine), 0, cosine };
}

// Ten angles from steep to grazing. The table of losses is off by up to 2^-12, and so is the
// albedo.
TEST(PhongLobe, ReflectsAllLightAtEveryAngle)
{
  const Vector3 normal(0, 0, 1);
  for (const double exponent : kExponents)
  {
    const PhongLobe lobe(exponent);
    for (const double degrees : { 0, 10, 20, 30, 45, 60, 70, 80, 85, 89 })
    {
      const double albedo = integral(lobe, normal, toLightAt(std::cos(degrees * M_PI / 180)),
        [](const Vector3&) { return 1.0; });
      EXPECT_NEAR(albedo, 1, 6e-4) << "exponent " << exponent << ", " << degrees << " degrees";
    }
  }
}

TEST(PhongLobe, IsReciprocal)
{
  RandomVectors random(4);
  for (const double exponent : kExponents)
  {
    const PhongLobe lobe(exponent);
    for (int trial = 0; trial < 5000; ++trial)
    {
      const Vector3 normal = random.direction(), a = random.direction(), b = random.direction();
      const double there = lobe.value(normal, a, b), back = lobe.value(normal, b, a);
      ASSERT_NEAR(there, back, 1e-11 * (exponent + 1) * std::max(there, back));
      ASSERT_EQ(there > 0, a.dot(normal) > 0 && b.dot(normal) > 0);
    }
  }
}

// The mean direction of a million Sobol' samples. Independent ones would be off by 5e-4 in 1 of 40;
// these scatter less.
TEST(PhongLobe, SamplesHaveTheMeanDirectionOfTheLobe)
{
  const SobolSequence samples(5);
  const Vector3 normal = Vector3(1, -2, 2) / 3;
  const Vector3 along = normal.unitOrthogonal();
  for (const double exponent : { 0.0, 5.0, 50.0, 10000.0 })
  {
    const PhongLobe lobe(exponent);
    for (const double cosine : { 0.95, 0.5, 0.1 })
    {
      const Vector3 toLight = cosine * normal + std::sqrt(1 - cosine * cosine) * along;
      const auto square = [&](const Vector3& v) {
        return Eigen::Matrix<double, 6, 1>(
          (Eigen::Matrix<double, 6, 1>() << v, v.cwiseProduct(v)).finished());
      };
      Eigen::Matrix<double, 6, 1> mean = Eigen::Matrix<double, 6, 1>::Zero();
      constexpr std::uint32_t kSamples = 1u << 19;
      for (std::uint32_t i = 0; i < kSamples; ++i)
      {
        const Vector3 out = lobe.sample(normal, -toLight, lobeSample(samples, i));
        ASSERT_GT(out.dot(normal), 0);
        ASSERT_NEAR(out.norm(), 1, 1e-12);
        mean += square(out) / kSamples;
      }
      const auto expected = integral(lobe, normal, toLight, square);
      EXPECT_LE((mean - expected).cwiseAbs().maxCoeff(), 2e-3)
        << "exponent " << exponent << ", cosine " << cosine << "\n"
        << mean.transpose() << "\n"
        << expected.transpose();
    }
  }
}

TEST(PhongLobe, AnInfiniteExponentIsAMirror)
{
  const PhongLobe lobe(kInfinity);
  EXPECT_TRUE(lobe.isMirror());
  const LobeSample any{ { 0.3, 0.4 }, 0.9, { 0.1, 0.2 } };
  const Vector3 out = lobe.sample({ 0, 0, 1 }, Vector3(0.6, 0, -0.8), any);
  EXPECT_LE((out - Vector3(0.6, 0, 0.8)).norm(), 1e-15);
}

// A narrow lobe is close to a mirror, also at grazing angles.
TEST(PhongLobe, LargeExponentsComeCloseToAMirror)
{
  const SobolSequence samples(6);
  const PhongLobe lobe(1e12);
  for (std::uint32_t i = 0; i < 10000; ++i)
  {
    const Vector3 toLight = toLightAt(0.01 + 0.99 * samples.sample(i, 0, SampleUse::Position)[0]);
    const Vector3 out = lobe.sample({ 0, 0, 1 }, -toLight, lobeSample(samples, i));
    ASSERT_TRUE(samples.sample(i, 1, SampleUse::Acceptance)[0] >= 0.99 ||
      (out - Vector3(-toLight[0], 0, toLight[2])).norm() <= 1e-5);
  }
}

// A lobe around the normal: cos(alpha) is the cosine, and its mean (n + 1) / (n + 2). A grazing
// one: half of it is below the horizon.
TEST(LobeLoss, HasItsClosedFormsAtBothEnds)
{
  for (const double exponent : kExponents)
  {
    const PhongLobe lobe(exponent);
    EXPECT_NEAR(lobe.loss(1), 1 / (exponent + 2), 1e-4);
    EXPECT_NEAR(lobe.loss(1e-9), 0.5, 1e-6);
  }
}

// Far more points of quadrature, between the nodes of the table.
TEST(LobeLoss, IsWithinItsErrorBetweenNodes)
{
  RandomVectors random(8);
  for (int trial = 0; trial < 40; ++trial)
  {
    const double exponent = std::pow(10, random.uniform(-1, 4)), cosine = random.uniform(0.01, 1);
    const PhongLobe lobe(exponent);
    constexpr int kSteps = 1000;
    double loss = 0;
    for (int i = 0; i < kSteps; ++i)
    {
      const double u = (i + 0.5) / kSteps, along = std::pow(u, 1 / (exponent + 1));
      const double aside = std::sqrt((1 - along * along) * (1 - cosine * cosine));
      for (int j = 0; j < kSteps; ++j)
      {
        const double out = along * cosine + aside * std::cos(2 * M_PI * (j + 0.5) / kSteps);
        loss += 1 - std::min(1.0, std::max(0.0, out / cosine));
      }
    }
    EXPECT_NEAR(lobe.loss(cosine), loss / kSteps / kSteps, 0x1p-12)
      << "exponent " << exponent << ", cosine " << cosine;
  }
}

constexpr std::int64_t kQuanta = 1 << 26;

/// Probability times power is what is reflected, to half a quantum.
void expectReflected(const Power& after, double probability, const Power& before,
  const std::array<double, 3>& reflectance)
{
  for (std::size_t band = 0; band < 3; ++band)
  {
    EXPECT_NEAR(static_cast<double>(after.quanta[band]) * probability,
      reflectance[band] * static_cast<double>(before.quanta[band]), 0.51 * probability);
  }
}

Material oneTriangle(const std::array<double, 3>& reflectance, int bands)
{
  ObjectBuilder builder(bands);
  builder.addCell({ { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } } }, { reflectance, {} });
  return builder.material();
}

// Probability times power is what the material reflects, to half a quantum; the strongest band
// keeps what it had, and none exceeds it.
TEST(Absorption, SeveralBandsKeepTheMeanAndTheStrongestPower)
{
  const std::array<double, 3> reflectances[] = { { 0.5, 0.25, 1.0 }, { 0.9, 0.1, 0.0 },
    { 0.3, 0.3, 0.3 }, { 1, 1, 1 }, { 1e-9, 0.7, 0.2 } };
  const Power powers[] = { { { kQuanta, kQuanta, kQuanta } }, { { kQuanta, 3, 0 } },
    { { 12345, 77777, 1001 } } };
  for (const auto& reflectance : reflectances)
  {
    const Material material = oneTriangle(reflectance, 3);
    for (const Power& power : powers)
    {
      const double probability = survivalProbabilities(power, material, 0).total();
      ASSERT_LE(probability, *std::max_element(reflectance.begin(), reflectance.end()));
      const Power after = survivingPower(power, material, 0, Leaving::Diffuse, probability);
      ASSERT_EQ(after.largest(), power.largest());
      expectReflected(after, probability, power, reflectance);
    }
  }
}

TEST(Absorption, WhatReflectsNothingLetsNothingSurvive)
{
  EXPECT_EQ(survivalProbabilities({ { 9, 9, 9 } }, oneTriangle({ 0, 0, 0 }, 3), 0).total(), 0);
  EXPECT_EQ(survivalProbabilities({ { 0, 9, 0 } }, oneTriangle({ 1, 0, 1 }, 3), 0).total(), 0);
}

// One sample decides among diffuse, specular and none. Over all samples each band leaves with what
// the material reflects of it; the strongest keeps its power if the parts add up to no more than 1.
TEST(Absorption, SpecularAndDiffuseReflectionKeepTheMeanOfEachBand)
{
  struct Case
  {
    std::array<double, 3> diffuse, specular;
    bool isScaled;
  };
  const Case cases[] = { { { 0.5, 0.2, 0.1 }, { 0.3, 0.4, 0.2 }, false },
    { { 0.5, 0.2, 0.1 }, { 0, 0, 0 }, false }, { { 1, 0, 0 }, { 0, 1, 0 }, true },
    { { 0.9, 0.1, 0 }, { 0.05, 0.8, 0.3 }, true } };
  for (const Case& one : cases)
  {
    Material material = oneTriangle(one.diffuse, 3);
    material.setSpecular({ one.specular.begin(), one.specular.end() }, { 10 });
    const Power power{ { kQuanta, kQuanta, kQuanta } };
    const SurvivalProbabilities survival = survivalProbabilities(power, material, 0);
    ASSERT_LE(survival.total(), 1 + 1e-15);
    const double diffuse = survival.of(Leaving::Diffuse);
    EXPECT_EQ(survival.at(0.99 * diffuse), Leaving::Diffuse);
    EXPECT_EQ(survival.at(diffuse) == Leaving::Specular, survival.of(Leaving::Specular) > 0);
    for (const Leaving way : { Leaving::Diffuse, Leaving::Specular })
    {
      const auto& reflectance = way == Leaving::Specular ? one.specular : one.diffuse;
      const double probability = survival.of(way);
      if (probability == 0)
      {
        continue;
      }
      const Power after = survivingPower(power, material, 0, way, probability);
      EXPECT_EQ(after.largest() > kQuanta, one.isScaled);
      expectReflected(after, probability, power, reflectance);
    }
  }
}

TEST(Absorption, OneBandSurvivesWithTheSumOfItsReflectancesAndKeepsItsPower)
{
  const Power photon{ { kQuanta, 0, 0 } };
  for (const double reflectance : { 0.0, 0.3, 0.999, 1.0 })
  {
    const Material diffuse = oneTriangle({ reflectance, 0, 0 }, 1);
    EXPECT_EQ(survivalProbabilities(photon, diffuse, 0).total(), reflectance);
    EXPECT_EQ(survivingPower(photon, diffuse, 0, Leaving::Diffuse, reflectance), photon);
  }
  Material material = oneTriangle({ 0.3, 0, 0 }, 1);
  material.setSpecular({ 0.6 }, { kInfinity });
  const SurvivalProbabilities survival = survivalProbabilities(photon, material, 0);
  EXPECT_EQ(survival.of(Leaving::Diffuse), 0.3);
  EXPECT_NEAR(survival.total(), 0.9, 1e-15);
  EXPECT_EQ(survivingPower(photon, material, 0, Leaving::Specular, 0.6), photon);
}

}
}
