// SPDX-License-Identifier: BSD-3-Clause
// The filter in a VTK pipeline: what makes it execute, and what it then does again.

#include "EventObserver.h"
#include "OutputBits.h"
#include "TestScenes.h"

#include "vtkInformation.h"

#include <gtest/gtest.h>

#include <functional>
#include <utility>

using namespace TestScenes;

namespace
{

constexpr vtkIdType NumberOfWalks = 1000;

/// Updates; true if the output has the bits of a new filter's.
testing::AssertionResult UpdatesLikeANewOne(vtkIrradianceFilter* filter, const Scene& scene)
{
  const auto fresh = MakeFilter(scene, filter->GetNumberOfWalks());
  for (const int index : { 0, 1, 4 })
  {
    vtkInformation* info = filter->GetInputArrayInformation(index);
    fresh->SetInputArrayToProcess(
      index, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, info->Get(vtkDataObject::FIELD_NAME()));
  }
  fresh->SetDefaultDiffuseReflectance(filter->GetDefaultDiffuseReflectance());
  return UpdatesLike(filter, fresh);
}

bool HasShot(vtkIrradianceFilter* filter)
{
  return Field(filter, "ShootSeconds") > 0;
}

}

TEST(Pipeline, GetMTimeCountsTheTransforms)
{
  const Scene scene = MakeSmallScene();
  const auto filter = MakeFilter(scene, NumberOfWalks);
  const vtkMTimeType before = filter->GetMTime();
  scene.Moving[1].Pose->RotateX(1);
  EXPECT_GT(filter->GetMTime(), before);
  const vtkMTimeType moved = filter->GetMTime();
  filter->SetDynamicTransform(1, scene.Moving[1].Pose);
  EXPECT_EQ(filter->GetMTime(), moved);
  filter->SetDynamicTransform(1, nullptr);
  EXPECT_GT(filter->GetMTime(), moved);
  EXPECT_EQ(filter->GetDynamicTransform(1), nullptr);
  EXPECT_EQ(filter->GetDynamicTransform(0), scene.Moving[0].Pose);
}

TEST(Pipeline, ExecutesOnlyWhenSomethingChanged)
{
  const Scene scene = MakeSmallScene();
  const auto filter = MakeFilter(scene, NumberOfWalks);
  const auto counter = EventObserver::Watch(filter, vtkCommand::StartEvent);
  filter->Update();
  filter->Update();
  filter->SetNumberOfWalks(NumberOfWalks);
  filter->SetTraversalModeToParallel();
  filter->Update();
  EXPECT_EQ(counter->Count, 1);
  scene.Moving[0].Pose->RotateX(10);
  filter->Update();
  filter->Update();
  EXPECT_EQ(counter->Count, 2);
}

// As a GUI does it: a pose, a property or an input changes at a progress event, or at the very end.
TEST(Pipeline, WhatChangesWhileItRunsIsSeenNext)
{
  for (const auto event : { vtkCommand::ProgressEvent, vtkCommand::EndEvent })
  {
    SCOPED_TRACE(vtkCommand::GetStringFromEventId(event));
    const Scene scene = MakeSmallScene();
    const auto filter = MakeFilter(scene, NumberOfWalks);
    const auto meddler = EventObserver::Watch(filter, event);
    const std::vector<std::function<void()>> changes{ [&] {
                                                       scene.Moving[0].Pose->Translate(0.3, 0, 0);
                                                     },
      [&] { filter->SetNumberOfWalks(2 * NumberOfWalks); },
      [&] { filter->SetDynamicTransform(0, nullptr); },
      [&] { SetCellValues(scene.Fixed[1], "RadiantExitance", { 50 }); } };
    for (const auto& change : changes)
    {
      meddler->Change = change;
      filter->Modified();
      filter->Update();
      ASSERT_FALSE(meddler->Change);
      const auto fresh = MakeFilter(scene, filter->GetNumberOfWalks());
      fresh->SetDynamicTransform(0, filter->GetDynamicTransform(0));
      EXPECT_TRUE(UpdatesLike(filter, fresh));
      const auto counter = EventObserver::Watch(filter, vtkCommand::StartEvent);
      filter->Update();
      EXPECT_EQ(counter->Count, 0);
    }
  }
}

TEST(Pipeline, ATransformIsARepair)
{
  const Scene scene = MakeSmallScene();
  const auto filter = MakeFilter(scene, NumberOfWalks);
  filter->Update();
  EXPECT_TRUE(HasShot(filter));
  EXPECT_EQ(Field(filter, "VerifySeconds"), 0);
  scene.Moving[0].Pose->Translate(0.3, 0.2, 0.1);
  EXPECT_TRUE(UpdatesLikeANewOne(filter, scene));
  EXPECT_FALSE(HasShot(filter));
  EXPECT_GT(Field(filter, "VerifySeconds"), 0);
  EXPECT_GT(Field(filter, "NumberOfInvalidWalks"), 0);
  EXPECT_GE(Field(filter, "NumberOfRepairedSegments"), Field(filter, "NumberOfInvalidWalks"));
  EXPECT_LT(Field(filter, "NumberOfRepairedSegments"), Field(filter, "NumberOfSegments"));
}

TEST(Pipeline, EqualValuesKeepTheHistory)
{
  const Scene scene = MakeSmallScene();
  const auto filter = MakeFilter(scene, NumberOfWalks);
  filter->Update();
  for (const Mesh& mesh : { scene.Fixed[0], scene.Fixed[1], scene.Moving[0].Model })
  {
    const Mesh copy = Copy(mesh);
    mesh->DeepCopy(copy);
    mesh->Modified();
  }
  EXPECT_TRUE(UpdatesLikeANewOne(filter, scene));
  EXPECT_FALSE(HasShot(filter));
  EXPECT_EQ(Field(filter, "NumberOfInvalidWalks"), 0);
}

TEST(Pipeline, ADeformingObjectIsARepair)
{
  const Scene scene = MakeSmallScene();
  const auto filter = MakeFilter(scene, NumberOfWalks);
  filter->Update();
  vtkPoints* points = scene.Moving[0].Model->GetPoints();
  points->SetPoint(0, 0.1, 0.2, 0.9);
  points->Modified();
  EXPECT_TRUE(UpdatesLikeANewOne(filter, scene));
  EXPECT_FALSE(HasShot(filter));
  EXPECT_GT(Field(filter, "NumberOfInvalidWalks"), 0);
}

// Walks that reach what was painted go on as they did, but for those whose survival it decides.
TEST(Pipeline, OtherReflectancesAreARepair)
{
  const Scene scene = MakeSmallScene();
  const Mesh painted[] = { scene.Fixed[0], scene.Moving[0].Model };
  const auto filter = MakeFilter(scene, NumberOfWalks);
  for (const double reflectance : { 0.5, 0.55, 0.5, 0.4 })
  {
    for (const Mesh& mesh : painted)
    {
      SetCellValues(mesh, "DiffuseReflectance", { reflectance });
    }
    const bool isFirst = reflectance == 0.5 && !filter->GetOutput()->GetNumberOfBlocks();
    EXPECT_TRUE(UpdatesLikeANewOne(filter, scene)) << reflectance;
    EXPECT_EQ(HasShot(filter), isFirst) << reflectance;
    EXPECT_EQ(Field(filter, "NumberOfInvalidWalks") > 0, !isFirst) << reflectance;
    EXPECT_LT(Field(filter, "NumberOfRepairedSegments"), 0.4 * Field(filter, "NumberOfSegments"));
    if (reflectance > 0.5) // while something moves
    {
      scene.Moving[0].Pose->Translate(0.3, 0.2, 0.1);
    }
  }
}

// Behind the lamp in the list of inputs.
TEST(Pipeline, InputsThatComeAndGoAreARepair)
{
  Scene scene = MakeSmallScene();
  const Mesh corner = MakeBox(0.8, 0.9, 1.1);
  const auto filter = MakeFilter(scene, NumberOfWalks);
  filter->Update();
  const auto expectRepair = [&](const char* what) {
    EXPECT_TRUE(UpdatesLikeANewOne(filter, scene)) << what;
    EXPECT_FALSE(HasShot(filter)) << what;
    EXPECT_GT(Field(filter, "NumberOfInvalidWalks"), 0) << what;
    EXPECT_LT(Field(filter, "NumberOfRepairedSegments"), 0.3 * Field(filter, "NumberOfSegments"));
  };
  scene.Fixed.push_back(corner);
  filter->AddInputDataObject(0, corner);
  expectRepair("it comes");
  filter->RemoveInputConnection(0, 2);
  scene.Fixed.pop_back();
  scene.Moving.push_back(MakeMoving(corner, { 0, 0, 0 }));
  filter->AddInputDataObject(1, corner);
  filter->SetDynamicTransform(2, scene.Moving[2].Pose);
  expectRepair("it may move");
  scene.Moving[2].Pose->Translate(0.3, 0, 0);
  expectRepair("it moves");
  filter->RemoveInputConnection(1, 2);
  filter->SetDynamicTransform(2, nullptr);
  scene.Moving.pop_back();
  expectRepair("it goes");
}

TEST(Pipeline, EveryOtherChangeIsANewFilter)
{
  Scene scene = MakeSmallScene();
  const auto filter = MakeFilter(scene, NumberOfWalks);
  filter->Update();

  scene.Moving.push_back(MakeMoving(MakeCone(0.6, 0.2, 8), { 2.2, 0.8, 1 }));
  filter->AddInputDataObject(1, scene.Moving[2].Model);
  filter->SetDynamicTransform(2, scene.Moving[2].Pose);
  EXPECT_TRUE(UpdatesLikeANewOne(filter, scene)) << "connection added";

  filter->RemoveInputConnection(1, 2);
  filter->SetDynamicTransform(2, nullptr);
  scene.Moving.pop_back();
  EXPECT_TRUE(UpdatesLikeANewOne(filter, scene)) << "connection removed";

  scene.Fixed.push_back(MakeBox(0.3, 0.4, 3.2));
  filter->AddInputDataObject(0, scene.Fixed[2]);
  EXPECT_TRUE(UpdatesLikeANewOne(filter, scene)) << "static connection added";

  SetCellValues(scene.Moving[0].Model, "DiffuseReflectance", { 0.9 });
  EXPECT_TRUE(UpdatesLikeANewOne(filter, scene)) << "reflectance set";

  scene.Moving[0].Model->GetCellData()->GetArray("DiffuseReflectance")->FillComponent(0, 0.2);
  scene.Moving[0].Model->GetCellData()->GetArray("DiffuseReflectance")->Modified();
  EXPECT_TRUE(UpdatesLikeANewOne(filter, scene)) << "reflectance changed";

  SetCellValues(scene.Moving[1].Model, "RadiantExitance", { 20 });
  EXPECT_TRUE(UpdatesLikeANewOne(filter, scene)) << "moving light added";

  scene.Moving[1].Pose->Translate(-0.5, -0.2, 0.3);
  EXPECT_TRUE(UpdatesLikeANewOne(filter, scene)) << "light moved";
  EXPECT_TRUE(HasShot(filter));

  SetCellValues(scene.Fixed[1], "RadiantExitance", { 10, 20, 30 });
  EXPECT_TRUE(UpdatesLikeANewOne(filter, scene)) << "three bands";

  filter->SetNumberOfWalks(NumberOfWalks + 1);
  EXPECT_TRUE(UpdatesLikeANewOne(filter, scene)) << "number of walks changed";

  filter->SetDefaultDiffuseReflectance(0.25);
  EXPECT_TRUE(UpdatesLikeANewOne(filter, scene)) << "default reflectance changed";
}

// The input itself does not change; what the filter reads of it does.
TEST(Pipeline, AnotherArrayIsChosen)
{
  const Scene scene = MakeSmallScene();
  SetCellValues(scene.Fixed[0], "Dark", { 0.1 });
  SetCellValues(scene.Fixed[1], "Evening", { 7 });
  const auto filter = MakeFilter(scene, NumberOfWalks);
  filter->Update();
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Dark");
  EXPECT_TRUE(UpdatesLikeANewOne(filter, scene)) << "reflectance";
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Evening");
  EXPECT_TRUE(UpdatesLikeANewOne(filter, scene)) << "exitance";
  EXPECT_NEAR(Field(filter, "EmittedPower"), 0.75 * 0.75 * 7, 1e-6);
}

TEST(Pipeline, ObjectToWorldServesWhereThereIsNoTransform)
{
  const Scene scene = MakeSmallScene();
  const auto expected = MakeFilter(scene, NumberOfWalks), filter = MakeFilter(scene, NumberOfWalks);
  filter->RemoveAllDynamicTransforms();
  for (const MovingObject& object : scene.Moving)
  {
    SetObjectToWorld(object.Model, object.Pose);
  }
  EXPECT_TRUE(UpdatesLike(filter, expected));

  scene.Moving[0].Pose->Translate(0.4, 0, 0.1);
  SetObjectToWorld(scene.Moving[0].Model, scene.Moving[0].Pose);
  EXPECT_TRUE(UpdatesLike(filter, expected));
  EXPECT_FALSE(HasShot(filter));

  // A transform wins over the array.
  const auto other = vtkSmartPointer<vtkTransform>::New();
  other->Translate(2, 1, 1);
  filter->SetDynamicTransform(0, other);
  expected->SetDynamicTransform(0, other);
  EXPECT_TRUE(UpdatesLike(filter, expected));
}

TEST(Pipeline, ArraysOfTheInputAreKept)
{
  const Scene scene = MakeSmallScene();
  SetCellValues(scene.Fixed[0], "Temperature", { 20, 21 });
  SetCellValues(scene.Moving[0].Model, "Paint", { 3 });
  SetField(scene.Moving[0].Model, "Note", { 4 });
  const auto filter = MakeFilter(scene, NumberOfWalks);
  filter->Update();
  vtkPolyData* room = OutputOf(filter->GetOutput(), 0, 0);
  vtkPolyData* ball = OutputOf(filter->GetOutput(), 1, 0);
  EXPECT_EQ(room->GetCellData()->GetArray("Temperature"),
    scene.Fixed[0]->GetCellData()->GetArray("Temperature"));
  EXPECT_EQ(ball->GetCellData()->GetArray("Paint"),
    scene.Moving[0].Model->GetCellData()->GetArray("Paint"));
  EXPECT_TRUE(ball->GetFieldData()->HasArray("Note"));
  EXPECT_FALSE(scene.Fixed[0]->GetCellData()->HasArray("Irradiance")); // the input is untouched
  EXPECT_EQ(scene.Moving[0].Model->GetPoint(0)[2], 0.4f);
  EXPECT_STREQ(room->GetCellData()->GetScalars()->GetName(), "Irradiance");
}

// A dynamic block has the points, normals and light of a static one that was moved beforehand. If
// the pose mirrors, cells of the static one show their backs where those of the block show the
// mirror images of their fronts.
TEST(Pipeline, DynamicIsStaticMovedBeforehand)
{
  for (const double mirror : { 1, -1 })
  {
    SCOPED_TRACE(mirror);
    Scene moving = MakeSmallScene();
    moving.Moving.pop_back();
    SetCellValues(moving.Moving[0].Model, "DiffuseReflectance", { 0.7 });
    vtkTransform* pose = moving.Moving[0].Pose;
    pose->RotateWXYZ(40, 1, 2, 3);
    pose->Scale(mirror, 1.25, 0.75);
    vtkNew<vtkTransformPolyDataFilter> move;
    move->SetInputData(moving.Moving[0].Model);
    move->SetTransform(pose);
    move->Update();
    const Scene still{ { moving.Fixed[0], moving.Fixed[1], Copy(move->GetOutput()) }, {} };

    const auto one = MakeFilter(moving, 50000), other = MakeFilter(still, 50000);
    for (const auto& filter : { one, other })
    {
      filter->SeparateSidesOn();
      filter->Update();
    }
    vtkPolyData* found = OutputOf(one->GetOutput(), 1, 0);
    vtkPolyData* expected = OutputOf(other->GetOutput(), 0, 2);
    ASSERT_NE(found->GetPointData()->GetNormals(), nullptr);
    EXPECT_EQ(ValuesOf(found->GetPoints()->GetData()), ValuesOf(expected->GetPoints()->GetData()));
    EXPECT_EQ(ValuesOf(found->GetPointData()->GetNormals()),
      ValuesOf(expected->GetPointData()->GetNormals()));
    // The points of the static one were rounded to float: some walks end elsewhere.
    const char* const names[] = { "IrradianceFront", "IrradianceBack" };
    for (const int side : { 0, 1 })
    {
      const auto a = ValuesOf(found->GetCellData()->GetArray(names[side])),
                 b =
                   ValuesOf(expected->GetCellData()->GetArray(names[mirror > 0 ? side : 1 - side]));
      for (std::size_t i = 0; i < b.size(); ++i)
      {
        EXPECT_NEAR(a.at(i), b[i], 0.5 + 0.1 * b[i]) << names[side] << ", cell " << i;
      }
    }
    EXPECT_GT(found->GetCellData()->GetArray("IrradianceFront")->GetRange()[1], 5);
    EXPECT_EQ(found->GetCellData()->GetArray("IrradianceBack")->GetRange()[1], 0);
  }
}
