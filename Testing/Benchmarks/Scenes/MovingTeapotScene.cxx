// SPDX-License-Identifier: BSD-3-Clause
#include "Scenes/MovingTeapotScene.h"

#include "../../FiltersIrradiance/TestScenes.h"
#include "Scenes/PolyDataObject.h"
#include "TeapotScene.h"

#include <vtkQuadricDecimation.h>
#include <vtkTriangleFilter.h>

using namespace irradiance;

namespace
{

AffineMap poseAt(double time, double scale)
{
  static movingteapot::TeapotPath path;
  vtkNew<vtkTransform> transform;
  path.SetPose(time, transform);
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> matrix(
    transform->GetMatrix()->GetData());
  return { scale * matrix.topLeftCorner<3, 3>(), matrix.topRightCorner<3, 1>() };
}

/// Of one material, like the mesh.
vtkSmartPointer<vtkPolyData> decimated(vtkPolyData* mesh, double kept)
{
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(mesh);
  vtkNew<vtkQuadricDecimation> decimation;
  decimation->SetInputConnection(triangles->GetOutputPort());
  decimation->SetTargetReduction(1 - kept);
  decimation->Update();
  vtkSmartPointer<vtkPolyData> small = decimation->GetOutput();
  const char* const reflectance = "DiffuseReflectance";
  TestScenes::SetCellValues(
    small, reflectance, { mesh->GetCellData()->GetArray(reflectance)->GetTuple1(0) });
  return small;
}

}

MovingScene makeMovingTeapot(const std::string& head, double scale, bool isCoarse)
{
  movingteapot::SceneConfig config;
  config.HeadFile = head;
  if (isCoarse)
  {
    config.CellSize = 0.2;
    config.TeapotSegments = 4;
  }
  movingteapot::TeapotScene parts = movingteapot::MakeTeapotScene(config);
  std::vector<vtkPolyData*> fixed = { parts.Room, parts.Lamp, parts.Plinth };
  if (parts.Head)
  {
    constexpr double kKept = 0.08;
    parts.Head = isCoarse ? decimated(parts.Head, kKept) : parts.Head;
    fixed.push_back(parts.Head);
  }
  return { "teapot", { makeObject(fixed), { makeObject({ parts.Teapot }) } },
    [scale](SceneObjects& objects, double time) {
      objects.dynamicObjects[0].worldFromObject = poseAt(time, scale);
    } };
}
