// SPDX-License-Identifier: BSD-3-Clause
// Poses over time from keys: their values, what is passed on, times, and what is refused.

#include "ErrorObserver.h"
#include "OutputBits.h"
#include "TestScenes.h"

#include "vtkCommand.h"
#include "vtkInformation.h"
#include "vtkKeyFramedPose.h"
#include "vtkRadiantExposureFilter.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>

using namespace TestScenes;

namespace
{

vtkSmartPointer<vtkKeyFramedPose> MakePose(vtkPolyData* input)
{
  auto pose = vtkSmartPointer<vtkKeyFramedPose>::New();
  pose->SetInputData(input);
  return pose;
}

/// The matrix at a time, row by row; empty if there is none.
std::vector<double> MatrixAt(vtkKeyFramedPose* pose, double time)
{
  pose->UpdateTimeStep(time);
  vtkDataArray* array = pose->GetOutput()->GetFieldData()->GetArray("ObjectToWorld");
  return array ? std::vector<double>(static_cast<double*>(array->GetVoidPointer(0)),
                   static_cast<double*>(array->GetVoidPointer(0)) + array->GetNumberOfValues())
               : std::vector<double>();
}

std::vector<double> MatrixOf(vtkTransform* transform)
{
  const double* data = transform->GetMatrix()->GetData();
  return { data, data + 16 };
}

vtkSmartPointer<vtkTransform> Turned(const Vector& position, const Vector& degrees)
{
  auto transform = vtkSmartPointer<vtkTransform>::New();
  transform->Translate(position.data());
  transform->RotateZ(degrees[2]);
  transform->RotateX(degrees[0]);
  transform->RotateY(degrees[1]);
  return transform;
}

/// The largest difference of two matrices; infinite if they are not of one size.
double Difference(const std::vector<double>& a, const std::vector<double>& b)
{
  double largest = a.size() == b.size() && !a.empty() ? 0 : std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; std::isfinite(largest) && i < a.size(); ++i)
  {
    largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  return largest;
}

/// Updates and returns the only error; the output must be empty.
std::string ErrorOf(vtkKeyFramedPose* pose, double time)
{
  pose->UpdateInformation();
  pose->GetOutputInformation(0)->Set(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(), time);
  const auto observer = ErrorObserver::Watch(pose);
  pose->Update();
  EXPECT_EQ(pose->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(observer->Errors.size(), 1u);
  return observer->Errors.empty() ? "" : observer->Errors[0];
}

std::vector<double> StepsOf(vtkKeyFramedPose* pose)
{
  pose->UpdateInformation();
  vtkInformation* info = pose->GetOutputInformation(0);
  auto* key = vtkStreamingDemandDrivenPipeline::TIME_STEPS();
  return info->Has(key) ? std::vector<double>(info->Get(key), info->Get(key) + info->Length(key))
                        : std::vector<double>();
}

/// Notes the progress, and aborts the pose from AbortAt on, if that is not above 1.
class ProgressOfKeys : public vtkCommand
{
public:
  static ProgressOfKeys* New() { return new ProgressOfKeys; }
  void Execute(vtkObject* pose, unsigned long, void* progress) override
  {
    this->Values.push_back(*static_cast<double*>(progress));
    if (this->Values.back() >= this->AbortAt)
    {
      static_cast<vtkAlgorithm*>(pose)->SetAbortExecute(1);
    }
  }
  std::vector<double> Values;
  double AbortAt = 2;
};

void ExpectPart(const std::string& text, const std::string& part)
{
  EXPECT_NE(text.find(part), std::string::npos) << text << "\nhas not: " << part;
}

std::string WriteFile(const std::string& name, const std::string& text)
{
  const std::string path = testing::TempDir() + name;
  std::ofstream(path) << text;
  return path;
}

}

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
  vtkInformation* info = pose->GetOutputInformation(0);
  EXPECT_EQ(info->Get(vtkStreamingDemandDrivenPipeline::TIME_RANGE())[0], 1);
  EXPECT_EQ(info->Get(vtkStreamingDemandDrivenPipeline::TIME_RANGE())[1], 3);
}

// The keys, and between them so many steps that none is too long. Equal ones are no more than asked for,
// also where lengths are no round binary numbers.
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

// A black plate passes under a small lamp at constant speed. Of a lamp of power P at height h the plate
// receives E(x) = P h2 / (pi (h2 + x2)2), and over the ride from -X to X in the time T its dose is
// P T / (2 pi X h) (U / (1 + U2) + atan U), U = X / h. The sizes of lamp and plate, 0.2 m, change that by
// 2 %; some 5,000 photons make a standard error of 1.4 %. 10 % is over five of them.
TEST(KeyFramedPose, GivesTheDoseOfARideByDefault)
{
  constexpr double kPi = 3.14159265358979323846, power = 4, height = 1, reach = 3, duration = 2;
  const Mesh plate = MakeRectangle({ -0.1, -0.1, 0 }, { 0.2, 0, 0 }, { 0, 0.2, 0 }, 1);
  SetCellValues(plate, "DiffuseReflectance", { 0 });
  auto ride = MakePose(plate);
  ride->AddPose(0, -reach, 0, 0, 0, 0, 0);
  ride->AddPose(duration, reach, 0, 0, 0, 0, 0);
  auto filter = MakeFilter({ { MakeLamp({ 0, 0, height }, 0.2, { 100 }) }, {} }, 30000);
  filter->AddInputConnection(1, ride->GetOutputPort());
  vtkNew<vtkRadiantExposureFilter> exposure;
  exposure->SetInputConnection(filter->GetOutputPort());
  exposure->SetIntegrationModeToTimeSteps();
  exposure->Update();
  const double ratio = reach / height;
  const double dose = power * duration / (2 * kPi * reach * height) *
    (ratio / (1 + ratio * ratio) + std::atan(ratio));
  auto* output = vtkMultiBlockDataSet::SafeDownCast(exposure->GetOutputDataObject(0));
  EXPECT_NEAR(
    OutputOf(output, 1, 0)->GetCellData()->GetArray("RadiantExposure")->GetComponent(0, 0) / dose,
    1, 0.1);
}

// While keys are read, as that may take long; then an update leaves nothing half done behind.
TEST(KeyFramedPose, TellsItsProgressAndCanBeAborted)
{
  constexpr int keys = 20000;
  std::string text = "time,x,y,z\n";
  auto added = MakePose(MakeBox(1, 1, 1)), read = MakePose(MakeBox(1, 1, 1));
  for (int key = 0; key < keys; ++key)
  {
    added->AddPose(key, key, 0, 0, 0, 0, 0);
    text += std::to_string(key) + "," + std::to_string(key) + ",0,0\n";
  }
  const std::string path = WriteFile("KeyFramedPose.csv", text);
  read->SetFileName(path.c_str());
  for (const auto& pose : { added, read })
  {
    vtkNew<ProgressOfKeys> progress;
    pose->AddObserver(vtkCommand::ProgressEvent, progress);
    progress->AbortAt = 0.3;
    pose->UpdateTimeStep(9.5);
    EXPECT_LT(progress->Values[0], 0.5);
    EXPECT_EQ(pose->GetOutput()->GetNumberOfCells(), 0);
    EXPECT_TRUE(StepsOf(pose).empty());

    progress->AbortAt = 2;
    progress->Values.clear();
    pose->Modified();
    EXPECT_EQ(StepsOf(pose).size(), static_cast<std::size_t>(keys));
    EXPECT_GE(progress->Values.size(), 4u);
    EXPECT_TRUE(std::is_sorted(progress->Values.begin(), progress->Values.end()));
    EXPECT_GT(progress->Values.back(), 0.75);
    EXPECT_EQ(MatrixAt(pose, 9.5)[3], 9.5);
    EXPECT_EQ(pose->GetOutput()->GetNumberOfCells(), 6);
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
  ExpectPart(ErrorOf(pose, 2.25), "the keys are from 1 to 2, and the time 2.25");
  ExpectPart(ErrorOf(pose, 0), "the time 0 is asked for");
  pose->SetOutsideOfKeysToHold();
  EXPECT_EQ(MatrixAt(pose, 0)[3], 1);
  EXPECT_EQ(MatrixAt(pose, 9)[3], 2);
  ExpectPart(ErrorOf(pose, std::nan("")), "the time nan is asked for");
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

TEST(KeyFramedPose, ReadsFiles)
{
  const struct
  {
    const char* Text;
    std::vector<double> AtOne;
  } files[] = {
    { "time,x,y,z\n0,0,0,0\n2,2,4,6\n", MatrixOf(Turned({ 1, 2, 3 }, { 0, 0, 0 })) },
    { "\xef\xbb\xbf\"time\", \"z\", y, x, remark\r\n# a remark\r\n0, 0, 0, 0, start\r\n\r\n"
      "2, 6e0, +4, 2, end\r\n",
      MatrixOf(Turned({ 1, 2, 3 }, { 0, 0, 0 })) },
    { "rx,ry,rz,x,y,z,time\n10,20,30,1,2,3,1\n0,0,0,0,0,0,2\n",
      MatrixOf(Turned({ 1, 2, 3 }, { 10, 20, 30 })) },
    { "time,x,y,z,qw,qx,qy,qz\n0,1,2,3,2,0,0,0\n1,1,2,3,5,0,0,5\n",
      MatrixOf(Turned({ 1, 2, 3 }, { 0, 0, 90 })) },
    { "time,m00,m01,m02,m03,m10,m11,m12,m13,m20,m21,m22,m23\n0,1,0,0,0,0,1,0,0,0,0,1,0\n"
      "1,0,-1,0,1,1,0,0,2,0,0,1,3\n",
      MatrixOf(Turned({ 1, 2, 3 }, { 0, 0, 90 })) },
  };
  for (const auto& file : files)
  {
    auto pose = MakePose(MakeBox(1, 1, 1));
    const std::string path = WriteFile("KeyFramedPose.csv", file.Text);
    pose->SetFileName(path.c_str());
    EXPECT_LT(Difference(MatrixAt(pose, 1), file.AtOne), 1e-15) << file.Text;
  }
}

TEST(KeyFramedPose, RefusesBadFiles)
{
  const struct
  {
    const char* Text;
    const char* Error;
  } files[] = {
    { "", "is empty" },
    { "time,x,y,z\n", "has no pose; two at least" },
    { "time,x,y,z\n1,0,0,0\n", "has one pose alone" },
    { "t,x,y,z\n0,0,0,0\n1,0,0,0\n", "line 1 of FILE: there is no column time" },
    { "time,x,z\n0,0,0\n1,0,0\n", "line 1 of FILE: there is no column y" },
    { "time,x,y,z,rx,rz\n0,0,0,0,0,0\n", "there is no column ry" },
    { "time,x,y,z,qw,qx\n0,0,0,0,0,0\n", "there is no column qy" },
    { "time,m00,m01\n0,0,0\n", "there is no column m02" },
    { "time,x,y,z,m00\n", "which are meant?" },
    { "time,x,y,z,rx,ry,rz,qw,qx,qy,qz\n", "of angles and of a quaternion" },
    { "time,x,y,z,x\n", "two columns are named x" },
    { "time,x,y,z\n0,0,0,0\n1,0,1O,0\n", "line 3 of FILE, column y: \"1O\" is not a number" },
    { "time,x,y,z\n0,0,0,0\n1,0,,0\n", "line 3 of FILE, column y: \"\" is not a number" },
    { "time,x,y,z\n0,0,0,0\n1,0,1 2,0\n", "column y: \"1 2\" is not a number" },
    { "time,x,y,z\n0,0,0,0\n\n1,0,nan,0\n", "line 4 of FILE, column y: nan is not finite" },
    { "time,x,y,z\n0,0,0,0\n1,0,0\n", "line 3 of FILE has 3 values and none in the column z" },
    { "time,x,y,z\n0,0,0,0\n2,0,0,0\n1,0,0,0\n", "line 4 of FILE: the time 1 is not after that" },
    { "time,x,y,z\n0,0,0,0\n0,0,0,0\n", "line 3 of FILE: the time 0 is not after that of line 2" },
    { "time,x,y,z,qw,qx,qy,qz\n0,0,0,0,0,0,0,0\n", "line 2 of FILE: the quaternion is 0" },
  };
  auto pose = MakePose(MakeBox(1, 1, 1));
  for (const auto& file : files)
  {
    const std::string path = WriteFile("KeyFramedPose.csv", file.Text);
    std::string expected = file.Error;
    if (expected.find("FILE") != std::string::npos)
    {
      expected.replace(expected.find("FILE"), 4, path);
    }
    pose->SetFileName(path.c_str());
    pose->Modified();
    ExpectPart(ErrorOf(pose, 0), expected);
  }
  pose->SetFileName("/there/is/no/such/file.csv");
  ExpectPart(ErrorOf(pose, 0), "/there/is/no/such/file.csv cannot be read");
  pose->SetFileName(testing::TempDir().c_str());
  ExpectPart(ErrorOf(pose, 0), "cannot be read");
  const std::string good = WriteFile("KeyFramedPose.csv", "time,x,y,z\n0,0,0,0\n1,2,0,0\n");
  pose->SetFileName(good.c_str());
  EXPECT_EQ(MatrixAt(pose, 0.5)[3], 1); // it stayed usable
  pose->AddPose(0, 0, 0, 0, 0, 0, 0);
  ExpectPart(ErrorOf(pose, 0), "1 poses were added; only one of the two is possible");
  pose->RemoveAllPoses();
  EXPECT_EQ(MatrixAt(pose, 0.5)[3], 1);
}

TEST(KeyFramedPose, RefusesBadPoses)
{
  auto pose = MakePose(MakeBox(1, 1, 1));
  ExpectPart(ErrorOf(pose, 0), "there is no pose; two at least");
  pose->AddPose(0, 0, 0, 0, 0, 0, 0);
  ExpectPart(ErrorOf(pose, 0), "there is one pose alone");
  pose->AddPose(0, 1, 0, 0, 0, 0, 0);
  ExpectPart(ErrorOf(pose, 0), "pose 1: the time 0 is not after that of pose 0");
  const auto errorWith = [](double time, const std::vector<double>& matrix) {
    auto bad = MakePose(MakeBox(1, 1, 1));
    bad->AddPose(0, 0, 0, 0, 0, 0, 0);
    bad->AddPoseMatrix(time, matrix.data());
    return ErrorOf(bad, 0);
  };
  const double nan = std::nan("");
  const std::vector<double> good{ 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
  const auto with = [&](std::size_t i, double value) {
    std::vector<double> matrix = good;
    matrix[i] = value;
    return matrix;
  };
  ExpectPart(errorWith(nan, good), "pose 1: the time nan is not finite");
  ExpectPart(errorWith(1, with(3, nan)), "pose 1: the transform");
  ExpectPart(errorWith(1, with(3, nan)), "is not finite");
  ExpectPart(errorWith(1, with(0, 0)), "is singular");
  ExpectPart(errorWith(1, with(12, 1)), "is not affine");
  ExpectPart(errorWith(1, with(1, 0.5)), "pose 1: the pose shears");
  ExpectPart(errorWith(1, with(0, -1)), "pose 1: the pose mirrors, unlike the one before");
  const auto observer = ErrorObserver::Watch(pose);
  pose->AddPoseMatrix(1, static_cast<vtkMatrix4x4*>(nullptr));
  EXPECT_EQ(observer->Errors.size(), 1u);
}

// Poses that follow from keys give what the same transforms give; only poses change over time.
TEST(KeyFramedPose, MovesPartsOfTheIrradianceFilter)
{
  Scene scene{ { MakeRoom(3, 2), MakeLamp({ 1.5, 1.5, 2.9 }, 0.5, { 100 }) }, {} };
  const Mesh ball = MakeBall(0.3, 6);
  auto pose = MakePose(ball);
  pose->AddPose(0, 0.5, 1.5, 1, 0, 0, 0);
  pose->AddPose(4, 2.5, 1.5, 1, 0, 0, 0);
  auto filter = MakeFilter(scene, 1000);
  filter->AddInputConnection(1, pose->GetOutputPort());
  for (const double time : { 1., 4., 2., 1. })
  {
    filter->UpdateTimeStep(time);
    Scene then = scene;
    then.Moving.push_back(MakeMoving(ball, { 0.5 + 0.5 * time, 1.5, 1 }));
    const auto fresh = MakeFilter(then, 1000);
    fresh->Update();
    EXPECT_TRUE(IsSame(OutputBits(filter), OutputBits(fresh))) << "time " << time;
  }
  EXPECT_EQ(Field(filter, "ShootSeconds"), 0);
}

// The geometry is read once, and again whenever the input has changed, however that was done.
TEST(KeyFramedPose, PassesChangesOfItsInputOn)
{
  Scene scene{ { MakeRoom(3, 2), MakeLamp({ 1.5, 1.5, 2.9 }, 0.5, { 100 }) }, {} };
  auto pose = MakePose(MakeBall(0.3, 6));
  pose->AddPose(0, 0.5, 1.5, 1, 0, 0, 0);
  pose->AddPose(4, 2.5, 1.5, 1, 0, 0, 0);
  vtkNew<vtkKeyFramedPose> outer;
  outer->SetInputConnection(pose->GetOutputPort());
  outer->AddPose(0, 0, 0, 0.25, 0, 0, 0);
  outer->AddPose(4, 0, 0, 0.25, 0, 0, 0);
  auto filter = MakeFilter(scene, 1000);
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
      Scene then = scene;
      then.Moving.push_back(MakeMoving(Copy(polyData()), { 0.5 + 0.5 * time, 1.5, 1.25 }));
      const auto fresh = MakeFilter(then, 1000);
      fresh->Update();
      EXPECT_TRUE(IsSame(OutputBits(filter), OutputBits(fresh))) << change << ", time " << time;
    }
    ++change;
  }
}
