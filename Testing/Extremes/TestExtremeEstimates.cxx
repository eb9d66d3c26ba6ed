// SPDX-License-Identifier: BSD-3-Clause
// Estimates of small cells from photons around them, at extreme lengths and places.

#include "ExtremeScenes.h"

#include <cstdio>

using namespace ExtremeScenes;

namespace
{

/// A furnace of small cells, where each estimate draws on photons of other cells. Of 30 seeds the
/// mean of the room has a standard deviation of 0.0031, on box and ball of 0.018 and 0.027:
/// tolerances are 5.5 of them, a false alarm in 20 million.
void ExpectEstimates(double size, const Vector& offset)
{
  Scene scene{ { MakeFurnace(size, offset, 0.5, 1, 6) },
    { MakeMovingIn(White(MakeBox(0.3, 0.2, 0.25)), size, offset, { 0.4, 0.5, 0.6 }),
      MakeMovingIn(White(MakeBall(0.15, 24)), size, offset, { 0.7, 0.7, 0.4 }) } };
  const auto filter = MakeFilter(scene, 20000);
  filter->SetMethodToSpreadWalks();
  filter->SetNumberOfSpreadPhotons(400);
  for (int frame = 0; frame < 2; ++frame)
  {
    ASSERT_NO_FATAL_FAILURE(ExpectLaws(filter, scene));
    const double inRoom = MeanIrradiance(filter, 0, 0), onBox = MeanIrradiance(filter, 1, 0),
                 onBall = MeanIrradiance(filter, 1, 1);
    EXPECT_NEAR(inRoom, 1, 0.017);
    EXPECT_NEAR(onBox, 1, 0.1);
    EXPECT_NEAR(onBall, 1, 0.15);
    std::printf("size %g, offset %g: %.5f in the room, %.4f on the box, %.4f on the "
                "ball\n",
      size, offset[0], inRoom, onBox, onBall);
    scene.Moving[0].Pose->RotateWXYZ(25, 1, 2, 3);
    scene.Moving[1].Pose->Translate(-0.01 * size, 0.02 * size, 0.05 * size);
  }
}

}

class ExtremeEstimates : public testing::TestWithParam<double>
{
};

TEST_P(ExtremeEstimates, TheFurnaceHoldsAtThisSize)
{
  ExpectEstimates(GetParam(), { 0, 0, 0 });
}

INSTANTIATE_TEST_SUITE_P(Metres, ExtremeEstimates, testing::Values(1e-28, 1e-6, 1e12, 1e28),
  [](const auto& info) { return "Number" + std::to_string(info.index); });

class ExtremeEstimatesFarAway : public testing::TestWithParam<double>
{
};

TEST_P(ExtremeEstimatesFarAway, TheFurnaceHolds)
{
  const double size = 0.01, far = GetParam() * size;
  ExpectEstimates(size, { far, -0.7 * far, 0.4 * far });
}

INSTANTIATE_TEST_SUITE_P(Sizes, ExtremeEstimatesFarAway, testing::Values(1e3, 1e6, 1e7),
  [](const auto& info) { return "Number" + std::to_string(info.index); });
