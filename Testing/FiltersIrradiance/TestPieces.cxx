// SPDX-License-Identifier: BSD-3-Clause
// Several processes share a pipeline, and each asks for its piece: together they have each cell
// once.

#include "OutputBits.h"
#include "OutputChecks.h"
#include "TestScenes.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIrradianceProbeFilter.h"
#include "vtkKeyFramedPose.h"
#include "vtkOutgoingRadianceFilter.h"
#include "vtkPassThrough.h"
#include "vtkPointIrradianceFilter.h"
#include "vtkRadiantExposureFilter.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <gtest/gtest.h>

#include <set>

using namespace TestScenes;

namespace
{

constexpr int NumberOfPieces = 3;

std::set<std::string> NamesOf(vtkDataSetAttributes* attributes)
{
  std::set<std::string> names;
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = attributes->GetAbstractArray(i);
    names.insert(
      array->GetName() + std::string(" x ") + std::to_string(array->GetNumberOfComponents()));
  }
  return names;
}

std::vector<Mesh> CopiesOfLeaves(vtkDataObject* data)
{
  std::vector<Mesh> copies;
  for (vtkPolyData* leaf : OutputChecks::LeavesOf(data))
  {
    copies.push_back(Copy(leaf));
  }
  return copies;
}

/// Piece 0 is the whole, the others have its leaves and arrays without cells and points.
void ExpectEachCellOnce(vtkAlgorithm* filter)
{
  filter->Update();
  const std::vector<Mesh> whole = CopiesOfLeaves(filter->GetOutputDataObject(0));
  for (const int piece : { 1, 0, 2 })
  {
    filter->UpdatePiece(piece, NumberOfPieces, 0);
    const auto leaves = OutputChecks::LeavesOf(filter->GetOutputDataObject(0));
    ASSERT_EQ(leaves.size(), whole.size());
    for (std::size_t i = 0; i < leaves.size(); ++i)
    {
      if (piece == 0)
      {
        EXPECT_TRUE(IsSame(OutputBits(leaves[i]), OutputBits(whole[i])));
        continue;
      }
      EXPECT_EQ(leaves[i]->GetNumberOfCells(), 0);
      EXPECT_EQ(leaves[i]->GetNumberOfPoints(), 0);
      EXPECT_EQ(NamesOf(leaves[i]->GetCellData()), NamesOf(whole[i]->GetCellData()));
      EXPECT_EQ(NamesOf(leaves[i]->GetPointData()), NamesOf(whole[i]->GetPointData()));
    }
  }
}

/// With a lamp in three bands.
vtkSmartPointer<vtkIrradianceFilter> MakeColouredFilter()
{
  Scene scene = MakeSmallScene();
  scene.Fixed.push_back(MakeLamp({ 1, 1, 2 }, 0.2, { 1, 2, 3 }));
  return MakeFilter(scene, 2000);
}

}

TEST(Pieces, TheWholeIsPieceZero)
{
  const auto filter = MakeColouredFilter();
  ExpectEachCellOnce(filter);
  filter->SeparateSidesOn();
  filter->ComputeStandardErrorOn();
  filter->SetRepairTimeBudget(1);
  ExpectEachCellOnce(filter);
  filter->SetRepairTimeBudget(0);
  filter->SetMethodToGathered();
  ExpectEachCellOnce(filter);
}

TEST(Pieces, OthersShootNothingAndHaveNoFigures)
{
  const auto filter = MakeColouredFilter();
  filter->SetNumberOfWalks(4000000000); // would take an hour
  filter->UpdatePiece(1, 2, 0);
  EXPECT_EQ(filter->GetOutput()->GetFieldData()->GetNumberOfArrays(), 0);
  EXPECT_TRUE(std::isnan(filter->GetFigure("NumberOfSegments")));
  EXPECT_TRUE(std::isnan(filter->GetFigure("EmittedPower")));
}

TEST(Pieces, UpdatesBetweenThemAreNoticed)
{
  const auto filter = MakeColouredFilter();
  vtkNew<vtkTransform> pose;
  filter->SetDynamicTransform(0, pose);
  filter->Update();
  filter->UpdatePiece(1, 2, 0);
  pose->Translate(0.1, 0, 0);
  filter->UpdatePiece(1, 2, 0);
  EXPECT_EQ(OutputChecks::LeavesOf(filter->GetOutput()).front()->GetNumberOfCells(), 0);
  filter->UpdatePiece(0, 2, 0);
  const auto fresh = MakeColouredFilter();
  fresh->SetDynamicTransform(0, pose);
  fresh->Update();
  EXPECT_TRUE(IsSame(OutputBits(filter), OutputBits(fresh)));
}

// One execution fills both outputs, for the piece that either is asked for.
TEST(Pieces, OfOnePortAreNotTakenForThoseOfTheOther)
{
  const auto filter = MakeColouredFilter();
  vtkNew<vtkPassThrough> walks;
  walks->SetInputConnection(filter->GetWalksOutputPort());
  filter->Update();
  const OutputBits whole(filter);
  walks->UpdatePiece(1, 2, 0);
  filter->Update();
  EXPECT_TRUE(IsSame(OutputBits(filter), whole));
}

TEST(Pieces, RadianceAndPointIrradianceAreOfPieceZero)
{
  const auto filter = MakeColouredFilter();
  vtkNew<vtkOutgoingRadianceFilter> radiance;
  radiance->SetInputConnection(filter->GetOutputPort());
  radiance->SetEyePosition(0.5, 0.5, 0.5);
  ExpectEachCellOnce(radiance);
  vtkNew<vtkPointIrradianceFilter> points;
  points->SetInputConnection(filter->GetOutputPort());
  points->SetNumberOfRays(2);
  ExpectEachCellOnce(points);
}

TEST(Pieces, SensorsAreOfPieceZero)
{
  const auto filter = MakeColouredFilter();
  vtkNew<vtkSphereSource> sensors; // splits itself into pieces
  sensors->SetThetaResolution(16);
  vtkNew<vtkIrradianceProbeFilter> probe;
  probe->SetInputConnection(sensors->GetOutputPort());
  probe->SetSourceConnection(filter->GetOutputPort());
  probe->Update();
  const Mesh whole = Copy(vtkPolyData::SafeDownCast(probe->GetOutput()));
  ASSERT_GT(whole->GetNumberOfPoints(), 16);
  probe->UpdatePiece(1, 2, 0);
  EXPECT_EQ(probe->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(NamesOf(probe->GetOutput()->GetPointData()), NamesOf(whole->GetPointData()));
  probe->UpdatePiece(0, 2, 0);
  EXPECT_TRUE(IsSame(OutputBits(probe->GetOutput()), OutputBits(whole)));
}

TEST(Pieces, WalksAreOfPieceZero)
{
  const auto filter = MakeColouredFilter();
  filter->SetNumberOfOutputWalks(10);
  const auto walksOf = [&](int piece) {
    vtkNew<vtkInformation> request;
    request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), piece);
    request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), 2);
    vtkNew<vtkInformationVector> requests;
    requests->Append(vtkSmartPointer<vtkInformation>::New());
    requests->Append(request);
    filter->Update(1, requests);
    return filter->GetWalksOutput()->GetNumberOfLines();
  };
  EXPECT_EQ(walksOf(0), 10);
  filter->UpdatePiece(1, 2, 0); // of port 0: both are made together
  EXPECT_EQ(filter->GetWalksOutput()->GetNumberOfLines(), 0);
  EXPECT_EQ(walksOf(0), 10);
  filter->UpdatePiece(1, 2, 0);
  EXPECT_EQ(OutputChecks::LeavesOf(filter->GetOutput()).front()->GetNumberOfCells(), 0);
  EXPECT_EQ(walksOf(1), 0);
}

TEST(Pieces, ExposureIsOfPieceZero)
{
  const Scene scene = MakeSmallScene();
  const auto filter = MakeFilter(scene, 2000);
  filter->RemoveAllInputConnections(1);
  filter->RemoveAllDynamicTransforms();
  vtkNew<vtkKeyFramedPose> pose;
  pose->SetInputData(scene.Moving[0].Model);
  pose->AddPose(0, 1, 1, 1, 0, 0, 0);
  pose->AddPose(2, 1.5, 1, 1, 0, 0, 0);
  filter->AddInputConnection(1, pose->GetOutputPort());
  vtkNew<vtkRadiantExposureFilter> exposure;
  exposure->SetInputConnection(filter->GetOutputPort());
  ExpectEachCellOnce(exposure);
}
