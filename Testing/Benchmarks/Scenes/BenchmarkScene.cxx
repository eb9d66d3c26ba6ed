// SPDX-License-Identifier: BSD-3-Clause
#include "Scenes/BenchmarkScene.h"

#include "../../PhotonWalks/TestScenes.h"
#include "Meshes.h"
#include "Scenes/PolyDataObject.h"

#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <random>
#include <utility>

using namespace irradiance;

namespace
{

using Triangles = std::vector<Triangle>;

std::string meshPath(const std::string& name)
{
  return VTKIRRADIANCE_DATA_DIR "/downloaded/" + name;
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

SceneObject makeBody(Triangles triangles, const AffineMap& pose = {}, bool isFlattened = false)
{
  return { { std::make_shared<RigidObject>(TriangleMesh(std::move(triangles))), pose, isFlattened },
    nullptr };
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

/// Some consecutive triangles make a cell. The last cell may have fewer.
void addCells(const TriangleMesh& mesh, std::size_t trianglesInCell, test::ObjectBuilder& object)
{
  const test::Look look = test::grey(0.5);
  for (std::size_t first = 0; first < mesh.size(); first += trianglesInCell)
  {
    std::vector<Triangle> cell;
    for (std::size_t i = first; i < std::min(first + trianglesInCell, mesh.size()); ++i)
    {
      cell.push_back(mesh[i]);
    }
    object.addCell(cell, look);
  }
}

}

std::optional<BenchmarkScene> makeRoomScene(bool isLarge)
{
  for (const char* mesh : { "bunny.off", "teapot.off", "stanford-dragon.ply" })
  {
    if (!std::filesystem::exists(meshPath(mesh)))
    {
      return {};
    }
  }
  const movingteapot::SideReflectances all = { 0.5, 0.5, 0.5, 0.5, 0.5, 0.5 };
  Triangles fixed = trianglesOf(
    movingteapot::MakeGridBox({ -5, 5, -5, 5, 0, 10 }, 0.25, movingteapot::Facing::Inward, all));
  const std::size_t walls = fixed.size();
  if (!isLarge)
  {
    append(readMesh("bunny.off", 3.5), { Matrix3::Identity(), { -1.5, 1, 0 } }, fixed);
  }
  SceneObject moving = isLarge
    ? makeBody(readMesh("stanford-dragon.ply", 6), makePose(0.5, { 0.2, 0.1, 2 }))
    : makeBody(readMesh("teapot.off", 3), makePose(0.7, { 1.8, -1, 3 }));
  return BenchmarkScene{ isLarge ? "dragon" : "bunny and teapot",
    { makeBody(std::move(fixed)), { std::move(moving) } }, { { 0, 0, 9.9 }, 1 }, walls };
}

std::optional<SceneObjects> makeDragonRoom()
{
  const std::optional<BenchmarkScene> scene = makeRoomScene(true);
  if (!scene)
  {
    return {};
  }
  test::ObjectBuilder room, dragon;
  addCells(scene->objects.staticObject.body->mesh(), 2, room);
  const auto& [center, edge] = scene->light;
  const Vector3 corner = center - 0.5 * edge * Vector3(1, 1, 0);
  room.addQuad(corner, { 0, edge, 0 }, { edge, 0, 0 }, 2, 2, test::grey(0.5, 100));
  const SceneObject& body = scene->objects.dynamicObjects[0];
  addCells(body.body->mesh(), 1, dragon);
  return SceneObjects{ room.build(), { dragon.build(body.worldFromObject) } };
}

BenchmarkScene makeRandomScene(bool isFlattened)
{
  return { "random triangles",
    { makeBody(randomTriangles(50000, 1)),
      { makeBody(randomTriangles(50000, 2), makePose(0.3, Vector3::Zero()), isFlattened) } },
    { { 0, 0, 5.1 }, 5 } };
}

BenchmarkScene makeTeapotsScene()
{
  const Triangles teapot = trianglesOf(
    movingteapot::FitMesh(movingteapot::MakeUtahTeapot(40), { -1.5, 1.5, -1.5, 1.5, 0, 3 }));
  Triangles fixed = { { { -5, -5, 0 }, { 5, -5, 0 }, { 5, 5, 0 } },
    { { -5, -5, 0 }, { 5, 5, 0 }, { -5, 5, 0 } } };
  std::vector<SceneObject> moving;
  for (int i = 0; i < 3; ++i)
  {
    const double angle = 2 * M_PI / 3 * i;
    append(teapot, makePose(angle, { 2 * std::cos(angle), 2 * std::sin(angle), 0.2 }), fixed);
    moving.push_back(makeBody(
      teapot, makePose(-angle, { 2 * std::cos(angle + 1), 2 * std::sin(angle + 1), 1.2 }), true));
  }
  return { "teapots", { makeBody(std::move(fixed)), std::move(moving) }, { { 0, 0, 8 }, 1 } };
}

Triangles worldTriangles(const SceneObjects& objects)
{
  Triangles all;
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    append(objects[i].body->mesh().triangles(), objects[i].worldFromObject, all);
  }
  return all;
}

SceneObjects flattened(const SceneObjects& objects)
{
  return { makeBody(worldTriangles(objects)), {} };
}
