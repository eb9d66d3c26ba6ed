// SPDX-License-Identifier: BSD-3-Clause
// Poses over time from keys: their values, what is passed on, times.

#include "KeyFramedPoses.h"
#include "OutputBits.h"

#include <functional>

using namespace KeyFramedPoses;

TEST(KeyFramedPose, IsThatOfTheKeysAtTheirTimes)
{
  const auto first = Turned({ 1, 2, 3 }, { 10, 20, 30 }),
             last = Turned({ 4, 6, 8 }, { -50, 70, 0 });
  last->Scale(1, 2, 3);
  for (const int type :
    { vtkKeyFramedPose::Linear, vtkKeyFramedPose::Spline, vtkKeyFramedPose::Step })
  {
    auto pose = MakePose(MakeBox(1, 1, 1));
    pose->SetInterpolationType(type);
    pose->AddPoseMatrix(5, last->GetMatrix());
    pose->AddPose(2, 1, 2, 3, 10, 20, 30);
    const double position[3] = { 0, 0, 7 }, orientation[3] = { 0, 90, 0 };
    pose->AddPose(3, position, orientation);
    EXPECT_EQ(pose->GetNumberOfPoses(), 3);
    EXPECT_EQ(MatrixAt(pose, 2), MatrixOf(first));
    EXPECT_EQ(MatrixAt(pose, 5), MatrixOf(last));
    EXPECT_EQ(MatrixAt(pose, 3), MatrixOf(Turned({ 0, 0, 7 }, { 0, 90, 0 })));
  }
}

TEST(KeyFramedPose, MovesAtConstantSpeedsWhenLinear)
{
  auto pose = MakePose(MakeBox(1, 1, 1));
  pose->AddPose(1, 0, 0, 0, 0, 0, 170);
  pose->AddPose(3, 1, 2, 4, 0, 0, -170); // 20 degrees on
  for (const double fraction : { 0.25, 0.5, 0.875 })
  {
    EXPECT_LT(
      Difference(MatrixAt(pose, 1 + 2 * fraction),
        MatrixOf(Turned({ fraction, 2 * fraction, 4 * fraction }, { 0, 0, 170 + 20 * fraction }))),
      1e-14);
  }
  // What does not turn keeps its rotation to the bit.
  pose->RemoveAllPoses();
  pose->AddPose(0, 0, 0, 0, 11, 22, 33);
  pose->AddPose(1, 3, 0, 0, 11, 22, 33);
  EXPECT_EQ(MatrixAt(pose, 1. / 3), MatrixOf(Turned({ 3 * (1. / 3), 0, 0 }, { 11, 22, 33 })));
}

// A parabola, a cubic's value at a key without jumps of speed, and a uniform rotation.
TEST(KeyFramedPose, IsSmoothWhenSpline)
{
  auto pose = MakePose(MakeBox(1, 1, 1));
  pose->SetInterpolationTypeToSpline();
  for (const double time : { 0., 1., 2.5, 3., 5. })
  {
    pose->AddPose(time, time * time, 5 * time, std::sin(time), 0, 40 * time, 0);
  }
  for (const double time : { 1.25, 2., 2.75 }) // between inner keys a parabola is met
  {
    const std::vector<double> matrix = MatrixAt(pose, time);
    EXPECT_NEAR(matrix[3], time * time, 1e-13);
    EXPECT_NEAR(matrix[7], 5 * time, 1e-13);
  }
  for (const double time : { 0.3, 1.7, 4.2 })
  {
    const std::vector<double> turned = MatrixOf(Turned({ 0, 0, 0 }, { 0, 40 * time, 0 }));
    std::vector<double> matrix = MatrixAt(pose, time);
    matrix[3] = matrix[7] = matrix[11] = 0;
    EXPECT_LT(Difference(matrix, turned), 1e-13);
  }
  for (const double key : { 1., 2.5, 3. }) // left and right of a key the speed is the same
  {
    constexpr double kStep = 1e-5;
    const double at = MatrixAt(pose, key)[11];
    const double before = (at - MatrixAt(pose, key - kStep)[11]) / kStep;
    const double after = (MatrixAt(pose, key + kStep)[11] - at) / kStep;
    EXPECT_NEAR(before, after, 1e-4);
    EXPECT_GT(std::abs(before), 0.1);
  }
}

TEST(KeyFramedPose, KeepsTheLastKeyWhenStep)
{
  auto pose = MakePose(MakeBox(1, 1, 1));
  pose->SetInterpolationTypeToStep();
  const double sheared[16] = { 1, 0.5, 0, 7, 0, 1, 0, 8, 0, 0, 1, 9, 0, 0, 0, 1 };
  pose->AddPoseMatrix(1, sheared);
  pose->AddPoseMatrix(2, 0, 1, 0, 3, 1, 0, 0, 4, 0, 0, 1, 5, 0, 0, 0, 1); // mirrors
  pose->AddPose(4, 1, 1, 1, 0, 0, 0);
  EXPECT_EQ(MatrixAt(pose, 1.999), std::vector<double>(sheared, sheared + 16));
  EXPECT_EQ(MatrixAt(pose, 3)[3], 3);
}

TEST(KeyFramedPose, PassesTheInputOn)
{
  const Mesh box = MakeBox(1, 1, 1);
  SetCellValues(box, "DiffuseReflectance", { 0.25 });
  auto pose = MakePose(box);
  pose->AddPose(0, 0, 0, 0, 0, 0, 0);
  pose->AddPose(1, 1, 0, 0, 0, 0, 0);
  for (const double time : { 0.25, 0.75 })
  {
    pose->UpdateTimeStep(time);
    vtkPolyData* output = pose->GetOutput();
    EXPECT_EQ(output->GetPoints(), box->GetPoints());
    EXPECT_EQ(output->GetPolys(), box->GetPolys());
    EXPECT_EQ(output->GetCellData()->GetArray("DiffuseReflectance"),
      box->GetCellData()->GetArray("DiffuseReflectance"));
    EXPECT_EQ(output->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), time);
    EXPECT_FALSE(box->GetFieldData()->HasArray("ObjectToWorld"));
  }
}

TEST(KeyFramedPose, HasTheTimesOfItsKeys)
{
  auto pose = MakePose(MakeBox(1, 1, 1));
  pose->AddPose(3, 0, 0, 0, 0, 0, 0);
  pose->AddPose(1, 0, 0, 0, 0, 0, 0);
  pose->AddPose(1.5, 0, 0, 0, 0, 0, 0);
  pose->SetNumberOfTimeSteps(0);
  EXPECT_EQ(StepsOf(pose), (std::vector<double>{ 1, 1.5, 3 }));
  EXPECT_EQ(RangeOf(pose), (std::vector<double>{ 1, 3 }));
}

// The keys, and between them so many steps that none is too long. Equal ones are no more than asked
// for, also where lengths are no round binary numbers.
TEST(KeyFramedPose, HasStepsBetweenItsKeys)
{
  auto pose = MakePose(MakeBox(1, 1, 1));
  pose->AddPose(1, 0, 0, 0, 0, 0, 0);
  pose->AddPose(3, 1, 0, 0, 0, 0, 0);
  std::vector<double> hundred;
  for (int i = 0; i <= 100; ++i)
  {
    hundred.push_back(1 + 2 * (i / 100.));
  }
  EXPECT_EQ(StepsOf(pose), hundred);
  pose->SetNumberOfTimeSteps(4);
  EXPECT_EQ(StepsOf(pose), (std::vector<double>{ 1, 1.5, 2, 2.5, 3 }));
  pose->AddPose(1.25, 0, 0, 0, 0, 0, 0); // the rest is 3.5 steps long
  EXPECT_EQ(StepsOf(pose), (std::vector<double>{ 1, 1.25, 1.6875, 2.125, 2.5625, 3 }));
  pose->RemoveAllPoses();
  for (int key = 0; key <= 10; ++key)
  {
    pose->AddPose(0.1 * key, 0, 0, 0, 0, 0, 0);
  }
  for (const int steps : { 10, 30, 70 })
  {
    pose->SetNumberOfTimeSteps(steps);
    EXPECT_EQ(StepsOf(pose).size(), static_cast<std::size_t>(steps) + 1);
  }
}

TEST(KeyFramedPose, AppliesThatOfTheInputFirst)
{
  const Mesh box = MakeBox(1, 1, 1);
  auto own = MakePose(box);
  own->AddPose(0, 1, 0, 0, 0, 0, 0);
  own->AddPose(1, 3, 0, 0, 0, 0, 0);
  vtkNew<vtkKeyFramedPose> pose;
  pose->SetInputConnection(own->GetOutputPort());
  pose->AddPose(0, 0, 0, 5, 0, 0, 90);
  pose->AddPose(1, 0, 0, 5, 0, 0, 90);
  EXPECT_LT(Difference(MatrixAt(pose, 0.5), MatrixOf(Turned({ 0, 2, 5 }, { 0, 0, 90 }))), 1e-15);
}

TEST(KeyFramedPose, HoldsOrLeavesOutsideOfItsKeys)
{
  const Mesh box = MakeBox(1, 1, 1);
  SetCellValues(box, "DiffuseReflectance", { 0.1, 0.2, 0.3 });
  auto pose = MakePose(box);
  pose->AddPose(1, 1, 0, 0, 0, 0, 0);
  pose->AddPose(2, 2, 0, 0, 0, 0, 0);
  ExpectWords(ErrorOf(pose, 2.25), { "the keys are from 1 to 2, and the time 2.25" });
  ExpectWords(ErrorOf(pose, 0), { "the time 0 is asked for" });
  pose->SetOutsideOfKeysToHold();
  EXPECT_EQ(MatrixAt(pose, 0)[3], 1);
  EXPECT_EQ(MatrixAt(pose, 9)[3], 2);
  ExpectWords(ErrorOf(pose, std::nan("")), { "the time nan is asked for" });
  pose->SetOutsideOfKeysToLeave();
  EXPECT_TRUE(MatrixAt(pose, 0).empty());
  EXPECT_EQ(pose->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(pose->GetOutput()->GetNumberOfPoints(), 0);
  vtkDataArray* array = pose->GetOutput()->GetCellData()->GetArray("DiffuseReflectance");
  ASSERT_NE(array, nullptr);
  EXPECT_EQ(array->GetNumberOfComponents(), 3);
  EXPECT_EQ(array->GetNumberOfTuples(), 0);
  EXPECT_EQ(MatrixAt(pose, 1.5)[3], 1.5);
  EXPECT_EQ(pose->GetOutput()->GetNumberOfCells(), 6);
}

// Poses that follow from keys give what the same transforms give. The geometry is read once, and
// again whenever the input has changed, however that was done; only poses change over time.
TEST(KeyFramedPose, PassesChangesOfItsInputOn)
{
  auto pose = MakePose(MakeBall(0.3, 6));
  pose->AddPose(0, 0.5, 1.5, 1, 0, 0, 0);
  pose->AddPose(4, 2.5, 1.5, 1, 0, 0, 0);
  vtkNew<vtkKeyFramedPose> outer;
  outer->SetInputConnection(pose->GetOutputPort());
  outer->AddPose(0, 0, 0, 0.25, 0, 0, 0);
  outer->AddPose(4, 0, 0, 0.25, 0, 0, 0);
  auto filter = MakeFilter(MakeEmptyRoom(), 1000);
  filter->AddInputConnection(1, outer->GetOutputPort());
  const auto polyData = [&] { return vtkPolyData::SafeDownCast(pose->GetInput()); };
  const std::function<void()> changes[] = { [] {},
    [&] { // in place, without a word to the points
      auto* z = static_cast<float*>(polyData()->GetPoints()->GetVoidPointer(0)) + 2;
      *z += 0.25F;
      polyData()->Modified();
    },
    [&] { SetCellValues(polyData(), "DiffuseReflectance", { 0.9 }); },
    [&] { pose->SetInputData(MakeBall(0.25, 6)); },
    [&] { polyData()->ShallowCopy(MakeBox(0.4, 0.5, 0.6)); } };
  int change = 0;
  for (const auto& apply : changes)
  {
    apply();
    for (const double time : { 1., 3. })
    {
      filter->UpdateTimeStep(time);
      Scene then = MakeEmptyRoom();
      then.Moving.push_back(MakeMoving(Copy(polyData()), { 0.5 + 0.5 * time, 1.5, 1.25 }));
      const auto fresh = MakeFilter(then, 1000);
      fresh->Update();
      EXPECT_TRUE(IsSame(OutputBits(filter), OutputBits(fresh))) << change << ", time " << time;
      EXPECT_TRUE(time == 1 || Field(filter, "ShootSeconds") == 0);
    }
    ++change;
  }
}
