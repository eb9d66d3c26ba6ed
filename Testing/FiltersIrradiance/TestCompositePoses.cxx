// SPDX-License-Identifier: BSD-3-Clause
// vtkKeyFramedPose on a tree of polydata: what holds for plain polydata holds for every leaf.

#include "ErrorObserver.h"
#include "OutputBits.h"
#include "PartOverTime.h"
#include "TestScenes.h"

#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"
#include "vtkKeyFramedPose.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkRadiantExposureFilter.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <functional>

using namespace TestScenes;

namespace
{

using Tree = vtkSmartPointer<vtkDataObjectTree>;

constexpr vtkIdType Walks = 2000;

/// A ball and, beside it, a box, with an empty leaf between them.
vtkSmartPointer<vtkMultiBlockDataSet> MakeBlocks()
{
  const Mesh box = MakeBox(0.3, 0.3, 0.3);
  MoveTo(box, { 0, 0.6, 0 });
  vtkNew<vtkMultiBlockDataSet> inner;
  inner->SetBlock(0, box);
  inner->GetMetaData(0u)->Set(vtkCompositeDataSet::NAME(), "Box");
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  blocks->SetBlock(0, MakeBall(0.3, 6));
  blocks->SetBlock(1, nullptr);
  blocks->SetBlock(2, inner);
  blocks->GetMetaData(0u)->Set(vtkCompositeDataSet::NAME(), "Ball");
  blocks->GetMetaData(1u)->Set(vtkCompositeDataSet::NAME(), "Nothing");
  return blocks;
}

vtkPolyData* BallOf(vtkDataObject* blocks)
{
  return vtkPolyData::SafeDownCast(vtkMultiBlockDataSet::SafeDownCast(blocks)->GetBlock(0));
}

vtkPolyData* BoxOf(vtkDataObject* blocks)
{
  auto* inner =
    vtkMultiBlockDataSet::SafeDownCast(vtkMultiBlockDataSet::SafeDownCast(blocks)->GetBlock(2));
  return inner ? vtkPolyData::SafeDownCast(inner->GetBlock(0)) : nullptr;
}

/// The same in each composite type.
std::vector<Tree> MakeTrees()
{
  const auto blocks = MakeBlocks();
  vtkNew<vtkPartitionedDataSet> pieces;
  vtkNew<vtkPartitionedDataSetCollection> collection;
  pieces->SetPartition(0, BallOf(blocks));
  pieces->SetPartition(2, BoxOf(blocks));
  collection->SetPartition(0, 0, BallOf(blocks));
  collection->SetPartition(1, 1, BoxOf(blocks));
  return { blocks.Get(), pieces.Get(), collection.Get() };
}

vtkSmartPointer<vtkKeyFramedPose> MakeRide(vtkDataObject* input)
{
  auto ride = vtkSmartPointer<vtkKeyFramedPose>::New();
  ride->SetInputDataObject(input);
  ride->AddPose(0, 0.5, 1.2, 1, 0, 0, 0);
  ride->AddPose(4, 2.5, 1.2, 1, 0, 0, 0);
  return ride;
}

Vector PlaceAt(double time)
{
  return { 0.5 + 0.5 * time, 1.2, 1 };
}

vtkSmartPointer<vtkIrradianceFilter> MakeRidingScene(vtkAlgorithm* ride)
{
  auto filter = MakeFilter(MakeEmptyRoom(), Walks);
  filter->AddInputConnection(1, ride->GetOutputPort());
  return filter;
}

/// The tree as the dynamic input of a new filter, with a transform.
OutputBits FreshAt(double time, vtkDataObject* tree)
{
  auto fresh = MakeFilter(MakeEmptyRoom(), Walks);
  fresh->AddInputDataObject(1, tree);
  fresh->SetDynamicTransform(0, MakeMoving(nullptr, PlaceAt(time)).Pose);
  fresh->Update();
  return OutputBits(fresh);
}

double PlaceOf(vtkPolyData* leaf, int axis)
{
  vtkDataArray* array = leaf->GetFieldData()->GetArray("ObjectToWorld");
  return array ? array->GetComponent(0, 4 * axis + 3) : std::nan("");
}

}

// Also that nothing is read or shot again.
TEST(CompositePoses, MovePartsOfTheIrradianceFilter)
{
  for (const Tree& tree : MakeTrees())
  {
    const auto ride = MakeRide(tree);
    const auto filter = MakeRidingScene(ride);
    bool isFirst = true;
    for (const double time : { 0., 1., 4., 2.5, 1., 0. })
    {
      filter->UpdateTimeStep(time);
      EXPECT_TRUE(IsSame(OutputBits(filter), FreshAt(time, tree)))
        << tree->GetClassName() << ", time " << time;
      EXPECT_EQ(Field(filter, "ShootSeconds") > 0, isFirst);
      isFirst = false;
    }
  }
}

// After an execution, too, and after a change of a property.
TEST(CompositePoses, KeepTheirTimes)
{
  const auto ride = MakeRide(MakeBlocks());
  ride->SetNumberOfTimeSteps(4);
  for (const int type : { vtkKeyFramedPose::Linear, vtkKeyFramedPose::Step })
  {
    ride->SetInterpolationType(type);
    ride->UpdateTimeStep(1);
    EXPECT_EQ(RangeOf(ride), (std::vector<double>{ 0, 4 }));
    EXPECT_EQ(StepsOf(ride).size(), 5u);
    vtkDataObject* output = ride->GetOutputDataObject(0);
    EXPECT_EQ(output->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), 1);
    EXPECT_EQ(PlaceOf(BallOf(output), 0), type == vtkKeyFramedPose::Step ? 0.5 : 1);
  }
}

// The sum over all poses is the same as of plain polydata, bit for bit.
TEST(CompositePoses, AreExposedAsPlainPolyData)
{
  const Mesh ball = MakeBall(0.3, 6);
  vtkNew<vtkPartitionedDataSet> pieces;
  pieces->SetPartition(0, ball);
  std::vector<std::vector<double>> exposures;
  for (vtkDataObject* input :
    { static_cast<vtkDataObject*>(ball), static_cast<vtkDataObject*>(pieces) })
  {
    const auto ride = MakeRide(input);
    ride->SetNumberOfTimeSteps(5);
    const auto filter = MakeRidingScene(ride);
    vtkNew<vtkRadiantExposureFilter> exposure;
    exposure->SetInputConnection(filter->GetOutputPort());
    exposure->SetIntegrationModeToTimeSteps();
    exposure->Update();
    auto* output = vtkMultiBlockDataSet::SafeDownCast(exposure->GetOutputDataObject(0));
    EXPECT_EQ(output->GetFieldData()->GetArray("NumberOfTimeSteps")->GetComponent(0, 0), 5);
    exposures.push_back(
      ValuesOf(OutputOf(output, 0, 0)->GetCellData()->GetArray("RadiantExposure")));
  }
  EXPECT_GT(exposures[0][0], 0);
  EXPECT_EQ(exposures[0], exposures[1]);
}

TEST(CompositePoses, KeepTheStructure)
{
  const auto blocks = MakeBlocks();
  SetCellValues(BoxOf(blocks), "DiffuseReflectance", { 0.25 });
  const auto ride = MakeRide(blocks);
  ride->SetOutsideOfKeysToLeave();
  for (const double time : { 2., 9., 3. }) // at 9 s it is not there
  {
    ride->UpdateTimeStep(time);
    EXPECT_EQ(ride->GetOutput(), nullptr) << "it is no polydata";
    auto* output = vtkMultiBlockDataSet::SafeDownCast(ride->GetOutputDataObject(0));
    ASSERT_NE(output, nullptr);
    ASSERT_EQ(output->GetNumberOfBlocks(), 3u);
    EXPECT_STREQ(output->GetMetaData(0u)->Get(vtkCompositeDataSet::NAME()), "Ball");
    EXPECT_STREQ(output->GetMetaData(1u)->Get(vtkCompositeDataSet::NAME()), "Nothing");
    EXPECT_EQ(output->GetBlock(1), nullptr);
    auto* inner = vtkMultiBlockDataSet::SafeDownCast(output->GetBlock(2));
    EXPECT_STREQ(inner->GetMetaData(0u)->Get(vtkCompositeDataSet::NAME()), "Box");
    ASSERT_NE(BoxOf(output), nullptr);
    EXPECT_TRUE(BoxOf(output)->GetCellData()->HasArray("DiffuseReflectance"));
    if (time == 9)
    {
      EXPECT_EQ(BoxOf(output)->GetNumberOfCells() + BallOf(output)->GetNumberOfPoints(), 0);
      EXPECT_FALSE(BoxOf(output)->GetFieldData()->HasArray("ObjectToWorld"));
      continue;
    }
    EXPECT_EQ(BoxOf(output)->GetPolys(), BoxOf(blocks)->GetPolys());
    EXPECT_EQ(PlaceOf(BallOf(output), 1), 1.2);
    EXPECT_EQ(PlaceOf(BoxOf(output), 1), 1.2 + 0.6);
  }
  EXPECT_EQ(PlaceOf(BoxOf(blocks), 1), 0.6) << "the input is as it was";
}

// world = pose * the tree's own * the leaf's own.
TEST(CompositePoses, ApplyThoseOfTheTreeFirst)
{
  const auto blocks = MakeBlocks();
  vtkNew<vtkTransform> turn;
  turn->RotateZ(90);
  SetObjectToWorld(blocks, turn);
  const auto ride = MakeRide(blocks);
  ride->UpdateTimeStep(4);
  vtkDataObject* output = ride->GetOutputDataObject(0);
  EXPECT_FALSE(output->GetFieldData()->HasArray("ObjectToWorld"));
  EXPECT_NEAR(PlaceOf(BoxOf(output), 0), 2.5 - 0.6, 1e-15); // y turned to -x, then moved
  EXPECT_NEAR(PlaceOf(BoxOf(output), 1), 1.2, 1e-15);
}

TEST(CompositePoses, RefuseOtherDataByName)
{
  vtkNew<vtkUnstructuredGrid> grid;
  const auto blocks = MakeBlocks();
  vtkMultiBlockDataSet::SafeDownCast(blocks->GetBlock(2))->SetBlock(0, grid);
  const struct
  {
    vtkDataObject* Input;
    const char* Words;
  } cases[] = { { blocks, "the input, block 4 (Box) is a vtkUnstructuredGrid; only vtkPolyData" },
    { grid, "the input is a vtkUnstructuredGrid; only vtkPolyData" } };
  for (const auto& each : cases)
  {
    const auto ride = MakeRide(each.Input);
    const auto observer = ErrorObserver::Watch(ride);
    ride->UpdateTimeStep(1);
    ExpectOne(observer->Errors, { each.Words });
    EXPECT_EQ(ride->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::CELL), 0);
  }
  const auto ride = MakeRide(grid);
  const auto errors = ErrorObserver::Watch(ride);
  ride->Update();
  ride->SetInputDataObject(MakeBox(1, 1, 1)); // it stayed usable, and can change its kind
  ride->UpdateTimeStep(4);
  ASSERT_NE(ride->GetOutput(), nullptr);
  EXPECT_EQ(PlaceOf(ride->GetOutput(), 0), 2.5);
}
