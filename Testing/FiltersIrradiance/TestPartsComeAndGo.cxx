// SPDX-License-Identifier: BSD-3-Clause
// Dynamic parts that appear and leave: an update, bit for bit what a new filter gives.

#include "ErrorObserver.h"
#include "OutputBits.h"
#include "TestScenes.h"

#include "vtkKeyFramedPose.h"
#include "vtkOutgoingRadianceFilter.h"

#include <gtest/gtest.h>

#include <map>

using namespace TestScenes;

namespace
{

constexpr vtkIdType Walks = 4000;

/// A part on port 1, of which the model may be away.
struct Part
{
  Mesh Model;
  Mesh Now = Mesh::New(); ///< what the filter sees
  vtkSmartPointer<vtkTransform> Pose = vtkSmartPointer<vtkTransform>::New();

  explicit Part(const Mesh& model)
    : Model(model)
  {
    this->Appear();
  }
  void Appear() { this->Now->ShallowCopy(this->Model); }
  void Leave() { this->Now->ShallowCopy(Mesh::New()); }
  bool IsThere() const { return this->Now->GetNumberOfCells() > 0; }
  void MoveTo(double x, double y, double z)
  {
    this->Pose->Identity();
    this->Pose->Translate(x, y, z);
  }
};

std::vector<Mesh> MakeHall()
{
  const Mesh room = MakeRoom(3, 4);
  SetCellValues(room, "DiffuseReflectance", { 0.6 });
  return { room, MakeLamp({ 1.5, 1.5, 2.875 }, 0.75, { 100 }) };
}

/// A hall and some parts, as a filter sees them.
class Hall
{
public:
  explicit Hall(std::vector<Part> parts)
    : Parts(std::move(parts))
    , Filter(this->MakeNew())
  {
  }

  vtkSmartPointer<vtkIrradianceFilter> MakeNew() const
  {
    Scene scene{ this->Fixed, {} };
    for (const Part& part : this->Parts)
    {
      scene.Moving.push_back({ part.Now, part.Pose });
    }
    return MakeFilter(scene, Walks);
  }

  /// An update that equals a new filter; nothing is shot except at first.
  void ExpectUpdate(const std::string& what)
  {
    EXPECT_TRUE(UpdatesLike(this->Filter, this->MakeNew())) << what;
    ASSERT_EQ(this->Filter->GetOutput()->GetNumberOfBlocks(), 2u) << what;
    EXPECT_EQ(Field(this->Filter, "ShootSeconds") > 0, !this->HasBegun) << what;
    EXPECT_EQ(Field(this->Filter, "EmittedPower"),
      Field(this->Filter, "AbsorbedPower") + Field(this->Filter, "EscapedPower"));
    this->HasBegun = true;
  }

  std::vector<Mesh> Fixed = MakeHall();
  std::vector<Part> Parts;
  vtkSmartPointer<vtkIrradianceFilter> Filter;
  bool HasBegun = false;
};

Part Away(Part part)
{
  part.Leave();
  return part;
}

}

TEST(PartsComeAndGo, TheOnlyOne)
{
  Hall hall({ Part(MakeBall(0.4, 8)) });
  hall.Parts[0].MoveTo(1, 1.5, 1);
  hall.ExpectUpdate("there");
  const OutputBits there(hall.Filter);
  hall.Parts[0].Leave();
  hall.ExpectUpdate("gone");
  EXPECT_GT(Field(hall.Filter, "NumberOfRepairedSegments"), 0);
  EXPECT_LT(Field(hall.Filter, "NumberOfInvalidWalks"), Walks / 2);
  EXPECT_EQ(OutputOf(hall.Filter->GetOutput(), 1, 0)->GetNumberOfCells(), 0);
  hall.Parts[0].MoveTo(2, 1.5, 1); // out of sight
  hall.ExpectUpdate("still gone");
  EXPECT_EQ(Field(hall.Filter, "NumberOfInvalidWalks"), 0);
  EXPECT_EQ(Field(hall.Filter, "VerifySeconds"), 0);
  hall.Parts[0].MoveTo(1, 1.5, 1);
  hall.Parts[0].Appear();
  hall.ExpectUpdate("back");
  EXPECT_TRUE(IsSame(OutputBits(hall.Filter), there));
}

TEST(PartsComeAndGo, OneThatWasNeverThereBefore)
{
  Hall hall({ Away(Part(MakeBall(0.4, 8))), Part(MakeBox(0.5, 0.6, 0.7)) });
  hall.Parts[1].MoveTo(2, 2, 1);
  hall.ExpectUpdate("without the first");
  hall.Parts[0].MoveTo(1, 1, 1);
  hall.Parts[0].Appear();
  hall.ExpectUpdate("with it");
  hall.Parts[0].MoveTo(1.25, 1, 1);
  hall.ExpectUpdate("moved");
  hall.Parts[0].Leave();
  hall.Parts[1].Leave();
  hall.ExpectUpdate("none");
  // Another comes in its place.
  hall.Parts[0].Model = MakeCone(0.8, 0.4, 9);
  SetCellValues(hall.Parts[0].Model, "DiffuseReflectance", { 0.9 });
  hall.Parts[0].Appear();
  hall.Parts[1].Appear();
  hall.ExpectUpdate("another");
}

// What a budget leaves stale on a part that has gone is repaired later.
TEST(PartsComeAndGo, WithATimeBudget)
{
  Hall hall({ Part(MakeBall(0.5, 8)), Away(Part(MakeBox(0.4, 0.5, 0.6))) });
  hall.Parts[0].MoveTo(1, 1.5, 1.5);
  hall.Parts[1].MoveTo(2, 1.5, 1.5);
  hall.ExpectUpdate("at first");
  const auto expectRepaired = [&](const char* what) {
    hall.Filter->SetRepairTimeBudget(0);
    hall.ExpectUpdate(what);
    hall.Filter->SetRepairTimeBudget(1e-9);
  };
  hall.Filter->SetRepairTimeBudget(1e-9);
  hall.Parts[0].Leave();
  hall.Filter->Update();
  EXPECT_GT(Field(hall.Filter, "StalePower"), 0);
  hall.Filter->Modified();
  hall.Filter->Update(); // absent, and still with stale walks on it
  EXPECT_GT(Field(hall.Filter, "StalePower"), 0);
  EXPECT_EQ(Field(hall.Filter, "ShootSeconds"), 0);
  hall.Parts[0].MoveTo(1.25, 1.5, 1.5);
  hall.Parts[0].Appear();
  hall.Filter->Update(); // back before all was repaired
  EXPECT_GT(Field(hall.Filter, "StalePower"), 0);
  EXPECT_EQ(Field(hall.Filter, "ShootSeconds"), 0);
  expectRepaired("back");
  hall.Parts[0].Leave();
  hall.Filter->Update();
  expectRepaired("gone");
  hall.Parts[1].Appear(); // for the first time, and nothing is stale: an update
  hall.Filter->Update();
  EXPECT_GT(Field(hall.Filter, "StalePower"), 0);
  EXPECT_EQ(Field(hall.Filter, "ShootSeconds"), 0);
  // Another part comes in the first one's place while walks are stale: a fresh start.
  hall.Parts[0].Model = MakeCone(0.8, 0.4, 9);
  hall.Parts[0].Appear();
  hall.Filter->Update();
  EXPECT_GT(Field(hall.Filter, "ShootSeconds"), 0);
  EXPECT_EQ(Field(hall.Filter, "StalePower"), 0);
  expectRepaired("another");
}

// A lamp that comes or goes changes all light: all is shot again, and right.
TEST(PartsComeAndGo, LampsStartAnew)
{
  Hall hall({ Part(MakeBall(0.4, 8)), Away(Part(MakeLamp({ 0, 0, 0 }, 0.5, { 50 }))) });
  hall.Parts[0].MoveTo(1, 1, 1);
  hall.Parts[1].MoveTo(2, 2, 2);
  for (const bool isThere : { false, true, false })
  {
    isThere ? hall.Parts[1].Appear() : hall.Parts[1].Leave();
    hall.HasBegun = false;
    hall.ExpectUpdate(isThere ? "lamp" : "no lamp");
  }
}

// One that lay exactly on the lamp, and a point light on a wall.
TEST(PartsComeAndGo, WhereTheyTouchALamp)
{
  Hall hall({ Part(MakeBox(0.5, 0.5, 0.5)) });
  hall.Parts[0].MoveTo(1.5, 1.5, 2.875 - 0.25);
  ASSERT_NO_FATAL_FAILURE(hall.ExpectUpdate("on the lamp"));
  for (int i = 0; i < 2; ++i)
  {
    hall.Parts[0].Leave();
    ASSERT_NO_FATAL_FAILURE(hall.ExpectUpdate("gone"));
    hall.Parts[0].Appear();
    ASSERT_NO_FATAL_FAILURE(hall.ExpectUpdate("on the lamp again"));
  }
}

// Without light there are no walks, but what looks at cells finds the cells of the present parts.
TEST(PartsComeAndGo, InTheDark)
{
  const Mesh room = MakeRoom(3, 2), ball = MakeBall(0.4, 12), now = Mesh::New();
  auto filter = MakeFilter({ { room }, { { now, vtkSmartPointer<vtkTransform>::New() } } }, Walks);
  const auto observer = ErrorObserver::Watch(filter); // takes the warnings
  vtkNew<vtkOutgoingRadianceFilter> eye;
  eye->SetInputConnection(filter->GetOutputPort());
  eye->SetEyePosition(0.2, 0.3, 2.5);
  eye->Update();
  now->ShallowCopy(ball);
  eye->Update();
  vtkDataArray* radiance = OutputOf(eye->GetOutput(), 1, 0)->GetCellData()->GetArray("Radiance");
  ASSERT_EQ(radiance->GetNumberOfTuples(), ball->GetNumberOfCells());
  for (vtkIdType cell = 0; cell < radiance->GetNumberOfTuples(); ++cell)
  {
    EXPECT_EQ(radiance->GetComponent(cell, 0), 0);
  }
}

// A conveyor: parts come in, ride along and leave, each in its time; also back in time.
TEST(PartsComeAndGo, OnAConveyor)
{
  Scene scene{ MakeHall(), {} };
  auto filter = MakeFilter(scene, Walks);
  std::vector<vtkSmartPointer<vtkKeyFramedPose>> parts;
  const Mesh models[] = { MakeBall(0.3, 8), MakeBox(0.4, 0.4, 0.4), MakeCone(0.5, 0.3, 8) };
  for (int i = 0; i < 3; ++i)
  {
    auto part = vtkSmartPointer<vtkKeyFramedPose>::New();
    part->SetInputData(models[i]);
    part->AddPose(i, 0.5, 1.5, 1, 0, 0, 0);
    part->AddPose(i + 2, 2.5, 1.5, 1, 0, 0, 90);
    part->SetOutsideOfKeysToLeave();
    filter->AddInputConnection(1, part->GetOutputPort());
    parts.push_back(part);
  }
  std::map<double, OutputBits> first;
  for (const double time : { 0.25, 1., 1.5, 2.25, 3.5, 4., 9., 1.5, 0.25, 9., 2.25, -1., 3.5 })
  {
    filter->UpdateTimeStep(time);
    EXPECT_EQ(Field(filter, "ShootSeconds") > 0, first.empty()) << "time " << time;
    const auto known = first.emplace(time, OutputBits(filter)).first;
    EXPECT_TRUE(IsSame(OutputBits(filter), known->second)) << "time " << time;
    auto fresh = MakeFilter(scene, Walks);
    for (const auto& part : parts)
    {
      fresh->AddInputConnection(1, part->GetOutputPort());
    }
    fresh->UpdateTimeStep(time);
    EXPECT_TRUE(IsSame(OutputBits(filter), OutputBits(fresh))) << "time " << time;
  }
}
