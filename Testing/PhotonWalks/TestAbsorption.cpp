// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Absorption.h"

#include "Kit.h"

namespace irradiance::test
{
namespace
{

constexpr std::int64_t kPhoton = 1 << 26;

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
  const Power powers[] = { { { kPhoton, kPhoton, kPhoton } }, { { kPhoton, 3, 0 } },
    { { 12345, 77777, 1001 } } };
  for (const auto& reflectance : reflectances)
  {
    const Material material = oneTriangle(reflectance, 3);
    for (const Power& power : powers)
    {
      const double probability = survivalProbabilities(power, material, 0).total();
      ASSERT_LE(probability, *std::max_element(reflectance.begin(), reflectance.end()));
      const Power after = survivingPower(power, material, 0, Reflection::Diffuse, probability);
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
    const Power power{ { kPhoton, kPhoton, kPhoton } };
    const SurvivalProbabilities survival = survivalProbabilities(power, material, 0);
    ASSERT_LE(survival.total(), 1 + 1e-15);
    EXPECT_EQ(survival.chosenBy(0.99 * survival.diffuse), Reflection::Diffuse);
    EXPECT_EQ(survival.chosenBy(survival.diffuse), Reflection::Specular);
    for (const Reflection reflection : { Reflection::Diffuse, Reflection::Specular })
    {
      const auto& reflectance = reflection == Reflection::Diffuse ? one.diffuse : one.specular;
      const double probability = survival.of(reflection);
      if (probability == 0)
      {
        continue;
      }
      const Power after = survivingPower(power, material, 0, reflection, probability);
      EXPECT_EQ(after.largest() > kPhoton, one.isScaled);
      expectReflected(after, probability, power, reflectance);
    }
  }
}

TEST(Absorption, OneBandSurvivesWithTheSumOfItsReflectancesAndKeepsItsPower)
{
  const Power photon{ { kPhoton, 0, 0 } };
  for (const double reflectance : { 0.0, 0.3, 0.999, 1.0 })
  {
    const Material diffuse = oneTriangle({ reflectance, 0, 0 }, 1);
    EXPECT_EQ(survivalProbabilities(photon, diffuse, 0).total(), reflectance);
    EXPECT_EQ(survivingPower(photon, diffuse, 0, Reflection::Diffuse, reflectance), photon);
  }
  Material material = oneTriangle({ 0.3, 0, 0 }, 1);
  material.setSpecular({ 0.6 }, { kInfinity });
  const SurvivalProbabilities survival = survivalProbabilities(photon, material, 0);
  EXPECT_EQ(survival.diffuse, 0.3);
  EXPECT_NEAR(survival.total(), 0.9, 1e-15);
  EXPECT_EQ(survivingPower(photon, material, 0, Reflection::Specular, 0.6), photon);
}

}
}
