#include "TradeScene.h"

#include "MovingTeapotScene.h"
#include "TeapotScene.h"

#include "../PhotonWalks/TestScenes.h"
#include "../RayCasting/RandomVectors.h"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkQuadricDecimation.h>
#include <vtkTriangleFilter.h>

#include <algorithm>
#include <numeric>

using namespace irradiance;

namespace
{

vtkSmartPointer<vtkPolyData> decimated(vtkPolyData* mesh, double kept)
{
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(mesh);
  vtkNew<vtkQuadricDecimation> decimation;
  decimation->SetInputConnection(triangles->GetOutputPort());
  decimation->SetTargetReduction(1 - kept);
  decimation->Update();
  vtkSmartPointer<vtkPolyData> small = decimation->GetOutput();
  const double reflectance = mesh->GetCellData()->GetArray("DiffuseReflectance")->GetTuple1(0);
  vtkNew<vtkDoubleArray> reflectances;
  reflectances->SetName("DiffuseReflectance");
  reflectances->SetNumberOfValues(small->GetNumberOfCells());
  reflectances->Fill(reflectance);
  small->GetCellData()->AddArray(reflectances);
  return small;
}

/// A look for each triangle: that of the cell it belongs to.
std::shared_ptr<const Material> withTrianglesAsCells(const Material& material)
{
  Material cut = surface;
  cut.numberOfCells = material.cellOfTriangle.size();
  cut.reflectance.clear();
  cut.exitance.clear();
  const auto bands = static_cast<std::size_t>(material.bands);
  for (const std::uint32_t cell : material.cellOfTriangle)
  {
    for (std::size_t band = 0; band < bands; ++band)
    {
      cut.reflectance.push_back(material.reflectance[cell * bands + band]);
      if (!material.exitance.empty())
      {
        cut.exitance.push_back(material.exitance[cell * bands + band]);
      }
    }
  }
  std::iota(cut.cellOfTriangle.begin(), cut.cellOfTriangle.end(), 0u);
  return std::make_shared<const Material>(std::move(cut));
}

template <class Change>
void changeAll(SceneObjects& objects, const Change& change)
{
  change(objects.staticObject);
  std::for_each(objects.dynamicObjects.begin(), objects.dynamicObjects.end(), change);
}

void makeTrianglesCells(SceneObjects& objects)
{
  changeAll(
    objects, [](SceneObject& object) { object.material = withTrianglesAsCells(*object.material); });
}

TradeScene makeTeapot(const std::string& head)
{
  constexpr double kKept = 0.08; // some 2000 triangles of the head
  movingteapot::SceneConfig config;
  config.CellSize = 0.2;
  config.TeapotSegments = 4;
  config.HeadFile = head;
  movingteapot::TeapotScene parts = movingteapot::MakeTeapotScene(config);
  parts.Head = decimated(parts.Head, kKept);
  const MovingTeapotScene scene(parts);
  TradeScene trade{ "teapot", scene.objectsAt(0), {}, { 4, 4 } };
  makeTrianglesCells(trade.objects);
  trade.place = [scene](SceneObjects& objects, double time) {
    objects.dynamicObjects[0].worldFromObject =
      scene.objectsAt(time).dynamicObjects[0].worldFromObject;
  };
  return trade;
}

/// Round the middle of a room, turning.
AffineMap poseOnCircle(const Vector3& middle, double radius, double time)
{
  const double angle = 2 * M_PI * time;
  return { Eigen::AngleAxisd(angle, Vector3(1, 2, 2) / 3).toRotationMatrix(),
    middle + radius * Vector3(std::cos(angle), std::sin(angle), 0) };
}

TradeScene makeBox()
{
  test::ObjectBuilder room, thing;
  room.addBox(test::box({ 0, 0, 0 }, { 4, 4, 4 }), 6, test::grey(0.5), true);
  room.addQuad({ 1, 1, 3.75 }, { 0, 2, 0 }, { 2, 0, 0 }, 4, 4, test::grey(0.5, 100));
  thing.addBox(test::box({ -0.5, -0.4, -0.3 }, { 0.5, 0.4, 0.3 }), 2, test::grey(0.7));
  thing.material().exitance.clear();
  TradeScene trade{ "box", { room.build(), { thing.build() } },
    [](SceneObjects& objects, double time) {
      objects.dynamicObjects[0].worldFromObject = poseOnCircle({ 2, 2, 2 }, 1, time);
    },
    { 4, 4 } };
  makeTrianglesCells(trade.objects);
  return trade;
}

/// Each wall cell shines with 1 - its reflectance. What reflects all light emits none, so that it may
/// move without a change of the lights.
TradeScene makeFurnace()
{
  test::RandomVectors random(91);
  test::ObjectBuilder room, thing;
  room.addBox(test::box({ 0, 0, 0 }, { 4, 3, 5 }), 4, {}, true);
  Material& walls = room.material();
  for (std::size_t cell = 0; cell < walls.numberOfCells; ++cell)
  {
    walls.reflectance[cell] = random.uniform(0, 0.9);
    walls.exitance[cell] = 1 - walls.reflectance[cell];
  }
  thing.addSphere({ 0, 0, 0 }, 0.6, 6, test::grey(1));
  thing.material().exitance.clear();
  TradeScene trade{ "furnace", { room.build(), { thing.build() } },
    [](SceneObjects& objects, double time) {
      objects.dynamicObjects[0].worldFromObject = poseOnCircle({ 2, 1.5, 2.5 }, 0.7, time);
    },
    { 6, 3 }, true };
  makeTrianglesCells(trade.objects);
  return trade;
}

std::vector<Triangle> quartered(const std::vector<Triangle>& triangles)
{
  std::vector<Triangle> pieces;
  for (const Triangle& t : triangles)
  {
    const Vector3 ab = 0.5 * (t.a + t.b), bc = 0.5 * (t.b + t.c), ca = 0.5 * (t.c + t.a);
    pieces.insert(
      pieces.end(), { { t.a, ab, ca }, { ab, t.b, bc }, { ca, bc, t.c }, { bc, ca, ab } });
  }
  return pieces;
}

SceneObject quartered(const SceneObject& object)
{
  SceneObject cut = object;
  cut.body =
    std::make_shared<RigidObject>(TriangleMesh(quartered(object.body->mesh().triangles())));
  Material material = *object.material;
  material.cellOfTriangle.clear();
  for (const std::uint32_t cell : object.material->cellOfTriangle)
  {
    material.cellOfTriangle.insert(material.cellOfTriangle.end(), 4, cell);
  }
  cut.material = withTrianglesAsCells(surface);
  return cut;
}

}

std::vector<TradeScene> makeTradeScenes(const std::string& head)
{
  return { makeTeapot(head), makeBox(), makeFurnace() };
}

SceneObjects subdivided(const SceneObjects& objects, int levels)
{
  SceneObjects cut = objects;
  for (int level = 0; level < levels; ++level)
  {
    changeAll(cut, [](SceneObject& object) { object = quartered(object); });
  }
  return cut;
}
