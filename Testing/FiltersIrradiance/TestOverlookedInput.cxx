// SPDX-License-Identifier: BSD-3-Clause
// Input that was once overlooked without a word: ghosts, light on cells of the wrong kind, arrays
// and poses in the wrong place, points that are integers.

#include "ErrorObserver.h"
#include "TestScenes.h"

#include "vtkDataSetAttributes.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

using namespace TestScenes;

namespace
{

constexpr vtkIdType NumberOfWalks = 2000;

/// Cell i gets `kinds[i]`, and 0 beyond the end of `kinds`.
void SetGhosts(vtkPolyData* mesh, const std::vector<unsigned char>& kinds)
{
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    ghosts->InsertNextValue(
      static_cast<std::size_t>(i) < kinds.size() ? kinds[static_cast<std::size_t>(i)] : 0);
  }
  mesh->GetCellData()->AddArray(ghosts);
}

void MovePointArray(vtkPolyData* mesh, const char* name)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(mesh->GetNumberOfPoints());
  array->Fill(0.5);
  mesh->GetPointData()->AddArray(array);
  mesh->GetCellData()->RemoveArray(name);
}

void SetPoseField(vtkPolyData* mesh, double shift)
{
  SetObjectToWorld(mesh, MakeMoving(nullptr, { shift, 0, 0 }).Pose);
}

}

// A lamp of four cells, one of them another piece's, above a hidden shade.
TEST(GhostCells, TakeNoPart)
{
  const Mesh lamp =
    MakeRectangle({ 0, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, 2); // four cells, downwards
  SetCellValues(lamp, "RadiantExitance", { 100 });
  SetGhosts(lamp, { vtkDataSetAttributes::DUPLICATECELL, 0, 0, 0 });
  const Mesh shade = MakeRectangle({ -5, -5, 0.5 }, { 10, 0, 0 }, { 0, 10, 0 }, 1);
  SetGhosts(shade, { vtkDataSetAttributes::HIDDENCELL });
  const Mesh floor = MakeRectangle({ -50, -50, 0 }, { 100, 0, 0 }, { 0, 100, 0 }, 1);
  const Mesh bulbs = MakePointLight({ 0, 0, 0.25 }, { 7 });
  SetGhosts(bulbs, { vtkDataSetAttributes::DUPLICATECELL });
  Scene scene{ { lamp, floor, bulbs }, { MakeMoving(shade, { 0, 0, 0 }) } };
  const auto filter = MakeFilter(scene, NumberOfWalks);
  filter->SetDefaultDiffuseReflectance(0);
  ExpectNothing(Update(filter));
  EXPECT_DOUBLE_EQ(Field(filter, "EmittedPower"), 75); // three cells of .25 m2
  EXPECT_EQ(IrradianceOf(filter, 0, 0)->GetComponent(0, 0), 0);
  EXPECT_EQ(IrradianceOf(filter, 1, 0)->GetComponent(0, 0), 0);
  EXPECT_NEAR(IrradianceOf(filter, 0, 1)->GetComponent(0, 0) * 1e4, 75, 0.1); // nearly all
}

// Cells with another mark, such as those on a border, take part.
TEST(GhostCells, OtherMarksMeanNothing)
{
  const Scene scene = MakeSmallScene();
  const auto expected = MakeFilter(scene, NumberOfWalks);
  expected->Update();
  SetGhosts(scene.Fixed[1], { vtkDataSetAttributes::HIGHCONNECTIVITYCELL });
  const auto filter = MakeFilter(scene, NumberOfWalks);
  filter->Update();
  EXPECT_EQ(Field(filter, "EmittedPower"), Field(expected, "EmittedPower"));
}

TEST(IntegerPoints, AreMovedInDouble)
{
  Scene scene = MakeSmallScene();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToInt();
  const Mesh tetrahedron = Mesh::New();
  for (const auto& p :
    std::vector<std::array<int, 3>>{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } })
  {
    points->InsertNextPoint(p[0], p[1], p[2]);
  }
  vtkNew<vtkCellArray> cells;
  for (const auto& ids :
    std::vector<std::array<vtkIdType, 3>>{ { 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 } })
  {
    cells->InsertNextCell(3, ids.data());
  }
  tetrahedron->SetPoints(points);
  tetrahedron->SetPolys(cells);
  scene.Moving = { MakeMoving(tetrahedron, { 0.25, 0.75, 0.5 }) };
  const auto filter = MakeFilter(scene, NumberOfWalks);
  for (const double shift : { 0.0, 0.125 })
  {
    scene.Moving[0].Pose->Translate(shift, 0, 0);
    filter->Update();
    vtkPoints* moved = OutputOf(filter->GetOutput(), 1, 0)->GetPoints();
    EXPECT_EQ(moved->GetDataType(), VTK_DOUBLE);
    EXPECT_EQ(moved->GetPoint(3)[0], 0.25 + shift);
    EXPECT_EQ(moved->GetPoint(3)[1], 0.75);
    EXPECT_EQ(moved->GetPoint(3)[2], 1.5);
  }
}

TEST(ChosenArray, ThatIsNowhereIsAnError)
{
  const auto filter = MakeFilter(MakeSmallScene(), NumberOfWalks);
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Albedo");
  ExpectOnlyError(filter, { "Albedo", "diffuse reflectance", "not among the cell arrays" });
  filter->SetInputArrayToProcess(
    1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "DiffuseReflectance");
  EXPECT_TRUE(Update(filter).Errors.empty()); // the default array may be missing
}

TEST(ChosenArray, ThatOneInputHasIsRead)
{
  const Scene scene = MakeSmallScene();
  SetCellValues(scene.Fixed[0], "Albedo", { 0.25 });
  const auto filter = MakeFilter(scene, NumberOfWalks);
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Albedo");
  ExpectNothing(Update(filter));
}

TEST(ChosenArray, OfThePointsIsAnError)
{
  const Scene scene = MakeSmallScene();
  MovePointArray(scene.Fixed[0], "Albedo");
  const auto filter = MakeFilter(scene, NumberOfWalks);
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Albedo");
  ExpectOnlyError(filter, { "Albedo", "diffuse reflectance", "points" });
}

TEST(DefaultArray, OnThePointsIsAWarning)
{
  const Scene scene = MakeSmallScene();
  MovePointArray(scene.Fixed[0], "DiffuseReflectance");
  ExpectOnlyWarning(MakeFilter(scene, NumberOfWalks),
    { "input port 0, connection 0", "DiffuseReflectance", "points" });
}

TEST(MisplacedLight, FluxOfPolygonsAloneIsAnError)
{
  Scene scene = MakeSmallScene();
  SetCellValues(scene.Fixed[0], "RadiantFlux", { 0 });
  scene.Fixed[0]->GetCellData()->GetArray("RadiantFlux")->SetComponent(17, 0, 3);
  ExpectOnlyError(
    MakeFilter(scene, NumberOfWalks), { "input port 0, connection 0, cell 17", "radiant flux" });
}

TEST(MisplacedLight, ExitanceOfVerticesAloneIsAnError)
{
  Scene scene = MakeSmallScene();
  const Mesh bulb = MakePointLight({ 1, 1, 1 }, { 5 });
  SetCellValues(bulb, "RadiantExitance", { 10 });
  scene.Fixed.push_back(bulb);
  ExpectOnlyError(
    MakeFilter(scene, NumberOfWalks), { "input port 0, connection 2, cell 0", "radiant exitance" });
}

// Where a mesh has both kinds of cells, an array has values for both.
TEST(MisplacedLight, BesideTheRightCellsIsAWarning)
{
  Scene scene = MakeSmallScene();
  const Mesh both = Join({ MakePointLight({ 1, 1, 1 }, { 5 }), MakeBox(0.1, 0.1, 0.1) });
  SetCellValues(both, "RadiantFlux", { 5 });
  scene.Fixed.push_back(both);
  const auto filter = MakeFilter(scene, NumberOfWalks);
  ExpectOnlyWarning(filter, { "input port 0, connection 2", "6 cells", "cell 1", "radiant flux" });
  EXPECT_NEAR(Field(filter, "EmittedPower"), 56.25 + 5, 1e-9);

  both->GetCellData()->RemoveArray("RadiantFlux");
  SetCellValues(both, "RadiantExitance", { 2 });
  both->Modified();
  ExpectOnlyWarning(filter, { "input port 0, connection 2", "1 cells", "cell 0", "exitance" });
}

TEST(PoseField, OfAStaticInputIsAWarning)
{
  const Scene scene = MakeSmallScene();
  SetPoseField(scene.Fixed[1], 0.5);
  ExpectOnlyWarning(
    MakeFilter(scene, NumberOfWalks), { "input port 0, connection 1", "ObjectToWorld", "static" });
  SetPoseField(scene.Fixed[1], 0); // the identity moves nothing
  EXPECT_TRUE(Update(MakeFilter(scene, NumberOfWalks)).Warnings.empty());
}

TEST(PoseField, OfStringsIsAnError)
{
  const Scene scene = MakeSmallScene();
  vtkNew<vtkStringArray> strings;
  strings->SetName("ObjectToWorld");
  strings->SetNumberOfValues(16);
  scene.Moving[1].Model->GetFieldData()->AddArray(strings);
  const auto filter = MakeFilter(scene, NumberOfWalks);
  filter->SetDynamicTransform(1, nullptr);
  ExpectOnlyError(filter, { "input port 1, connection 1", "ObjectToWorld", "vtkStringArray" });
}

// The pose has already moved the output: fed back as an input, it does not move again.
TEST(PoseField, IsNotHandedOn)
{
  const Scene scene = MakeSmallScene();
  SetPoseField(scene.Moving[1].Model, 0.5);
  const auto filter = MakeFilter(scene, NumberOfWalks);
  filter->SetDynamicTransform(1, nullptr);
  filter->Update();
  vtkPolyData* output = OutputOf(filter->GetOutput(), 1, 1);
  EXPECT_EQ(output->GetFieldData()->GetAbstractArray("ObjectToWorld"), nullptr);
  vtkNew<vtkIrradianceFilter> second;
  second->SetNumberOfWalks(NumberOfWalks);
  second->AddInputDataObject(0, scene.Fixed[1]);
  second->AddInputDataObject(1, output);
  second->Update();
  EXPECT_EQ(OutputOf(second->GetOutput(), 1, 0)->GetCenter()[0], output->GetCenter()[0]);
}
