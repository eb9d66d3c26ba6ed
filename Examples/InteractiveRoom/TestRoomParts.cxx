// SPDX-License-Identifier: BSD-3-Clause
// Scenes, options, files and figures: what needs no window.
#include "../../Testing/MessageOf.h"
#include "../../Testing/WriteFile.h"
#include "EventFile.h"
#include "LightFollower.h"
#include "MeanError.h"
#include "RoomOptions.h"
#include "RoomPresets.h"
#include "SceneView.h"
#include "Shapes.h"
#include "UserMeshes.h"

#include <vtkActor.h>
#include <vtkMapper.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkXMLPolyDataWriter.h>

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <limits>

using namespace interactiveroom;

namespace
{

bool Has(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

}

// Two squares of 1 m2 and one of 4 m2 that shines.
TEST(MeanError, IsByAreaWhereItIsKnown)
{
  const auto square = [](double side, double irradiance, double error) {
    vtkNew<vtkPlaneSource> plane;
    plane->SetPoint1(side, 0, 0);
    plane->SetPoint2(0, side, 0);
    plane->SetOrigin(0, 0, 0);
    plane->Update();
    Mesh mesh = plane->GetOutput();
    SetCellValue(mesh, "Irradiance", irradiance);
    SetCellValue(mesh, "IrradianceStandardError", error);
    return mesh;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Room room;
  room.Still = { { square(1, 10, 1) }, { square(2, 20, 3), true }, { square(1, 7, nan) } };
  vtkNew<vtkMultiBlockDataSet> scene;
  for (unsigned int i = 0; i < 3; ++i)
  {
    scene->SetBlock(i, room.Still[i].Mesh);
  }
  const MeanError error(room);
  EXPECT_DOUBLE_EQ(error.Of(scene), (1 * 1 + 4 * 3) / (1 * 10 + 4 * 20.0));
  EXPECT_EQ(error.Quantile(scene, 0.5), 7);
  EXPECT_EQ(error.Quantile(scene, 0.95), 10);
}

TEST(Presets, AreLitAndHaveThingsToMoveWithinTheirLimits)
{
  for (const std::string& name : PresetNames())
  {
    const Room room = MakePreset(name);
    EXPECT_EQ(room.Moving.size(), 5u) << name;
    LightFollower light(room, 20000, 8);
    light.Shoot({});
    EXPECT_GT(light.GetFilter()->GetFigure("EmittedPower"), 0) << name;
    for (std::size_t i = 0; i < room.Moving.size(); ++i)
    {
      double b[6];
      vtkPolyData::SafeDownCast(
        vtkMultiBlockDataSet::SafeDownCast(light.GetScene()->GetBlock(1))->GetBlock(int(i)))
        ->GetBounds(b);
      for (int axis = 0; axis < 3; ++axis)
      {
        EXPECT_GE(b[2 * axis], (*room.Limits)[2 * axis] - 1e-6) << room.Moving[i].Name;
        EXPECT_LE(b[2 * axis + 1], (*room.Limits)[2 * axis + 1] + 1e-6) << room.Moving[i].Name;
      }
    }
  }
}

TEST(UserMeshes, AreScaledToMetresAndGetALampIfNoneShines)
{
  const std::string square =
    WriteFile("square.off", "OFF 4 1 0\n0 0 0\n1000 0 0\n1000 2000 0\n0 2000 0\n4 0 1 2 3\n");
  const Room unlit = ReadUserRoom({ square }, { square }, 0.001);
  ASSERT_EQ(unlit.Still.size(), 2u);
  EXPECT_TRUE(unlit.Still[1].IsLamp);
  double b[6];
  unlit.Moving.at(0).Mesh->GetBounds(b);
  EXPECT_NEAR(b[1], 1, 1e-6);
  EXPECT_NEAR(b[3], 2, 1e-6);
  unlit.Still[1].Mesh->GetBounds(b);
  EXPECT_GT(b[4], 0);
  EXPECT_EQ(unlit.Moving[0].Name, "square");

  Mesh lamp = MakeLamp({ 0, 1, 0, 1, 3, 3 }, 50).Mesh;
  const std::string shining = testing::TempDir() + "lamp.vtp";
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(lamp);
  writer->SetFileName(shining.c_str());
  writer->Write();
  EXPECT_EQ(ReadUserRoom({ shining }, { square }, 1).Still.size(), 1u);
}

// A point light and a strip of two triangles: the light's cell comes first, and is no surface.
TEST(UserMeshes, MayHaveLightsAndStrips)
{
  const std::string file = WriteFile("strip.vtk",
    "# vtk DataFile Version 3.0\nstrip\nASCII\nDATASET POLYDATA\nPOINTS 5 float\n"
    "0 0 0 1 0 0 0 1 0 1 1 0 0.5 0.5 2\nVERTICES 1 2\n1 4\nTRIANGLE_STRIPS 1 5\n4 0 1 2 3\n"
    "CELL_DATA 2\nSCALARS RadiantFlux double 1\nLOOKUP_TABLE default\n100 0\n");
  const Room room = ReadUserRoom({ file }, { file }, 1);
  ASSERT_EQ(room.Still.size(), 1u); // the light is lamp enough
  EXPECT_EQ(room.Still[0].Mesh->GetNumberOfPolys(), 2);
  LightFollower light(room, 20000, 8);
  light.GetPose(0)->Translate(0, 0, 0.5); // else they coincide
  light.Shoot({});
  EXPECT_NEAR(light.GetFilter()->GetFigure("EmittedPower"), 200, 1e-6);
  vtkNew<vtkRenderer> renderer;
  SceneView view(room, light, renderer);
  view.SetBrightest(1e-3); // all that is lit has the last colour
  view.Show(light.GetScene(), false);
  vtkPolyData* shown =
    vtkPolyData::SafeDownCast(view.GetActor(0)->GetMapper()->GetInputDataObject(0, 0));
  EXPECT_EQ(shown->GetNumberOfPolys(), 2);
  EXPECT_EQ(shown->GetNumberOfPoints(), 6);
  const double* last = view.GetColors()->GetTableValue(255);
  for (vtkIdType i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(shown->GetPointData()->GetScalars()->GetComponent(i, 0), 255 * last[0], 1) << i;
  }
}

TEST(RoomOptions, SayWhatIsWrong)
{
  const auto read = [](const std::vector<std::string>& words) {
    return MessageOf([&] { ReadOptions(words); });
  };
  EXPECT_EQ(
    read({ "--preset", "cellar" }), "--preset: room, oven or aisle is expected, not \"cellar\"");
  EXPECT_EQ(read({ "--static", "a.stl" }), "--dynamic: there is nothing to move");
  EXPECT_EQ(read({ "--events", "/nowhere" }), "--events: /nowhere: there is no such file");
  EXPECT_EQ(read({ "--events", INTERACTIVEROOM_EVENTS, "--frames", "3" }),
    "--events excludes --record and --frames");
  EXPECT_PRED2(Has, read({ "--record", "a", "--frames", "3" }), "exclude each other");
  EXPECT_PRED2(Has, read({ "--movie" }), "--movie");
  EXPECT_PRED2(Has, read({ "--size", "10x10" }), "--size");
  EXPECT_PRED2(Has, read({ "--unit", "0" }), "--unit");
  EXPECT_PRED2(
    Has, MessageOf([] { ReadUserRoom({ "/nowhere.stl" }, {}, 1); }), "--static: /nowhere");
  EXPECT_PRED2(
    Has, MessageOf([] { ReadUserRoom({}, { "/nowhere.stl" }, 1); }), "--dynamic: /nowhere");
}

TEST(EventFile, NamesTheFileThatCannotBePlayedOrWritten)
{
  vtkNew<vtkRenderWindowInteractor> interactor;
  const auto play = [&](const std::string& text) {
    return MessageOf([&] { PlayEvents(WriteFile("bad.events", text), interactor); });
  };
  EXPECT_PRED2(Has, play("# StreamVersion 1.1\n"), "bad.events: there is no event in it");
  EXPECT_PRED2(
    Has, play("# a comment\nJumpEvent 1 2\n"), "line 2: \"JumpEvent\" is no event of VTK");
  EXPECT_EQ(MessageOf([&] { RecordEvents("/dev/null/x", interactor); }),
    "--record: /dev/null/x cannot be written");
}
