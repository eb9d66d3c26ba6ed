// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkConeSource.h"
#include "vtkCubeSource.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkIrradianceFilter.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

/// Rooms, lamps and objects that move in them, in metres.
namespace TestScenes
{

using Vector = std::array<double, 3>;
using Mesh = vtkSmartPointer<vtkPolyData>;

inline Mesh Copy(vtkPolyData* polyData)
{
  auto copy = Mesh::New();
  copy->DeepCopy(polyData);
  return copy;
}

/// The same tuple for every cell.
inline void SetCellValues(vtkPolyData* polyData, const char* name, const std::vector<double>& tuple)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(tuple.size()));
  array->SetNumberOfTuples(polyData->GetNumberOfCells());
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    array->SetTuple(i, tuple.data());
  }
  polyData->GetCellData()->AddArray(array);
}

inline void SetField(vtkDataObject* data, const char* name, const std::vector<double>& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  for (const double value : values)
  {
    array->InsertNextValue(value);
  }
  data->GetFieldData()->AddArray(array);
}

/// A field array of one tuple.
inline void SetFieldTuple(vtkDataObject* data, const char* name, const std::vector<double>& tuple)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(tuple.size()));
  array->InsertNextTuple(tuple.data());
  data->GetFieldData()->AddArray(array);
}

/// A field array of 16 values, row by row.
inline void SetObjectToWorld(vtkDataObject* data, vtkTransform* pose)
{
  const double* const matrix = pose->GetMatrix()->GetData();
  SetFieldTuple(data, "ObjectToWorld", { matrix, matrix + 16 });
}

/// The i-th for the i-th point; one for all if there is one alone.
inline void SetNormals(vtkPolyData* polyData, const std::vector<Vector>& normals)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName("Normals");
  array->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < polyData->GetNumberOfPoints(); ++i)
  {
    array->InsertNextTuple(normals[normals.size() == 1 ? 0 : static_cast<std::size_t>(i)].data());
  }
  polyData->GetPointData()->SetNormals(array);
}

/// Points in double, without cells.
inline Mesh MakePoints(const std::vector<Vector>& positions)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vector& position : positions)
  {
    points->InsertNextPoint(position.data());
  }
  auto mesh = Mesh::New();
  mesh->SetPoints(points);
  return mesh;
}

/// Points with normals as SetNormals takes them, and without cells.
inline Mesh MakeSensors(const std::vector<Vector>& positions, const std::vector<Vector>& normals)
{
  Mesh sensors = MakePoints(positions);
  SetNormals(sensors, normals);
  return sensors;
}

/// With points in double, so that what coincides still does up to the last digits.
inline Mesh Transformed(vtkPolyData* mesh, vtkTransform* transform)
{
  vtkNew<vtkTransformPolyDataFilter> filter;
  filter->SetInputData(mesh);
  filter->SetTransform(transform);
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  filter->Update();
  return Copy(filter->GetOutput());
}

/// In double: scaled first, then shifted.
inline Mesh Placed(const Mesh& mesh, double scale, const Vector& offset)
{
  Mesh placed = Copy(mesh);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    const double* p = mesh->GetPoint(i);
    points->InsertNextPoint(
      offset[0] + scale * p[0], offset[1] + scale * p[1], offset[2] + scale * p[2]);
  }
  placed->SetPoints(points);
  return placed;
}

/// The front faces axis1 x axis2.
inline Mesh MakeRectangle(
  const Vector& corner, const Vector& axis1, const Vector& axis2, int resolution)
{
  vtkNew<vtkPlaneSource> source;
  source->SetOrigin(corner[0], corner[1], corner[2]);
  source->SetPoint1(corner[0] + axis1[0], corner[1] + axis1[1], corner[2] + axis1[2]);
  source->SetPoint2(corner[0] + axis2[0], corner[1] + axis2[1], corner[2] + axis2[2]);
  source->SetResolution(resolution, resolution);
  source->Update();
  Mesh rectangle = Copy(source->GetOutput());
  rectangle->GetPointData()->Initialize();
  return rectangle;
}

/// Normal of a polygon in one plane, convex or not, as long as twice its area. vtkPolygon's has
/// float's rounding in VTK 9.3.
inline Vector PolygonNormal(vtkPolyData* polyData, vtkIdList* ids)
{
  Vector sum{};
  for (vtkIdType i = 2; i < ids->GetNumberOfIds(); ++i)
  {
    double a[3], b[3], c[3], normal[3];
    polyData->GetPoint(ids->GetId(0), a);
    polyData->GetPoint(ids->GetId(i - 1), b);
    polyData->GetPoint(ids->GetId(i), c);
    vtkMath::Subtract(b, a, b);
    vtkMath::Subtract(c, a, c);
    vtkMath::Cross(b, c, normal);
    vtkMath::Add(sum.data(), normal, sum.data());
  }
  return sum;
}

inline Mesh Join(const std::vector<Mesh>& parts)
{
  vtkNew<vtkAppendPolyData> append;
  for (const Mesh& part : parts)
  {
    append->AddInputData(part);
  }
  append->Update();
  return Copy(append->GetOutput());
}

/// The cube [0, side]^3 with its front inside: floor, ceiling, then the walls x = 0, x = side,
/// y = 0, y = side, each of resolution^2 squares.
inline Mesh MakeRoom(double side, int resolution)
{
  const double s = side;
  return Join({
    MakeRectangle({ 0, 0, 0 }, { s, 0, 0 }, { 0, s, 0 }, resolution),
    MakeRectangle({ 0, 0, s }, { 0, s, 0 }, { s, 0, 0 }, resolution),
    MakeRectangle({ 0, 0, 0 }, { 0, s, 0 }, { 0, 0, s }, resolution),
    MakeRectangle({ s, 0, 0 }, { 0, 0, s }, { 0, s, 0 }, resolution),
    MakeRectangle({ 0, 0, 0 }, { 0, 0, s }, { s, 0, 0 }, resolution),
    MakeRectangle({ 0, s, 0 }, { s, 0, 0 }, { 0, 0, s }, resolution),
  });
}

/// A square that shines downwards.
inline Mesh MakeLamp(const Vector& centre, double side, const std::vector<double>& exitance)
{
  const double h = 0.5 * side;
  Mesh lamp =
    MakeRectangle({ centre[0] - h, centre[1] - h, centre[2] }, { 0, side, 0 }, { side, 0, 0 }, 1);
  SetCellValues(lamp, "RadiantExitance", exitance);
  return lamp;
}

inline Mesh MakePointLight(const Vector& position, const std::vector<double>& flux)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const vtkIdType id = points->InsertNextPoint(position.data());
  vtkNew<vtkCellArray> vertices;
  vertices->InsertNextCell(1, &id);
  auto light = Mesh::New();
  light->SetPoints(points);
  light->SetVerts(vertices);
  SetCellValues(light, "RadiantFlux", flux);
  return light;
}

/// With point normals.
inline Mesh MakeBall(double radius, int resolution)
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(radius);
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution);
  source->Update();
  return Copy(source->GetOutput());
}

inline Mesh MakeBox(double x, double y, double z)
{
  vtkNew<vtkCubeSource> source;
  source->SetXLength(x);
  source->SetYLength(y);
  source->SetZLength(z);
  source->Update();
  return Copy(source->GetOutput());
}

inline Mesh MakeCone(double height, double radius, int resolution)
{
  vtkNew<vtkConeSource> source;
  source->SetHeight(height);
  source->SetRadius(radius);
  source->SetResolution(resolution);
  source->Update();
  return Copy(source->GetOutput());
}

/// An object of port 1 and its pose.
struct MovingObject
{
  Mesh Model;
  vtkSmartPointer<vtkTransform> Pose;
};

inline MovingObject MakeMoving(const Mesh& model, const Vector& position)
{
  auto pose = vtkSmartPointer<vtkTransform>::New();
  pose->Translate(position[0], position[1], position[2]);
  return { model, pose };
}

/// What a filter is given. Filters share the meshes and the transforms.
struct Scene
{
  std::vector<Mesh> Fixed;
  std::vector<MovingObject> Moving;
};

/// A room of 3 m with a lamp of 56.25 W under the ceiling, a ball and a box.
inline Scene MakeSmallScene()
{
  return { { MakeRoom(3, 3), MakeLamp({ 1.5, 1.5, 2.875 }, 0.75, { 100 }) },
    { MakeMoving(MakeBall(0.4, 8), { 1, 1, 1 }),
      MakeMoving(MakeBox(0.5, 0.6, 0.7), { 2, 2, 0.5 }) } };
}

/// A room of 3 m with a lamp of 25 W under the ceiling.
inline Scene MakeEmptyRoom()
{
  return { { MakeRoom(3, 2), MakeLamp({ 1.5, 1.5, 2.9 }, 0.5, { 100 }) }, {} };
}

/// Makes `scene` the filter's only input.
inline void Connect(vtkIrradianceFilter* filter, const Scene& scene)
{
  filter->RemoveAllInputConnections(0);
  filter->RemoveAllInputConnections(1);
  filter->RemoveAllDynamicTransforms();
  for (const Mesh& mesh : scene.Fixed)
  {
    filter->AddInputDataObject(0, mesh);
  }
  for (std::size_t i = 0; i < scene.Moving.size(); ++i)
  {
    filter->AddInputDataObject(1, scene.Moving[i].Model);
    filter->SetDynamicTransform(static_cast<int>(i), scene.Moving[i].Pose);
  }
}

/// With all else as a user finds it.
inline vtkSmartPointer<vtkIrradianceFilter> MakeDefaultFilter(const Scene& scene, vtkIdType walks)
{
  auto filter = vtkSmartPointer<vtkIrradianceFilter>::New();
  filter->SetNumberOfWalks(walks);
  Connect(filter, scene);
  return filter;
}

/// Walks bring all light, and cells have their sums.
inline vtkSmartPointer<vtkIrradianceFilter> MakeFilter(const Scene& scene, vtkIdType walks)
{
  auto filter = MakeDefaultFilter(scene, walks);
  filter->SetMethodToWalks();
  return filter;
}

/// The block of a connection.
inline vtkPolyData* OutputOf(vtkMultiBlockDataSet* output, unsigned int port, unsigned int i)
{
  auto* blocks = vtkMultiBlockDataSet::SafeDownCast(output->GetBlock(port));
  return blocks ? vtkPolyData::SafeDownCast(blocks->GetBlock(i)) : nullptr;
}

inline vtkDataArray* IrradianceOf(vtkIrradianceFilter* filter, unsigned int port, unsigned int i)
{
  return OutputOf(filter->GetOutput(), port, i)->GetCellData()->GetArray("Irradiance");
}

inline double Field(vtkIrradianceFilter* filter, const char* name, int component = 0)
{
  return filter->GetOutput()->GetFieldData()->GetArray(name)->GetComponent(0, component);
}

/// Tuple after tuple; none of null.
inline std::vector<double> ValuesOf(vtkDataArray* array)
{
  std::vector<double> values;
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
  {
    for (int component = 0; component < array->GetNumberOfComponents(); ++component)
    {
      values.push_back(array->GetComponent(i, component));
    }
  }
  return values;
}

/// TIME_STEPS of a filter's output.
inline std::vector<double> StepsOf(vtkAlgorithm* filter, int port = 0)
{
  filter->UpdateInformation();
  vtkInformation* info = filter->GetOutputInformation(port);
  auto* key = vtkStreamingDemandDrivenPipeline::TIME_STEPS();
  return info->Has(key) ? std::vector<double>(info->Get(key), info->Get(key) + info->Length(key))
                        : std::vector<double>();
}

/// Its TIME_RANGE.
inline std::vector<double> RangeOf(vtkAlgorithm* filter, int port = 0)
{
  filter->UpdateInformation();
  const double* range =
    filter->GetOutputInformation(port)->Get(vtkStreamingDemandDrivenPipeline::TIME_RANGE());
  return range ? std::vector<double>{ range[0], range[1] } : std::vector<double>();
}

/// The same numbers with every standard library: splitmix64 (Steele, Lea and Flood 2014).
class RandomNumbers
{
public:
  explicit RandomNumbers(std::uint64_t seed)
    : State(seed)
  {
  }

  double Between(double low, double high)
  {
    return low + (high - low) * (static_cast<double>(this->Next() >> 11) * 0x1p-53);
  }

  int Below(int end) { return static_cast<int>(this->Next() % static_cast<std::uint64_t>(end)); }

private:
  std::uint64_t Next()
  {
    this->State += 0x9e3779b97f4a7c15u;
    std::uint64_t z = this->State;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  std::uint64_t State;
};

}
