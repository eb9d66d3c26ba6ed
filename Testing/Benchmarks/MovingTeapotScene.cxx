#include "MovingTeapotScene.h"

#include "SceneReader.h"
#include "TeapotPath.h"
#include "TeapotScene.h"

#include <vtkCellData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkTransform.h>

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

InputConnection connect(vtkPolyData* part)
{
  vtkCellData* cells = part->GetCellData();
  return { "part of the scene", part, cells->GetAbstractArray("RadiantExitance"),
    cells->GetAbstractArray("DiffuseReflectance"), nullptr };
}

}

MovingTeapotScene::MovingTeapotScene(const std::string& head, double scale)
  : scale_(scale)
{
  movingteapot::SceneConfig config;
  config.HeadFile = head;
  const movingteapot::TeapotScene scene = movingteapot::MakeTeapotScene(config);
  std::vector<InputConnection> fixed;
  for (vtkPolyData* part :
    { scene.Room.Get(), scene.Lamp.Get(), scene.Plinth.Get(), scene.Head.Get() })
  {
    if (part)
    {
      fixed.push_back(connect(part));
    }
  }
  SceneReader reader;
  reader.read(fixed, { connect(scene.Teapot) }, { poseAt(0, scale) }, 0.5, {});
  objects_ = reader.objects();
}

SceneObjects MovingTeapotScene::objectsAt(double time) const
{
  SceneObjects objects = objects_;
  objects.dynamic[0].worldFromObject = poseAt(time, scale_);
  return objects;
}
