// SPDX-License-Identifier: BSD-3-Clause
// Under mpirun: each process has pieces of the inputs, and they bring what the whole brings.

#include "ErrorObserver.h"
#include "Processes.h"
#include "TestScenes.h"

#include "vtkIdTypeArray.h"
#include "vtkOutgoingRadianceFilter.h"
#include "vtkPointDataToCellData.h"
#include "vtkPointIrradianceFilter.h"

#include <gtest/gtest.h>

#include <functional>

using namespace TestScenes;

namespace
{

/// Which process has a cell.
using Division = std::function<int(vtkIdType cell)>;

int InTurn(vtkIdType cell)
{
  return static_cast<int>(cell) % Processes::Count();
}

/// Long runs of cells, the last process first.
int InRuns(vtkIdType cell)
{
  return Processes::Count() - 1 - static_cast<int>(cell / 20) % Processes::Count();
}

int AllOnTheLast(vtkIdType)
{
  return Processes::Count() - 1;
}

/// This process's cells of a mesh of polygons.
Mesh PieceOf(vtkPolyData* mesh, const Division& division)
{
  auto piece = Mesh::New();
  piece->SetPoints(mesh->GetPoints());
  vtkNew<vtkCellArray> polys;
  piece->GetCellData()->CopyAllOn();
  piece->GetCellData()->CopyAllocate(mesh->GetCellData());
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    if (division(cell) == Processes::Own())
    {
      vtkNew<vtkIdList> points;
      mesh->GetCellPoints(cell, points);
      const vtkIdType to = polys->InsertNextCell(points);
      piece->GetCellData()->CopyData(mesh->GetCellData(), cell, to);
    }
  }
  piece->SetPolys(polys);
  return piece;
}

Scene PiecesOf(const Scene& scene, const Division& division)
{
  Scene pieces;
  for (const Mesh& mesh : scene.Fixed)
  {
    pieces.Fixed.push_back(PieceOf(mesh, division));
  }
  for (const MovingObject& object : scene.Moving)
  {
    pieces.Moving.push_back({ PieceOf(object.Model, division), object.Pose });
  }
  return pieces;
}

/// Of all blocks; -1 for NaN, which equals nothing.
std::vector<std::vector<double>> ValuesOf(vtkMultiBlockDataSet* output, const char* name)
{
  std::vector<std::vector<double>> values;
  for (unsigned int port = 0; port < 2; ++port)
  {
    auto* blocks = vtkMultiBlockDataSet::SafeDownCast(output->GetBlock(port));
    for (unsigned int i = 0; i < blocks->GetNumberOfBlocks(); ++i)
    {
      values.push_back(
        TestScenes::ValuesOf(OutputOf(output, port, i)->GetCellData()->GetArray(name)));
      for (double& value : values.back())
      {
        value = std::isnan(value) ? -1 : value;
      }
    }
  }
  return values;
}

std::vector<std::vector<double>> PiecesOf(
  const std::vector<std::vector<double>>& whole, const Division& division)
{
  std::vector<std::vector<double>> pieces;
  for (const std::vector<double>& values : whole)
  {
    pieces.emplace_back();
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      if (division(static_cast<vtkIdType>(i)) == Processes::Own())
      {
        pieces.back().push_back(values[i]);
      }
    }
  }
  return pieces;
}

vtkSmartPointer<vtkIrradianceFilter> FilterOf(const Scene& scene, bool isDistributed)
{
  auto filter = MakeDefaultFilter(scene, 5000);
  filter->SetComputeStandardError(true);
  filter->SetController(isDistributed ? Processes::Controller : nullptr);
  filter->SetDistributedInput(isDistributed);
  return filter;
}

std::vector<std::vector<double>> RadianceOf(vtkIrradianceFilter* filter)
{
  vtkNew<vtkOutgoingRadianceFilter> radiance;
  radiance->SetInputConnection(filter->GetOutputPort());
  radiance->SetEyePosition(0.2, 0.3, 1.6);
  radiance->Update();
  return ValuesOf(vtkMultiBlockDataSet::SafeDownCast(radiance->GetOutput()), "Radiance");
}

/// At the points of each cell, in the mean.
std::vector<std::vector<double>> PointIrradianceOf(vtkIrradianceFilter* filter)
{
  vtkNew<vtkPointIrradianceFilter> points;
  points->SetInputConnection(filter->GetOutputPort());
  vtkNew<vtkPointDataToCellData> toCells;
  toCells->SetInputConnection(points->GetOutputPort());
  toCells->Update();
  return ValuesOf(
    vtkMultiBlockDataSet::SafeDownCast(toCells->GetOutputDataObject(0)), "PointIrradiance");
}

/// Two frames of pieces against a filter that has the whole, alone.
void ExpectWhole(const Scene& scene, const Division& division, bool isOrderedByPlace,
  int directLight = vtkIrradianceFilter::Shot)
{
  const auto pieces = FilterOf(PiecesOf(scene, division), true), whole = FilterOf(scene, false);
  whole->SetDistributedInput(isOrderedByPlace);
  pieces->SetDirectLight(directLight);
  whole->SetDirectLight(directLight);
  for (int frame = 0; frame < 2; ++frame)
  {
    scene.Moving[0].Pose->Translate(0.1, 0.05, 0);
    pieces->Update();
    whole->Update();
    for (const char* name : { "Irradiance", "IrradianceStandardError" })
    {
      EXPECT_EQ(
        ValuesOf(pieces->GetOutput(), name), PiecesOf(ValuesOf(whole->GetOutput(), name), division))
        << name << ", frame " << frame;
    }
  }
  EXPECT_GT(pieces->GetFigure("NumberOfInvalidWalks"), 0);
  EXPECT_GT(pieces->GetFigure("AbsorbedPower"), 0);
  if (directLight == vtkIrradianceFilter::Shot) // else there are no photons to look at
  {
    EXPECT_EQ(RadianceOf(pieces), PiecesOf(RadianceOf(whole), division));
  }
}

Scene MakeCoarseScene()
{
  return { { MakeRoom(3, 2), MakeLamp({ 1.5, 1.5, 2.875 }, 0.75, { 100 }) },
    { MakeMoving(MakeBox(0.5, 0.6, 0.7), { 1, 1, 0.5 }),
      MakeMoving(MakeBox(0.5, 0.5, 0.5), { 2, 2, 0.5 }) } };
}

void AddGlobalIds(vtkPolyData* mesh)
{
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("Ids");
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    ids->InsertNextValue(7 * i);
  }
  mesh->GetCellData()->SetGlobalIds(ids);
}

}

TEST(DistributedInput, BringsTheBitsOfTheWholeWhateverTheDivision)
{
  for (const Division division : { &InTurn, &InRuns, &AllOnTheLast })
  {
    ExpectWhole(MakeCoarseScene(), division, true);
    ExpectWhole(MakeCoarseScene(), division, true, vtkIrradianceFilter::Gathered);
  }
}

TEST(DistributedInput, KeepsTheOrderOfGlobalIds)
{
  const Scene scene = MakeCoarseScene();
  for (const Mesh& mesh : scene.Fixed)
  {
    AddGlobalIds(mesh);
  }
  for (const MovingObject& object : scene.Moving)
  {
    AddGlobalIds(object.Model);
  }
  ExpectWhole(scene, InRuns, false);
}

// A process without cells of a thing knows neither its arrays nor its pose.
TEST(DistributedInput, TakesThePoseFromWhoHasTheCells)
{
  const Mesh box = MakeBox(0.5, 0.6, 0.7);
  SetCellValues(box, "DiffuseReflectance", { 0.9 });
  SetObjectToWorld(box, MakeMoving(nullptr, { 1.5, 1.2, 0.6 }).Pose);
  const bool isOwner = Processes::Own() == Processes::Count() - 1;
  const Scene scene{ MakeCoarseScene().Fixed, {} };
  const auto pieces = FilterOf(PiecesOf(scene, InTurn), true), whole = FilterOf(scene, false);
  pieces->AddInputDataObject(1, isOwner ? box : Mesh::New());
  whole->AddInputDataObject(1, box);
  whole->SetDistributedInput(true);
  pieces->Update();
  whole->Update();
  EXPECT_EQ(ValuesOf(pieces->GetOutput(), "Irradiance")[0],
    PiecesOf(ValuesOf(whole->GetOutput(), "Irradiance"), InTurn)[0]);
  EXPECT_EQ(pieces->GetFigure("AbsorbedPower"), whole->GetFigure("AbsorbedPower"));
  const auto onBox = ValuesOf(pieces->GetOutput(), "Irradiance")[2];
  EXPECT_EQ(onBox, isOwner ? ValuesOf(whole->GetOutput(), "Irradiance")[2] : std::vector<double>{});
}

// Each process makes the lamp and the things that move; the room alone is in pieces.
TEST(DistributedInput, TakesOnceWhatAllHave)
{
  const Scene scene = MakeCoarseScene();
  Scene mixed = scene;
  mixed.Fixed[0] = PieceOf(scene.Fixed[0], InTurn);
  const auto pieces = FilterOf(mixed, true), whole = FilterOf(scene, false);
  whole->SetDistributedInput(true);
  pieces->Update();
  whole->Update();
  EXPECT_EQ(pieces->GetFigure("EmittedPower"), whole->GetFigure("EmittedPower"));
  auto expected = ValuesOf(whole->GetOutput(), "Irradiance");
  expected[0] = PiecesOf(expected, InTurn)[0];
  EXPECT_EQ(ValuesOf(pieces->GetOutput(), "Irradiance"), expected);
}

// Where a point light alone shines on black walls there is no noise; the division tells only which
// way points at the borders of pieces are taken, by 1e-4 of a cell.
TEST(DistributedInput, HasLightAtPoints)
{
  Scene scene{ { MakeRoom(3, 3) },
    { MakeMoving(MakePointLight({ 0, 0, 0 }, { 100 }), { 1, 1.2, 1.4 }) } };
  SetCellValues(scene.Fixed[0], "DiffuseReflectance", { 0 });
  Scene inPieces = scene;
  inPieces.Fixed[0] = PieceOf(scene.Fixed[0], InTurn);
  const auto pieces = FilterOf(inPieces, true), whole = FilterOf(scene, false);
  const auto expected = PiecesOf(PointIrradianceOf(whole), InTurn)[0];
  const auto found = PointIrradianceOf(pieces)[0];
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    EXPECT_NEAR(found[i], expected[i], 1e-3 * expected[i]);
  }
}

TEST(DistributedInput, AsksSourcesForPieces)
{
  vtkNew<vtkSphereSource> ball;
  ball->SetThetaResolution(16);
  const auto filter = FilterOf({ { MakeRoom(3, 2) }, {} }, true);
  filter->RemoveAllInputConnections(0);
  filter->AddInputConnection(0, ball->GetOutputPort());
  filter->AddInputDataObject(
    0, Processes::Own() == 0 ? MakeLamp({ 0, 0, 2 }, 1, { 100 }) : Mesh::New());
  filter->Update();
  const auto cells = static_cast<int>(ValuesOf(filter->GetOutput(), "Irradiance")[0].size());
  EXPECT_EQ(Processes::Sum(cells), 192);
  EXPECT_GT(cells, 0);
  EXPECT_EQ(cells<192, Processes::Count()> 1) << "this process has all of the sphere";
}

TEST(DistributedInput, NeedsTheSameArraysAndAsManyInputsOnAllProcesses)
{
  if (Processes::Count() == 1)
  {
    GTEST_SKIP() << "one process cannot differ";
  }
  Scene others = PiecesOf(MakeCoarseScene(), InTurn), fewer = others;
  if (Processes::Own() == 1)
  {
    fewer.Fixed[0] = Copy(fewer.Fixed[0]);
    SetCellValues(others.Fixed[0], "DiffuseReflectance", { 0.7 });
    fewer.Moving.pop_back();
  }
  ExpectOne(Update(FilterOf(others, true)).Errors,
    { "input port 0, connection 0: not all pieces of it have the cell array DiffuseReflectance "
      "(double, 1)" });
  ExpectOne(Update(FilterOf(fewer, true)).Errors, { "another number of inputs" });
}

TEST(DistributedInput, HasNoNumbersForAChosenCell)
{
  const auto filter = FilterOf(PiecesOf(MakeCoarseScene(), InTurn), true);
  filter->SetNumberOfOutputWalks(10);
  filter->SetOutputWalksCell(1);
  ExpectOne(Update(filter).Errors, { "with DistributedInput" });
}
