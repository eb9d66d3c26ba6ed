#include "BenchmarkScene.h"

#include "Meshes.h"

#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>
#include <vtkTriangleFilter.h>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <iterator>
#include <random>
#include <utility>

using namespace irradiance;

namespace
{

const movingteapot::Box kRoom = { -5, 5, -5, 5, 0, 10 };

using Triangles = std::vector<Triangle>;

std::string meshPath(const std::string& name)
{
  return VTKIRRADIANCE_DATA_DIR "/downloaded/" + name;
}

Triangles trianglesOf(vtkPolyData* mesh)
{
  vtkNew<vtkTriangleFilter> cutter;
  cutter->SetInputData(mesh);
  cutter->Update();
  vtkPolyData* cut = cutter->GetOutput();
  vtkNew<vtkIdList> ids;
  const auto corner = [&](vtkIdType i) { return Vector3(cut->GetPoint(ids->GetId(i))); };
  Triangles triangles;
  for (vtkIdType cell = 0; cell < cut->GetNumberOfCells(); ++cell)
  {
    cut->GetCellPoints(cell, ids);
    triangles.push_back({ corner(0), corner(1), corner(2) });
  }
  return triangles;
}

/// A downloaded mesh (y up), turned upright and fitted into a cube that stands on the origin.
Triangles readMesh(const std::string& name, double edge)
{
  vtkNew<vtkTransform> upright;
  upright->RotateX(90);
  vtkNew<vtkTransformPolyDataFilter> turn;
  turn->SetInputData(movingteapot::ReadMeshFile(meshPath(name)));
  turn->SetTransform(upright);
  turn->Update();
  const double half = 0.5 * edge;
  return trianglesOf(
    movingteapot::FitMesh(turn->GetOutput(), { -half, half, -half, half, 0, edge }));
}

bool hasMesh(const std::string& name)
{
  return vtksys::SystemTools::FileExists(meshPath(name), true);
}

Triangles makeWalls()
{
  const movingteapot::SideReflectances all = { 0.5, 0.5, 0.5, 0.5, 0.5, 0.5 };
  return trianglesOf(movingteapot::MakeGridBox(kRoom, 0.25, movingteapot::Facing::Inward, all));
}

/// Turned about an axis that is none of the frame's, so that no box stays aligned.
AffineMap makePose(double angle, const Vector3& position)
{
  return { Eigen::AngleAxisd(angle, Vector3(0.2, 0.3, 1).normalized()).toRotationMatrix(),
    position };
}

void append(const Triangles& triangles, const AffineMap& worldFromMesh, Triangles& all)
{
  std::transform(triangles.begin(), triangles.end(), std::back_inserter(all),
    [&](const Triangle& triangle) { return transformed(worldFromMesh, triangle); });
}

SceneObject makeObject(Triangles triangles, const AffineMap& pose = {}, bool isFlattened = false)
{
  return { std::make_shared<RigidObject>(TriangleMesh(std::move(triangles))), nullptr, pose,
    isFlattened };
}

Triangles randomTriangles(std::size_t count, unsigned seed)
{
  std::mt19937_64 generator(seed);
  const auto inCube = [&](double edge) {
    std::uniform_real_distribution<double> coordinate(-0.5 * edge, 0.5 * edge);
    const double x = coordinate(generator), y = coordinate(generator);
    return Vector3(x, y, coordinate(generator));
  };
  // Two points in a cube are 0.66 of its edge apart on average.
  constexpr double kSpread = 0.3 / 0.66;
  Triangles triangles;
  while (triangles.size() < count)
  {
    const Vector3 center = inCube(10);
    triangles.push_back(
      { center + inCube(kSpread), center + inCube(kSpread), center + inCube(kSpread) });
  }
  return triangles;
}

}

std::optional<BenchmarkScene> makeBunnyScene()
{
  if (!hasMesh("bunny.off") || !hasMesh("teapot.off"))
  {
    return {};
  }
  Triangles fixed = makeWalls();
  const std::size_t walls = fixed.size();
  append(readMesh("bunny.off", 3.5), { Matrix3::Identity(), { -1.5, 1, 0 } }, fixed);
  return BenchmarkScene{ "bunny and teapot",
    { makeObject(std::move(fixed)),
      { makeObject(readMesh("teapot.off", 3), makePose(0.7, { 1.8, -1, 3 })) } },
    { { 0, 0, 9.9 }, 1 }, walls };
}

std::optional<BenchmarkScene> makeDragonScene()
{
  if (!hasMesh("stanford-dragon.ply"))
  {
    return {};
  }
  Triangles walls = makeWalls();
  const std::size_t count = walls.size();
  return BenchmarkScene{ "dragon",
    { makeObject(std::move(walls)),
      { makeObject(readMesh("stanford-dragon.ply", 6), makePose(0.5, { 0.2, 0.1, 2 })) } },
    { { 0, 0, 9.9 }, 1 }, count };
}

BenchmarkScene makeRandomScene(bool isFlattened)
{
  return { "random triangles",
    { makeObject(randomTriangles(50000, 1)),
      { makeObject(randomTriangles(50000, 2), makePose(0.3, Vector3::Zero()), isFlattened) } },
    { { 0, 0, 5.1 }, 5 } };
}

BenchmarkScene makeTeapotsScene()
{
  const Triangles teapot = trianglesOf(
    movingteapot::FitMesh(movingteapot::MakeUtahTeapot(40), { -1.5, 1.5, -1.5, 1.5, 0, 3 }));
  Triangles fixed = { { { -5, -5, 0 }, { 5, -5, 0 }, { 5, 5, 0 } },
    { { -5, -5, 0 }, { 5, 5, 0 }, { -5, 5, 0 } } };
  const std::size_t floor = fixed.size();
  std::vector<SceneObject> moving;
  for (int i = 0; i < 3; ++i)
  {
    const double angle = 2 * M_PI / 3 * i;
    append(teapot, makePose(angle, { 2 * std::cos(angle), 2 * std::sin(angle), 0.2 }), fixed);
    moving.push_back(makeObject(
      teapot, makePose(-angle, { 2 * std::cos(angle + 1), 2 * std::sin(angle + 1), 1.2 }), true));
  }
  return { "teapots", { makeObject(std::move(fixed)), std::move(moving) }, { { 0, 0, 8 }, 1 },
    floor };
}

SceneObjects flattened(const SceneObjects& objects)
{
  Triangles all = objects.staticObject.body->mesh().triangles();
  for (const SceneObject& object : objects.dynamicObjects)
  {
    append(object.body->mesh().triangles(), object.worldFromObject, all);
  }
  return { makeObject(std::move(all)), {} };
}

Box boundsOf(const SceneObjects& objects)
{
  Box bounds = objects.staticObject.body->mesh().bounds();
  for (const SceneObject& object : objects.dynamicObjects)
  {
    for (const Triangle& triangle : object.body->mesh().triangles())
    {
      bounds.add(transformed(object.worldFromObject, triangle).bounds());
    }
  }
  return bounds;
}
