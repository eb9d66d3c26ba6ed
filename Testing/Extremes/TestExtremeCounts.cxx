// SPDX-License-Identifier: BSD-3-Clause
// One triangle and millions, one walk and many.

#include "ExtremeScenes.h"

#include <fstream>

using namespace ExtremeScenes;

namespace
{

/// Peak memory of this process so far, bytes; 0 where the system does not tell.
double PeakBytes()
{
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
  {
    double kibibytes = 0;
    if (word == "VmHWM:" && status >> kibibytes)
    {
      return 1024 * kibibytes;
    }
  }
  return 0;
}

Mesh MakeTriangle()
{
  const Mesh triangle = MakeSensors({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, { { 0, 0, 1 } });
  vtkNew<vtkCellArray> cells;
  const vtkIdType ids[3] = { 0, 1, 2 };
  cells->InsertNextCell(3, ids);
  triangle->SetPolys(cells);
  SetCellValues(triangle, "RadiantExitance", { 2 });
  return triangle;
}

}

// It emits 1 W, and all of it escapes.
TEST(ExtremeCounts, OneTriangle)
{
  for (const bool isMoving : { false, true })
  {
    Scene scene;
    if (isMoving)
    {
      scene.Moving.push_back(MakeMoving(MakeTriangle(), { 0, 0, 0 }));
    }
    else
    {
      scene.Fixed.push_back(MakeTriangle());
    }
    const auto filter = MakeFilter(scene, 1000);
    for (int frame = 0; frame < 2; ++frame)
    {
      ASSERT_NO_FATAL_FAILURE(ExpectLaws(filter, scene, false));
      EXPECT_EQ(Field(filter, "EmittedPower"), 1);
      EXPECT_EQ(Field(filter, "EscapedPower"), 1);
      EXPECT_EQ(IrradianceOf(filter, isMoving ? 1 : 0, 0)->GetComponent(0, 0), 0);
      if (isMoving)
      {
        scene.Moving[0].Pose->RotateX(30);
      }
    }
  }
}

// The furnace, cut into 2 million triangles, and the memory that they take.
TEST(ExtremeCounts, TwoMillionTriangles)
{
  constexpr int kResolution = 409; // 6 x 409^2 squares
  const Mesh room = MakeFurnace(1, { 0, 0, 0 }, 0.5, 1, kResolution);
  const double triangles = 2.0 * static_cast<double>(room->GetNumberOfCells());
  EXPECT_GT(triangles, 2e6);
  Scene scene{ { room }, { MakeMoving(White(MakeBox(0.3, 0.2, 0.25)), { 0.4, 0.5, 0.6 }) } };
  const double before = PeakBytes();
  const auto filter = MakeFilter(scene, 20000);
  filter->Update();
  const double each = (PeakBytes() - before) / triangles;
  EXPECT_LT(each, 2000);
  scene.Moving[0].Pose->Translate(0.1, 0, 0);
  filter->Update();
  EXPECT_EQ(Field(filter, "EmittedPower"), Field(filter, "AbsorbedPower"));
  EXPECT_EQ(Field(filter, "EscapedPower"), 0);
  EXPECT_EQ(Field(filter, "ShootSeconds"), 0);
  EXPECT_NEAR(MeanIrradiance(filter, 0, 0), 1, 5 * 0.177 / std::sqrt(20000.0) + 0.005);
}

class ExtremeWalks : public testing::TestWithParam<vtkIdType>
{
};

// See TestExtremeLengths for the deviation. The mean of one or two walks may be anything.
TEST_P(ExtremeWalks, TheFurnaceHolds)
{
  const vtkIdType walks = GetParam();
  const bool isStored = walks <= 1000000;
  Scene scene{ { MakeFurnace(1, { 0, 0, 0 }, isStored ? 0.5 : 0.1) }, {} }; // shorter walks if many
  if (isStored)
  {
    scene.Moving.push_back(MakeMoving(White(MakeBox(0.3, 0.2, 0.25)), { 0.4, 0.5, 0.6 }));
  }
  const auto filter = MakeFilter(scene, walks);
  for (int frame = 0; frame < (scene.Moving.empty() ? 1 : 2); ++frame)
  {
    ASSERT_NO_FATAL_FAILURE(ExpectLaws(filter, scene));
    if (walks > 1000)
    {
      EXPECT_NEAR(MeanIrradiance(filter, 0, 0), 1, InThisRun(5 * 0.25 / std::sqrt(double(walks))));
    }
    if (!scene.Moving.empty())
    {
      scene.Moving[0].Pose->Translate(0.1, 0, 0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(From1, ExtremeWalks,
  testing::ValuesIn(IsThorough()
      ? std::vector<vtkIdType>{ 1, 2, 1023, 1025, 100000, 1000000, 100000000 }
      : std::vector<vtkIdType>{ 1, 2, 1023, 1025, 100000 }),
  NumberOf);
