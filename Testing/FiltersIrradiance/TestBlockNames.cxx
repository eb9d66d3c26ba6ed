// SPDX-License-Identifier: BSD-3-Clause
// Blocks of the output are named as their inputs are.

#include "TestScenes.h"

#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"
#include "vtkKeyFramedPose.h"
#include "vtkOutgoingRadianceFilter.h"
#include "vtkRadiantExposureFilter.h"
#include "vtkStringArray.h"

#include <gtest/gtest.h>

using namespace TestScenes;

namespace
{

void SetName(vtkDataObject* data, const char* name)
{
  vtkNew<vtkStringArray> array;
  array->SetName("Name");
  array->InsertNextValue(name);
  data->GetFieldData()->AddArray(array);
}

std::string NameOf(vtkDataObject* output, unsigned int port, unsigned int connection)
{
  auto* root = vtkMultiBlockDataSet::SafeDownCast(output);
  auto* blocks = vtkMultiBlockDataSet::SafeDownCast(root->GetBlock(port));
  return blocks->GetMetaData(connection)->Get(vtkCompositeDataSet::NAME());
}

}

TEST(BlockNames, AreThoseOfTheInputs)
{
  const Mesh lamp = MakeLamp({ 0, 0, 2 }, 1, { 100 });
  SetName(lamp, "lamp");
  vtkNew<vtkMultiBlockDataSet> boxes;
  boxes->SetBlock(0, MakeBox(0.2, 0.3, 0.4));
  boxes->GetMetaData(0u)->Set(vtkCompositeDataSet::NAME(), "left");
  SetName(boxes, "boxes");
  const Mesh ball = MakeBox(0.1, 0.1, 0.1);
  SetName(ball, "rotor");
  vtkNew<vtkKeyFramedPose> ride;
  ride->SetInputData(ball);
  ride->AddPose(0, 0, 0, 1, 0, 0, 0);
  ride->AddPose(1, 1, 0, 1, 0, 0, 0);

  const Mesh floor = MakeRectangle({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 2);
  const auto filter = MakeDefaultFilter({ { lamp, floor }, {} }, 1000);
  filter->AddInputDataObject(0, boxes);
  filter->AddInputConnection(1, ride->GetOutputPort());
  filter->AddInputDataObject(1, MakeBox(0.1, 0.2, 0.1));
  vtkNew<vtkRadiantExposureFilter> dose;
  dose->SetInputConnection(filter->GetOutputPort());
  dose->SetIntegrationModeToUniform();
  dose->SetNumberOfTimeSteps(1);
  vtkNew<vtkOutgoingRadianceFilter> radiance;
  radiance->SetInputConnection(filter->GetOutputPort());
  for (vtkAlgorithm* last : { static_cast<vtkAlgorithm*>(filter.Get()),
         static_cast<vtkAlgorithm*>(dose.Get()), static_cast<vtkAlgorithm*>(radiance.Get()) })
  {
    last->Update();
    vtkDataObject* output = last->GetOutputDataObject(0);
    EXPECT_EQ(NameOf(output, 0, 0), "lamp") << last->GetClassName();
    EXPECT_EQ(NameOf(output, 0, 1), "Static 1") << last->GetClassName();
    EXPECT_EQ(NameOf(output, 0, 2), "boxes") << last->GetClassName();
    EXPECT_EQ(NameOf(output, 1, 0), "rotor") << last->GetClassName();
    EXPECT_EQ(NameOf(output, 1, 1), "Dynamic 1") << last->GetClassName();
    auto* inner = vtkMultiBlockDataSet::SafeDownCast(
      vtkMultiBlockDataSet::SafeDownCast(vtkMultiBlockDataSet::SafeDownCast(output)->GetBlock(0))
        ->GetBlock(2));
    EXPECT_STREQ(inner->GetMetaData(0u)->Get(vtkCompositeDataSet::NAME()), "left");
  }
}

// A number, or nothing, is no name.
TEST(BlockNames, AreNumbersWhereTheArrayHoldsNoText)
{
  const Mesh lamp = MakeLamp({ 0, 0, 2 }, 1, { 100 });
  SetField(lamp, "Name", { 7 });
  const Mesh empty = MakeBox(0.1, 0.1, 0.1), none = MakeBox(0.1, 0.1, 0.2);
  SetName(empty, "");
  vtkNew<vtkStringArray> array;
  array->SetName("Name");
  none->GetFieldData()->AddArray(array);
  const auto filter = MakeDefaultFilter({ { lamp, empty, none }, {} }, 1000);
  filter->Update();
  for (unsigned int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(NameOf(filter->GetOutput(), 0, i), "Static " + std::to_string(i));
  }
}
