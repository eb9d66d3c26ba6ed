// SPDX-License-Identifier: BSD-3-Clause
// Keys from files and by calls: which are read, which are refused, and how long reading may be
// aborted.

#include "../WriteFile.h"
#include "EventObserver.h"
#include "KeyFramedPoses.h"

using namespace KeyFramedPoses;

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
    const auto observer = EventObserver::Watch(pose);
    observer->AbortFrom = 0.3;
    pose->UpdateTimeStep(9.5);
    EXPECT_LT(observer->Progress[0], 0.5);
    EXPECT_EQ(pose->GetOutput()->GetNumberOfCells(), 0);
    EXPECT_TRUE(StepsOf(pose).empty());

    observer->AbortFrom = 2;
    observer->Progress.clear();
    pose->SetAbortExecute(0);
    EXPECT_EQ(StepsOf(pose).size(), static_cast<std::size_t>(keys));
    EXPECT_GE(observer->Progress.size(), 4u);
    EXPECT_TRUE(std::is_sorted(observer->Progress.begin(), observer->Progress.end()));
    EXPECT_GT(observer->Progress.back(), 0.75);
    EXPECT_EQ(MatrixAt(pose, 9.5)[3], 9.5);
    EXPECT_EQ(pose->GetOutput()->GetNumberOfCells(), 6);
  }
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
    ExpectWords(ErrorOf(pose, 0), { expected });
  }
  pose->SetFileName("/there/is/no/such/file.csv");
  ExpectWords(ErrorOf(pose, 0), { "/there/is/no/such/file.csv cannot be read" });
  pose->SetFileName(testing::TempDir().c_str());
  ExpectWords(ErrorOf(pose, 0), { "cannot be read" });
  const std::string good = WriteFile("KeyFramedPose.csv", "time,x,y,z\n0,0,0,0\n1,2,0,0\n");
  pose->SetFileName(good.c_str());
  EXPECT_EQ(MatrixAt(pose, 0.5)[3], 1); // it stayed usable
  pose->AddPose(0, 0, 0, 0, 0, 0, 0);
  ExpectWords(ErrorOf(pose, 0), { "1 poses were added; only one of the two is possible" });
  pose->RemoveAllPoses();
  EXPECT_EQ(MatrixAt(pose, 0.5)[3], 1);
}

TEST(KeyFramedPose, RefusesBadPoses)
{
  auto pose = MakePose(MakeBox(1, 1, 1));
  ExpectWords(ErrorOf(pose, 0), { "there is no pose; two at least" });
  pose->AddPose(0, 0, 0, 0, 0, 0, 0);
  ExpectWords(ErrorOf(pose, 0), { "there is one pose alone" });
  pose->AddPose(0, 1, 0, 0, 0, 0, 0);
  ExpectWords(ErrorOf(pose, 0), { "pose 1: the time 0 is not after that of pose 0" });
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
  ExpectWords(errorWith(nan, good), { "pose 1: the time nan is not finite" });
  ExpectWords(errorWith(1, with(3, nan)), { "pose 1: the transform" });
  ExpectWords(errorWith(1, with(3, nan)), { "is not finite" });
  ExpectWords(errorWith(1, with(0, 0)), { "is singular" });
  ExpectWords(errorWith(1, with(12, 1)), { "is not affine" });
  ExpectWords(errorWith(1, with(1, 0.5)), { "pose 1: the pose shears" });
  ExpectWords(errorWith(1, with(0, -1)), { "pose 1: the pose mirrors, unlike the one before" });
  const auto observer = ErrorObserver::Watch(pose);
  pose->AddPoseMatrix(1, static_cast<vtkMatrix4x4*>(nullptr));
  EXPECT_EQ(observer->Errors.size(), 1u);
}
