// SPDX-License-Identifier: BSD-3-Clause
// The parts of the scene, against what is known of them beforehand.
#include "../../Testing/MessageOf.h"
#include "../../Testing/WriteFile.h"
#include "Meshes.h"
#include "Options.h"
#include "OutputFolder.h"
#include "TeapotScene.h"

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkCleanPolyData.h>
#include <vtkIdList.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkOBJWriter.h>
#include <vtkPLYWriter.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>
#include <vtkSTLWriter.h>
#include <vtkTransform.h>
#include <vtkTriangle.h>
#include <vtkXMLPolyDataWriter.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <stdexcept>

using namespace movingteapot;

namespace
{

using Point = std::array<double, 3>;

// Edges with a cell on one side only; fails where cells disagree about the front or more than two
// meet.
int CountBoundaryEdges(vtkPolyData* mesh)
{
  std::map<std::pair<vtkIdType, vtkIdType>, int> uses; // of each edge, from one point to the other
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    mesh->GetCellPoints(cell, ids);
    const vtkIdType n = ids->GetNumberOfIds();
    for (vtkIdType i = 0; i < n; ++i)
    {
      ++uses[{ ids->GetId(i), ids->GetId((i + 1) % n) }];
    }
  }
  int count = 0;
  for (const auto& [edge, times] : uses)
  {
    EXPECT_EQ(times, 1) << "edge " << edge.first << " " << edge.second;
    count += uses.count({ edge.second, edge.first }) == 0;
  }
  return count;
}

vtkIdType CountDistinctPoints(vtkPolyData* mesh)
{
  vtkNew<vtkCleanPolyData> merge;
  merge->SetInputData(mesh);
  merge->Update();
  return merge->GetOutput()->GetNumberOfPoints();
}

// Of the cones from `apex` over the first three points of each cell; positive where cells show
// their front outward.
double SignedVolume(vtkPolyData* mesh, vtkIdType first, vtkIdType last, const Point& apex)
{
  double volume = 0.0;
  for (vtkIdType cell = first; cell < last; ++cell)
  {
    Point corner[3];
    for (int i = 0; i < 3; ++i)
    {
      mesh->GetPoint(mesh->GetCell(cell)->GetPointId(i), corner[i].data());
      vtkMath::Subtract(corner[i].data(), apex.data(), corner[i].data());
    }
    volume += vtkMath::Determinant3x3(corner[0].data(), corner[1].data(), corner[2].data()) / 6.0;
  }
  return volume;
}

bool Has(const std::string& text, const char* part)
{
  return text.find(part) != std::string::npos;
}

}

// The round parts are four equal quarters: a wrong digit in any of them would show.
TEST(UtahTeapotPatches, RoundPartsAreFourEqualQuarters)
{
  const std::vector<Patch> patches = ReadTeapotPatches();
  ASSERT_EQ(patches.size(), 32u);
  for (int first : { 0, 4, 8, 20, 24, 28 })
  {
    const bool bottom = first == 28; // runs the other way round
    for (int quarter = 0; quarter < 4; ++quarter)
    {
      const Patch& net = patches[first + quarter];
      const Patch& next = patches[first + (quarter + 1) % 4];
      for (int i = 0; i < 16; ++i)
      {
        const auto [x, y, z] = net[i];
        const Point turned = bottom ? Point{ -y, x, z } : Point{ y, -x, z };
        EXPECT_EQ(turned, next[i]) << "patch " << first + quarter << ", point " << i;
      }
    }
  }
}

TEST(UtahTeapotPatches, HandleAndSpoutAreSymmetric)
{
  const std::vector<Patch> patches = ReadTeapotPatches();
  for (int patch : { 12, 14, 16, 18 })
  {
    const Patch& net = patches[patch];
    const Patch& mirrored = patches[patch + 1];
    for (int i = 0; i < 16; ++i)
    {
      const auto [x, y, z] = net[i];
      const Point expected = { x, -y, z };
      EXPECT_EQ(expected, mirrored[4 * (i / 4) + 3 - i % 4])
        << "patch " << patch << ", point " << i;
    }
  }
}

TEST(UtahTeapot, PatchesMeetBitForBit)
{
  for (int n : { 2, 3, 7, 10, 16 })
  {
    auto teapot = MakeUtahTeapot(n);
    EXPECT_EQ(teapot->GetNumberOfCells(), 64 * n * n - 8 * n);
    EXPECT_EQ(CountDistinctPoints(teapot), teapot->GetNumberOfPoints());
    // What is open: rim and lid with 4n edges each, both ends of handle and spout with 2n each.
    EXPECT_EQ(CountBoundaryEdges(teapot), 16 * n) << n << " segments";
  }
}

TEST(UtahTeapot, HasThePublishedSize)
{
  double b[6];
  MakeUtahTeapot(20)->GetBounds(b);
  EXPECT_DOUBLE_EQ(b[0], -3.0);
  EXPECT_NEAR(b[1], 3.434, 0.002); // the lip of the spout stays inside its control points
  EXPECT_DOUBLE_EQ(b[2], -b[3]);
  EXPECT_NEAR(b[3], 2.0, 0.02);
  EXPECT_DOUBLE_EQ(b[4], 0.0);
  EXPECT_FLOAT_EQ(b[5], 3.15);
}

TEST(UtahTeapot, HasNoEmptyTriangle)
{
  auto teapot = MakeUtahTeapot(10);
  for (vtkIdType cell = 0; cell < teapot->GetNumberOfCells(); ++cell)
  {
    auto* triangle = vtkTriangle::SafeDownCast(teapot->GetCell(cell));
    EXPECT_GT(triangle->ComputeArea(), 1e-6) << "triangle " << cell;
  }
}

// Where a part is open, its ends are flat enough for a cone from their middle to close it.
TEST(UtahTeapot, ShowsItsFrontOutward)
{
  const int n = 40;
  auto teapot = MakeUtahTeapot(n);
  const vtkIdType perPatch = 2 * n * n, perPole = perPatch - n;
  const vtkIdType handle = 12 * perPatch, spout = 16 * perPatch, lid = 20 * perPatch;
  const vtkIdType plate = lid + 4 * perPole, bottom = plate + 4 * perPatch;
  const vtkIdType end = bottom + 4 * perPole;
  ASSERT_EQ(end, teapot->GetNumberOfCells());

  const Point rim = { 0, 0, 2.4 };
  const double pot = SignedVolume(teapot, 0, handle, rim) + SignedVolume(teapot, bottom, end, rim);
  EXPECT_NEAR(pot, 24.4013, 0.01); // the solid of revolution, integrated along the profile
  EXPECT_GT(SignedVolume(teapot, lid, bottom, { 0, 0, 2.4 }), 0.1);
  EXPECT_GT(SignedVolume(teapot, handle, spout, { -2.0, 0, 1.5 }), 0.05);
  EXPECT_GT(SignedVolume(teapot, spout, lid, { 2.0, 0, 1.2 }), 0.1);
}

TEST(GridBox, IsClosedAndLooksInward)
{
  const Box box = { -1, 2, 0, 1, 0, 1.5 };
  auto room = MakeGridBox(box, 0.1, Facing::Inward, { { 0.5, 0.5, 0.5, 0.5, 0.2, 0.7 } });
  EXPECT_EQ(room->GetNumberOfCells(), 2 * (30 * 10 + 10 * 15 + 30 * 15));
  EXPECT_EQ(CountBoundaryEdges(room), 0);
  EXPECT_EQ(CountDistinctPoints(room), room->GetNumberOfPoints());
  // Half of each quad is in the cones.
  const double volume = 2 * SignedVolume(room, 0, room->GetNumberOfCells(), { 0.5, 0.5, 0.75 });
  EXPECT_NEAR(volume, -4.5, 1e-5);
}

TEST(GridBox, LeavesOutASideWithoutReflectance)
{
  const Box box = { 0, 1, 0, 1, 0, 1 };
  auto lid = MakeGridBox(box, 0.5, Facing::Outward, { { {}, {}, {}, {}, {}, 0.3 } });
  ASSERT_EQ(lid->GetNumberOfCells(), 4);
  double bounds[6];
  lid->GetBounds(bounds);
  EXPECT_EQ(bounds[4], 1.0);
  EXPECT_GT(SignedVolume(lid, 0, 1, { 0.5, 0.5, 0 }), 0.0);
  EXPECT_EQ(lid->GetCellData()->GetArray("DiffuseReflectance")->GetTuple1(3), 0.3);
}

TEST(OffFile, ReadsPointsAndPolygons)
{
  const auto path = WriteFile("good.off",
    "OFF # a comment\n\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0 # corner\n3 0 1 2 255 0 0\n4 0 1 2 3\n");
  auto mesh = ReadMeshFile(path);
  EXPECT_EQ(mesh->GetNumberOfPoints(), 4);
  ASSERT_EQ(mesh->GetNumberOfPolys(), 2);
  EXPECT_EQ(mesh->GetCell(1)->GetNumberOfPoints(), 4);
}

TEST(OffFile, SaysWhatIsWrongWhere)
{
  const auto read = [](const char* text) {
    return MessageOf([&] { ReadMeshFile(WriteFile("bad.off", text)); });
  };
  EXPECT_PRED2(Has, read("PLY\n"), "line 1: \"OFF\" expected");
  EXPECT_PRED2(Has, read("OFF\n3 x 0\n"), "line 2: the numbers");
  EXPECT_PRED2(Has, read("OFF\n2 1 0\n0 0 0\n1 0\n"), "line 4: three coord");
  EXPECT_PRED2(
    Has, read("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"), "line 6: a point number from 0 to 2");
  EXPECT_PRED2(Has, read("OFF\n3 1 0\n0 0 0\n1 0 0\n"), "ends too early");
}

TEST(MeshFile, NamesTheFileItCannotUse)
{
  const auto read = [](const std::string& path) { return MessageOf([&] { ReadMeshFile(path); }); };
  EXPECT_PRED2(Has, read("/nowhere/head.ply"), "/nowhere/head.ply: there is no such file");
  EXPECT_PRED2(Has, read(WriteFile("head.xyz", "1 2 3")), "unknown kind");
  EXPECT_PRED2(Has, read(WriteFile("empty.off", "OFF\n1 0 0\n0 0 0\n")), "no polygon");
  EXPECT_PRED2(Has, read(WriteFile("broken.vtp", "not xml")), "broken.vtp");
}

template <typename Writer>
int CountAfterRoundTrip(const std::string& name)
{
  const std::string path = testing::TempDir() + name;
  vtkNew<Writer> writer;
  writer->SetInputData(MakeUtahTeapot(3));
  writer->SetFileName(path.c_str());
  writer->Write();
  return int(ReadMeshFile(path)->GetNumberOfPolys());
}

TEST(MeshFile, ReadsWhatVtkWrites)
{
  const int count = 64 * 9 - 8 * 3;
  EXPECT_EQ(CountAfterRoundTrip<vtkOBJWriter>("teapot.obj"), count);
  EXPECT_EQ(CountAfterRoundTrip<vtkPLYWriter>("teapot.ply"), count);
  EXPECT_EQ(CountAfterRoundTrip<vtkSTLWriter>("teapot.STL"), count);
  EXPECT_EQ(CountAfterRoundTrip<vtkXMLPolyDataWriter>("teapot.vtp"), count);
  EXPECT_EQ(CountAfterRoundTrip<vtkPolyDataWriter>("teapot.vtk"), count);
}

TEST(MeshFile, FitsAMeshIntoABox)
{
  auto mesh =
    ReadMeshFile(WriteFile("tall.off", "OFF 4 1 0\n0 0 0\n10 0 0\n10 0 40\n0 0 40\n4 0 1 2 3\n"));
  const Box box = { 1, 3, 1, 3, 5, 7 };
  double b[6];
  FitMesh(mesh, box)->GetBounds(b);
  const double expected[6] = { 1.75, 2.25, 2.0, 2.0, 5.0, 7.0 };
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(b[i], expected[i], 1e-6);
  }
}

TEST(OutputFolder, LosesWhatAnEarlierRunLeftAndNothingElse)
{
  const std::string folder = testing::TempDir() + "earlier/run";
  const auto write = [&](const char* name) {
    const std::filesystem::path path = folder + "/" + name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path.string()) << "text";
  };
  for (const char* name :
    { "A.png", "A.png.mine", "mine/A.png", "A/A_1.vtp", "B/A_1.vtp", "B/mine.vtp" })
  {
    write(name);
  }
  PrepareFolder(folder, R"(A\.png|[AB](/A_\d\.vtp)?)");
  std::set<std::string> left;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
  {
    left.insert(std::filesystem::relative(entry.path(), folder).generic_string());
  }
  const std::set<std::string> expected = { "A.png.mine", "B", "B/mine.vtp", "mine", "mine/A.png" };
  EXPECT_EQ(left, expected);
  EXPECT_PRED2(Has, MessageOf([] { PrepareFolder("/dev/null/x", "A"); }), "--output: /dev/null/x");
}

TEST(TeapotPath, StaysInTheRoomAndAboveTheHead)
{
  const TeapotScene scene = MakeTeapotScene({});
  double room[6];
  scene.Room->GetBounds(room);
  TeapotPath path;
  vtkNew<vtkTransform> pose;
  const double millimetre = 1e-3;
  for (int frame = 0; frame <= 200; ++frame)
  {
    path.SetPose(frame / 200.0, pose);
    EXPECT_NEAR(pose->GetMatrix()->Determinant(), 1.0, 1e-12);
    for (vtkIdType i = 0; i < scene.Teapot->GetNumberOfPoints(); ++i)
    {
      double x[3];
      pose->TransformPoint(scene.Teapot->GetPoint(i), x);
      const bool inside = x[0] > room[0] && x[0] < room[1] && x[1] > room[2] && x[1] < room[3] &&
        x[2] > room[4] - millimetre && x[2] < room[5] - 0.02;
      const bool overHead = std::abs(x[0]) < 0.25 && std::abs(x[1] - 0.1) < 0.4;
      ASSERT_TRUE(inside) << "frame " << frame << ": " << x[0] << " " << x[1] << " " << x[2];
      ASSERT_TRUE(!overHead || x[2] > 1.2) << "frame " << frame << ": " << x[2];
    }
  }
}

TEST(TeapotPath, IsSmooth)
{
  TeapotPath path;
  vtkNew<vtkTransform> pose;
  double last[3] = { 1.05, -0.35, 0.0 };
  for (int frame = 0; frame < 60; ++frame)
  {
    path.SetPose(frame / 59.0, pose);
    EXPECT_LT(std::sqrt(vtkMath::Distance2BetweenPoints(last, pose->GetPosition())), 0.15);
    pose->GetPosition(last);
  }
}

TEST(Options, TakesValuesWithBlankOrEqualSign)
{
  const Options options = ReadOptions({ "--walks", "5e6", "--frames=7", "--size=640x360",
    "--traversal=onetree", "--no-pictures", "--head=a b.ply" });
  EXPECT_EQ(options.Walks, 5000000);
  EXPECT_EQ(options.Frames, 7);
  EXPECT_EQ(options.Width, 640);
  EXPECT_EQ(options.Height, 360);
  EXPECT_EQ(options.TraversalMode, 0);
  EXPECT_FALSE(options.Pictures);
  EXPECT_EQ(options.Scene.HeadFile, "a b.ply");
}

TEST(Options, SaysWhatIsWrong)
{
  const auto read = [](const std::vector<std::string>& words) {
    return MessageOf([&] { ReadOptions(words); });
  };
  EXPECT_EQ(read({ "--wlaks", "3" }), "--wlaks: there is no such option");
  EXPECT_EQ(read({ "stray" }), "stray: there is no such option");
  EXPECT_EQ(read({ "--walksfoo", "3" }), "--walksfoo: there is no such option");
  EXPECT_EQ(read({ "--frames" }), "--frames: its value is missing");
  EXPECT_EQ(
    read({ "--walks", "many" }), "--walks: a whole number, at least 1, is expected, not \"many\"");
  EXPECT_PRED2(Has, read({ "--walks", "1.5" }), "--walks: a whole number");
  EXPECT_PRED2(Has, read({ "--frames", "1" }), "at least 2");
  EXPECT_PRED2(Has, read({ "--walks", "3000000000" }), "--walks");
  EXPECT_PRED2(Has, read({ "--size", "640" }), "1280x720");
  EXPECT_PRED2(Has, read({ "--size", "640x36O" }), "--size");
  EXPECT_PRED2(Has, read({ "--size", "9000x360" }), "8192x8192");
  EXPECT_PRED2(Has, read({ "--traversal", "both" }), "onetree, sequential or parallel");
  EXPECT_PRED2(Has, read({ "--cell-size", "0" }), "--cell-size");
}
