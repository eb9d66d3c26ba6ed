// SPDX-License-Identifier: BSD-3-Clause
// Composite data on the ports: all polydata leaves belong to one scene, and the output has the
// structure of the input.

#include "ErrorObserver.h"
#include "OutputBits.h"
#include "TestScenes.h"

#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

using namespace TestScenes;

namespace
{

constexpr vtkIdType NumberOfWalks = 2000;

/// Blocks: a plate 1 m below the lamp, nothing, and in a nested block a larger plate half-way up.
vtkSmartPointer<vtkMultiBlockDataSet> MakePlates()
{
  vtkNew<vtkMultiBlockDataSet> inner;
  inner->SetBlock(0, MakeRectangle({ -1, -1, 0.5 }, { 2, 0, 0 }, { 0, 2, 0 }, 2));
  auto plates = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  plates->SetBlock(0, MakeRectangle({ -0.5, -0.5, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 3));
  plates->SetBlock(1, nullptr);
  plates->SetBlock(2, inner);
  plates->GetMetaData(2u)->Set(vtkCompositeDataSet::NAME(), "Shade");
  return plates;
}

/// A lamp 1 m above the origin, and dynamic data.
vtkSmartPointer<vtkIrradianceFilter> MakeLampOver(vtkDataObject* data)
{
  auto filter = MakeDefaultFilter({ { MakeLamp({ 0, 0, 1 }, 1, { 100 }) }, {} }, NumberOfWalks);
  filter->AddInputDataObject(1, data);
  return filter;
}

vtkPolyData* FirstLeaf(vtkDataObject* block)
{
  return vtkPolyData::SafeDownCast(vtkMultiBlockDataSet::SafeDownCast(block)->GetBlock(0));
}

vtkDataObject* BlockOf(vtkIrradianceFilter* filter, unsigned int port, unsigned int i)
{
  return vtkMultiBlockDataSet::SafeDownCast(filter->GetOutput()->GetBlock(port))->GetBlock(i);
}

}

// VTK's executive, left to itself, would make one scene of each block.
TEST(CompositeInputs, BlocksShadeEachOther)
{
  const auto filter = MakeLampOver(MakePlates());
  filter->SetDefaultDiffuseReflectance(0);
  filter->Update();
  ASSERT_EQ(filter->GetOutput()->GetNumberOfBlocks(), 2u);
  auto* plates = vtkMultiBlockDataSet::SafeDownCast(BlockOf(filter, 1, 0));
  ASSERT_NE(plates, nullptr);
  ASSERT_EQ(plates->GetNumberOfBlocks(), 3u);
  EXPECT_EQ(plates->GetBlock(1), nullptr);
  EXPECT_STREQ(plates->GetMetaData(2u)->Get(vtkCompositeDataSet::NAME()), "Shade");
  vtkDataArray* shaded = FirstLeaf(plates)->GetCellData()->GetArray("Irradiance");
  EXPECT_EQ(shaded->GetRange()[1], 0);
  vtkDataArray* lit = FirstLeaf(plates->GetBlock(2))->GetCellData()->GetArray("Irradiance");
  EXPECT_GT(lit->GetRange()[0], 0);
}

// Leaves give the same numbers as connections of their own, in every composite type of VTK.
TEST(CompositeInputs, LeavesAreAsConnections)
{
  const Scene scene = MakeSmallScene();
  const auto expected = MakeDefaultFilter(scene, NumberOfWalks);
  expected->RemoveAllDynamicTransforms();
  expected->Update();

  vtkNew<vtkMultiBlockDataSet> room;
  room->SetBlock(0, scene.Fixed[0]);
  room->SetBlock(1, scene.Fixed[1]);
  vtkNew<vtkPartitionedDataSet> pieces;
  pieces->SetPartition(0, scene.Moving[0].Model);
  pieces->SetPartition(1, scene.Moving[1].Model);
  vtkNew<vtkPartitionedDataSetCollection> collection;
  collection->SetPartition(0, 0, scene.Moving[0].Model);
  collection->SetPartition(1, 0, scene.Moving[1].Model);
  for (vtkDataObject* moving :
    { static_cast<vtkDataObject*>(pieces.Get()), static_cast<vtkDataObject*>(collection.Get()) })
  {
    vtkNew<vtkIrradianceFilter> filter;
    filter->SetNumberOfWalks(NumberOfWalks);
    filter->AddInputDataObject(0, room);
    filter->AddInputDataObject(1, moving);
    filter->Update();
    for (unsigned int port = 0; port < 2; ++port)
    {
      auto* tree = vtkDataObjectTree::SafeDownCast(BlockOf(filter, port, 0));
      ASSERT_NE(tree, nullptr) << moving->GetClassName();
      const bool isPieces = port == 1 && moving == pieces;
      EXPECT_STREQ(
        tree->GetClassName(), isPieces ? "vtkMultiPieceDataSet" : "vtkMultiBlockDataSet");
      const auto leaves = vtk::TakeSmartPointer(tree->NewTreeIterator());
      unsigned int leaf = 0;
      for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem(), ++leaf)
      {
        vtkCellData* cells =
          vtkPolyData::SafeDownCast(leaves->GetCurrentDataObject())->GetCellData();
        EXPECT_EQ(
          ValuesOf(cells->GetArray("Irradiance")), ValuesOf(IrradianceOf(expected, port, leaf)));
      }
      EXPECT_EQ(leaf, 2u);
    }
  }
}

// World = pose of the connection * ObjectToWorld of the leaf.
TEST(CompositeInputs, PosesCompose)
{
  const auto turn = vtkSmartPointer<vtkTransform>::New();
  turn->RotateZ(90);
  const Mesh box = MakeBox(0.2, 0.3, 0.4);
  const Mesh posed = Copy(box);
  SetObjectToWorld(posed, MakeMoving(nullptr, { 1, 0, 0 }).Pose);
  vtkNew<vtkMultiBlockDataSet> boxes;
  boxes->SetBlock(0, posed);
  boxes->SetBlock(1, box);
  for (const bool isByField : { false, true })
  {
    const auto filter = MakeLampOver(boxes);
    isByField ? SetObjectToWorld(boxes, turn) : filter->SetDynamicTransform(0, turn);
    filter->Update();
    auto* output = vtkMultiBlockDataSet::SafeDownCast(BlockOf(filter, 1, 0));
    double center[3];
    vtkPolyData::SafeDownCast(output->GetBlock(0))->GetCenter(center);
    EXPECT_NEAR(center[0], 0, 1e-6);
    EXPECT_NEAR(center[1], 1, 1e-6);
    vtkPolyData::SafeDownCast(output->GetBlock(1))->GetCenter(center);
    EXPECT_NEAR(center[1], 0, 1e-6);
    // Both poses are applied: the output, fed back, must not move again.
    EXPECT_EQ(output->GetFieldData()->GetAbstractArray("ObjectToWorld"), nullptr);
    EXPECT_EQ(output->GetBlock(0)->GetFieldData()->GetAbstractArray("ObjectToWorld"), nullptr);
  }
  EXPECT_NE(posed->GetFieldData()->GetAbstractArray("ObjectToWorld"), nullptr); // the input has it
}

TEST(CompositeInputs, MotionIsARepair)
{
  const auto plates = MakePlates();
  const auto pose = vtkSmartPointer<vtkTransform>::New();
  const auto makeFilter = [&] {
    auto filter = MakeDefaultFilter(
      { { MakeRoom(3, 3), MakeLamp({ 0.5, 0.5, 1 }, 1, { 100 }) }, {} }, NumberOfWalks);
    filter->AddInputDataObject(1, plates);
    filter->SetDynamicTransform(0, pose);
    return filter;
  };
  const auto filter = makeFilter();
  filter->Update();
  pose->Translate(0.1, 0.05, 0.02);
  filter->Update();
  EXPECT_EQ(Field(filter, "ShootSeconds"), 0);
  EXPECT_GT(Field(filter, "NumberOfInvalidWalks"), 0);
  EXPECT_TRUE(UpdatesLike(filter, makeFilter()));
}

TEST(CompositeInputs, ALeafThatIsNoPolyDataIsAnError)
{
  const auto plates = MakePlates();
  plates->SetBlock(1, vtkNew<vtkUnstructuredGrid>());
  plates->GetMetaData(1u)->Set(vtkCompositeDataSet::NAME(), "Grid");
  const auto filter = MakeLampOver(plates);
  ExpectWords(
    OnlyErrorOf(filter), { "input port 1, connection 0, block 2 (Grid)", "vtkUnstructuredGrid" });
}

TEST(CompositeInputs, ErrorsNameTheBlock)
{
  const auto plates = MakePlates();
  SetCellValues(FirstLeaf(plates->GetBlock(2)), "DiffuseReflectance", { 1.5 });
  vtkNew<vtkIrradianceFilter> filter;
  filter->AddInputDataObject(0, plates);
  ExpectWords(OnlyErrorOf(filter), { "input port 0, connection 0, block 4, cell 0" });
}

TEST(CompositeInputs, AnEmptyOneIsNothing)
{
  const auto filter = MakeLampOver(vtkNew<vtkMultiBlockDataSet>());
  filter->Update();
  ASSERT_EQ(filter->GetOutput()->GetNumberOfBlocks(), 2u);
  EXPECT_NE(vtkMultiBlockDataSet::SafeDownCast(BlockOf(filter, 1, 0)), nullptr);
  EXPECT_EQ(Field(filter, "EscapedPower"), Field(filter, "EmittedPower"));
}

// A leaf's own pose acts as the transform of a plain connection does.
TEST(CompositeInputs, ALeafMovesAsAPlainInput)
{
  const Scene scene = MakeSmallScene();
  const auto plain = MakeDefaultFilter(scene, NumberOfWalks);
  plain->Update();
  vtkNew<vtkMultiBlockDataSet> moving;
  for (unsigned int i = 0; i < 2; ++i)
  {
    const Mesh leaf = Copy(scene.Moving[i].Model);
    SetObjectToWorld(leaf, scene.Moving[i].Pose);
    moving->SetBlock(i, leaf);
  }
  const auto filter = MakeDefaultFilter({ scene.Fixed, {} }, NumberOfWalks);
  filter->AddInputDataObject(1, moving);
  filter->Update();
  auto* blocks = vtkMultiBlockDataSet::SafeDownCast(BlockOf(filter, 1, 0));
  for (unsigned int i = 0; i < 2; ++i)
  {
    vtkCellData* cells = vtkPolyData::SafeDownCast(blocks->GetBlock(i))->GetCellData();
    EXPECT_EQ(ValuesOf(cells->GetArray("Irradiance")), ValuesOf(IrradianceOf(plain, 1, i)));
  }
}
