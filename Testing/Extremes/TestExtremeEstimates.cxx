// SPDX-License-Identifier: BSD-3-Clause
// Estimates of small cells from photons around them, at extreme lengths and places.

#include "ExtremeScenes.h"

using namespace ExtremeScenes;

namespace
{

/// A furnace of small cells, where each estimate draws on photons of other cells. Of 30 seeds the
/// mean of the room has a standard deviation of 0.0031, on box and ball of 0.018 and 0.027:
/// tolerances are 5.5 of them, a false alarm in 20 million.
class ExtremeEstimates : public testing::TestWithParam<FurnacePlace>
{
};

}

TEST_P(ExtremeEstimates, TheFurnaceHolds)
{
  const auto& [size, offset] = GetParam();
  Scene scene{ { MakeFurnace(size, offset, 0.5, 1, 6) },
    { MakeMovingIn(White(MakeBox(0.3, 0.2, 0.25)), size, offset, { 0.4, 0.5, 0.6 }),
      MakeMovingIn(White(MakeBall(0.15, 24)), size, offset, { 0.7, 0.7, 0.4 }) } };
  const auto filter = MakeFilter(scene, 20000);
  filter->SetMethodToSpreadWalks();
  filter->SetNumberOfSpreadPhotons(400);
  for (int frame = 0; frame < 2; ++frame)
  {
    ASSERT_NO_FATAL_FAILURE(ExpectLaws(filter, scene));
    EXPECT_NEAR(MeanIrradiance(filter, 0, 0), 1, 0.017);
    EXPECT_NEAR(MeanIrradiance(filter, 1, 0), 1, 0.1);
    EXPECT_NEAR(MeanIrradiance(filter, 1, 1), 1, 0.15);
    scene.Moving[0].Pose->RotateWXYZ(25, 1, 2, 3);
    scene.Moving[1].Pose->Translate(-0.01 * size, 0.02 * size, 0.05 * size);
  }
}

INSTANTIATE_TEST_SUITE_P(
  Each, ExtremeEstimates, PlacesOf({ 1e-28, 1e-6, 1e12, 1e28 }, { 1e3, 1e6, 1e7 }), NumberOf);
