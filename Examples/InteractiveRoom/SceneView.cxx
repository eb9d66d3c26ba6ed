// SPDX-License-Identifier: BSD-3-Clause
#include "SceneView.h"

#include "IrradianceColors.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCompositeDataSet.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cstdint>

namespace interactiveroom
{
namespace
{

// A table is faster than the function it comes from.
void FillTable(vtkLookupTable* table)
{
  vtkNew<vtkColorTransferFunction> colors;
  movingteapot::SetIrradianceColors(colors, 1);
  constexpr int count = 256;
  table->SetNumberOfTableValues(count);
  for (int i = 0; i < count; ++i)
  {
    double rgb[3];
    colors->GetColor(i / (count - 1.0), rgb);
    table->SetTableValue(i, rgb[0], rgb[1], rgb[2], 1);
  }
}

// Each cell has points of its own, which get its colour. Software that draws without a graphics
// card is much faster with colours of points than with colours of cells, which VTK looks up for
// each pixel. Vertices and lines, which come before polygons, are not drawn.
vtkSmartPointer<vtkPolyData> WithOwnPoints(vtkPolyData* mesh)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (vtkIdType cell = mesh->GetNumberOfVerts() + mesh->GetNumberOfLines();
       cell < mesh->GetNumberOfCells(); ++cell)
  {
    vtkIdType size;
    const vtkIdType* ids;
    mesh->GetCellPoints(cell, size, ids);
    cells->InsertNextCell(int(size));
    for (vtkIdType i = 0; i < size; ++i)
    {
      cells->InsertCellPoint(points->InsertNextPoint(mesh->GetPoint(ids[i])));
    }
  }
  auto own = vtkSmartPointer<vtkPolyData>::New();
  own->SetPoints(points);
  own->SetPolys(cells);
  return own;
}

// The colour of each cell for all of its points.
void SetColors(vtkPolyData* shown, vtkUnsignedCharArray* ofCells)
{
  vtkNew<vtkUnsignedCharArray> ofPoints;
  ofPoints->SetNumberOfComponents(4);
  ofPoints->SetNumberOfTuples(shown->GetNumberOfPoints());
  vtkCellArray* cells = shown->GetPolys();
  const vtkIdType first = ofCells->GetNumberOfTuples() - cells->GetNumberOfCells();
  const auto* from = reinterpret_cast<const std::uint32_t*>(ofCells->GetPointer(0)) + first;
  auto* to = reinterpret_cast<std::uint32_t*>(ofPoints->GetPointer(0));
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
  {
    to = std::fill_n(to, cells->GetCellSize(cell), from[cell]);
  }
  shown->GetPointData()->SetScalars(ofPoints);
}

// What is stale is a small part.
constexpr double StaleShare = 0.2;

}

SceneView::SceneView(const Room& room, LightFollower& light, vtkRenderer* renderer)
{
  FillTable(this->Colors);
  for (const StillThing& still : room.Still)
  {
    vtkActor* actor = this->Add(still.Mesh, renderer);
    actor->GetMapper()->SetScalarVisibility(!still.IsLamp);
    actor->GetProperty()->SetColor(1, 1, 0.95); // of lamps
    actor->GetProperty()->SetBackfaceCulling(still.IsOpen);
  }
  this->FirstMoving = this->Actors.size();
  for (std::size_t i = 0; i < room.Moving.size(); ++i)
  {
    this->Add(room.Moving[i].Mesh, renderer)->SetUserTransform(light.GetPose(int(i)));
  }
}

vtkActor* SceneView::Add(vtkPolyData* mesh, vtkRenderer* renderer)
{
  const auto shown = WithOwnPoints(mesh);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(shown);
  mapper->SetColorModeToDirectScalars();
  mapper->SetScalarModeToUsePointData();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetAmbient(
    0.3); // until there are colours, a lamp of VTK's shows the shapes
  actor->GetProperty()->SetDiffuse(0.3);
  renderer->AddActor(actor);
  this->Actors.emplace_back(actor);
  this->Shown.push_back(shown);
  return actor;
}

void SceneView::SetBrightest(double brightest)
{
  this->Brightest = brightest;
}

void SceneView::Show(vtkMultiBlockDataSet* scene, bool isStaleShown)
{
  const char* array = isStaleShown ? "StaleIrradiance" : "Irradiance";
  const double most = isStaleShown ? StaleShare * this->Brightest : this->Brightest;
  if (this->Colors->GetRange()[1] != most)
  {
    this->Colors->SetRange(0, most);
  }
  for (vtkActor* actor : this->Actors)
  {
    actor->GetProperty()->LightingOff();
    actor->GetProperty()->SetAmbient(0);
    actor->GetProperty()->SetDiffuse(1);
  }
  auto shown = this->Shown.begin();
  for (vtkPolyData* mesh : vtkCompositeDataSet::GetDataSets<vtkPolyData>(scene))
  {
    const auto colors = vtk::TakeSmartPointer(this->Colors->MapScalars(
      mesh->GetCellData()->GetArray(array), VTK_COLOR_MODE_MAP_SCALARS, 0));
    SetColors(*shown++, colors);
  }
}

}
