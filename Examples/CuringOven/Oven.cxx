// SPDX-License-Identifier: BSD-3-Clause
#include "Oven.h"

#include "Meshes.h"

#include <vtkAppendPolyData.h>
#include <vtkCellData.h>
#include <vtkCellSizeFilter.h>
#include <vtkCylinderSource.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>

namespace curingoven
{
namespace
{

using Mesh = vtkSmartPointer<vtkPolyData>;
constexpr std::optional<double> none;

vtkSmartPointer<vtkDoubleArray> AddArray(vtkPolyData* mesh, const char* name, double value)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfTuples(mesh->GetNumberOfCells());
  array->FillValue(value);
  mesh->GetCellData()->AddArray(array);
  return array;
}

void SetMaterial(vtkPolyData* mesh, double diffuse, double specular = 0, double exponent = 0)
{
  AddArray(mesh, "DiffuseReflectance", diffuse);
  if (specular > 0)
  {
    AddArray(mesh, "SpecularReflectance", specular);
    AddArray(mesh, "PhongExponent", exponent);
  }
}

Mesh Append(std::initializer_list<Mesh> meshes)
{
  vtkNew<vtkAppendPolyData> append;
  for (vtkPolyData* mesh : meshes)
  {
    append->AddInputData(mesh);
  }
  append->Update();
  return append->GetOutput();
}

// The same mesh under each place of a lamp.
Mesh Repeat(vtkPolyData* mesh, const OvenOptions& options)
{
  vtkNew<vtkAppendPolyData> append;
  for (const double x : options.LampPlaces)
  {
    vtkNew<vtkTransform> ovenFromLamp;
    ovenFromLamp->Translate(x, 0, options.LampHeight);
    vtkNew<vtkTransformPolyDataFilter> place;
    place->SetInputData(mesh);
    place->SetTransform(ovenFromLamp);
    append->AddInputConnection(place->GetOutputPort());
  }
  append->Update();
  return append->GetOutput();
}

// A tube along y. Its ends, where the electrodes are, do not shine.
Mesh MakeLamp(double length, double power)
{
  vtkNew<vtkCylinderSource> tube;
  tube->SetRadius(LampRadius);
  tube->SetHeight(length);
  tube->SetResolution(24);
  vtkNew<vtkCellSizeFilter> sizes;
  sizes->SetInputConnection(tube->GetOutputPort());
  sizes->Update();
  Mesh lamp = tube->GetOutput();
  vtkDataArray* areas = sizes->GetPolyDataOutput()->GetCellData()->GetArray("Area");
  const auto isSide = [lamp](vtkIdType i) { return lamp->GetCellType(i) == VTK_QUAD; };
  double area = 0;
  for (vtkIdType i = 0; i < lamp->GetNumberOfCells(); ++i)
  {
    area += isSide(i) ? areas->GetTuple1(i) : 0;
  }
  auto exitance = AddArray(lamp, "RadiantExitance", 0); // W/m2
  for (vtkIdType i = 0; i < lamp->GetNumberOfCells(); ++i)
  {
    exitance->SetValue(i, isSide(i) ? power / area : 0);
  }
  SetMaterial(lamp, 0.1);
  return lamp;
}

// A parabola across the lamp, which lies in its focus, so that most of its light goes straight
// down.
Mesh MakeReflector(double lampLength)
{
  const double w = ReflectorHalfWidth, l = lampLength / 2 + 0.02;
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-w, -l, 0);
  plane->SetPoint1(w, -l, 0);
  plane->SetPoint2(-w, l, 0);
  plane->SetResolution(32, 16);
  plane->Update();
  Mesh reflector = plane->GetOutput();
  for (vtkIdType i = 0; i < reflector->GetNumberOfPoints(); ++i)
  {
    double x[3];
    reflector->GetPoint(i, x);
    reflector->GetPoints()->SetPoint(i, x[0], x[1], FocalLength - x[0] * x[0] / (4 * FocalLength));
  }
  reflector->GetPointData()->Initialize(); // the normals of the plane
  SetMaterial(reflector, 0.05, 0.8, 1000); // bright-rolled aluminium
  return reflector;
}

}

std::vector<Mesh> MakeOven(const OvenOptions& options)
{
  using movingteapot::Facing;
  using movingteapot::MakeGridBox;
  const double cell = 0.05;
  const double sheet = 0.3;
  const double end = options.OvenLength / 2, side = options.OvenWidth / 2, top = options.OvenHeight;
  // Two sides and a ceiling, and a wall above each opening.
  Mesh tunnel = Append({
    MakeGridBox({ -end, end, -side, side, 0, top }, cell, Facing::Inward,
      { { none, none, sheet, sheet, none, sheet } }),
    MakeGridBox({ -end, end, -side, side, options.Opening, top }, cell, Facing::Inward,
      { { sheet, sheet, none, none, none, none } }),
  });
  SetMaterial(tunnel, sheet, 0.45, 20); // aluminium sheet
  const double beltEnd = BeltEnd(options);
  Mesh belt = MakeGridBox({ -beltEnd, beltEnd, -side, side, -cell, 0 }, cell, Facing::Outward,
    { { none, none, none, none, none, 0.15 } }); // dark steel
  const double length = LampLength(options);
  const std::vector<Mesh> oven = { Repeat(MakeLamp(length, options.LampPower), options),
    Repeat(MakeReflector(length), options), tunnel, belt };
  const char* const names[] = { "lamps", "reflectors", "tunnel", "belt" };
  for (int i = 0; i < NumberOfOvenMeshes; ++i)
  {
    movingteapot::SetName(oven[i], names[i]);
  }
  return oven;
}

}
