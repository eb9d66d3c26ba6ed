// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/SurfacePoint.h"
#include "Shooting/Stages.h"
#include "Simd/SimdLevel.h"

#include "../RayCasting/RandomVectors.h"
#include "CosineHemisphere.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace irradiance
{

namespace
{

using test::sampleCosineHemisphere;

template <class Lanes>
void expectSameBits(const Lanes& a, const Lanes& b)
{
  const auto* const bytes = reinterpret_cast<const char*>(&a);
  EXPECT_TRUE(std::equal(bytes, bytes + sizeof(Lanes), reinterpret_cast<const char*>(&b)));
}

/// The stage as each instruction set of this machine runs it.
template <class Lanes>
std::vector<std::function<void(Lanes&)>> onEachLevel(
  void (*plain)(Lanes&), void (*avx2)(Lanes&), void (*avx512)(Lanes&))
{
  std::vector<std::function<void(Lanes&)>> stages{ plain };
#ifdef __x86_64__
  if (simdLevel() >= SimdLevel::Avx2)
  {
    stages.emplace_back(avx2);
  }
  if (simdLevel() >= SimdLevel::Avx512)
  {
    stages.emplace_back(avx512);
  }
#endif
  return stages;
}

void setSamples(SampleLanes& lanes, const SobolSequence& samples, std::uint32_t first)
{
  for (unsigned lane = 0; lane < SampleLanes::kSize; ++lane)
  {
    lanes.set(lane, samples, first + lane, lane % 50, SampleUse::Direction);
  }
}

}

// Bounces on both sides of those whose keys are kept.
TEST(Stages, SamplesAreThoseOfTheSequence)
{
  for (const std::uint32_t replicates : { 1u, 16u })
  {
    const SobolSequence samples(7, Replicates(replicates));
    for (const auto& draw : onEachLevel(&drawAllPlain, &drawAllAvx2, &drawAllAvx512))
    {
      for (const std::uint32_t first : { 0u, 123456u, 0xffffff00u })
      {
        SampleLanes lanes;
        setSamples(lanes, samples, first);
        draw(lanes);
        for (unsigned lane = 0; lane < SampleLanes::kSize; ++lane)
        {
          const auto sample = samples.sample(first + lane, lane % 50, SampleUse::Direction);
          ASSERT_EQ(lanes.x[lane], sample[0]);
          ASSERT_EQ(lanes.y[lane], sample[1]);
        }
      }
    }
  }
}

TEST(Stages, FirstCoordinatesAreThoseOfSamplesOnEachInstructionSet)
{
  const SobolSequence samples(7, Replicates(16));
  SampleLanes expected;
  setSamples(expected, samples, 123456u);
  drawAllPlain(expected);
  for (const auto& draw : onEachLevel(&drawAllFirstPlain, &drawAllFirstAvx2, &drawAllFirstAvx512))
  {
    SampleLanes lanes;
    setSamples(lanes, samples, 123456u);
    draw(lanes);
    for (unsigned lane = 0; lane < SampleLanes::kSize; ++lane)
    {
      ASSERT_EQ(lanes.x[lane], expected.x[lane]);
    }
  }
}

TEST(Stages, RaysLeaveFromSurfacePointsOnEachInstructionSet)
{
  test::RandomVectors random(3);
  const SobolSequence samples(3);
  for (int trial = 0; trial < 2000; ++trial)
  {
    ScatterLanes lanes;
    setSamples(lanes.samples, samples, static_cast<std::uint32_t>(32 * trial));
    const double size = random.powerOfTwo(-20, 20);
    std::vector<Triangle> triangles;
    for (unsigned lane = 0; lane < ScatterLanes::kSize; ++lane)
    {
      triangles.push_back(
        { size * random.inCube(), size * random.inCube(), size * random.inCube() });
      lanes.setTriangle(lane, triangles.back());
      const double b = 0.5 * std::abs(random.uniform()), c = 0.5 * std::abs(random.uniform());
      lanes.weights.set(lane, { 1 - b - c, b, c });
      lanes.incoming.set(lane, random.direction());
      lanes.side[lane] = static_cast<double>(lane % 3) - 1;
    }
    ScatterLanes first = lanes;
    scatterAllPlain(first);
    for (const auto& leave : onEachLevel(&scatterAllPlain, &scatterAllAvx2, &scatterAllAvx512))
    {
      ScatterLanes left = lanes;
      leave(left);
      expectSameBits(left, first);
    }
    for (unsigned lane = 0; lane < ScatterLanes::kSize; ++lane)
    {
      SurfacePoint point = surfacePoint(triangles[lane], lanes.weights.get(lane));
      const Vector3 incoming = lanes.incoming.get(lane);
      point.turn(lanes.side[lane] == 0 ? incoming.dot(point.normal) <= 0 : lanes.side[lane] > 0);
      ASSERT_EQ(first.side[lane], point.isFront ? 1 : -1);
      ASSERT_EQ(first.origin.get(lane), point.clearPosition());
      ASSERT_EQ(first.direction.get(lane),
        sampleCosineHemisphere(point.normal, { first.samples.x[lane], first.samples.y[lane] }));
    }
  }
}

}
