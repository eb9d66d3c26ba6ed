#include "MovingTeapotScene.h"

#include "SceneReader.h"
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

InputConnection connect(vtkPolyData* polyData, const AffineMap& worldFromPart = {})
{
  InputPart part;
  part.name = "part of the scene";
  part.polyData = polyData;
  part.exitance = polyData->GetCellData()->GetAbstractArray(kExitanceArray.defaultName);
  part.reflectance = polyData->GetCellData()->GetAbstractArray(kReflectanceArray.defaultName);
  part.worldFromPart = worldFromPart;
  return { part.name, polyData, { part } };
}

movingteapot::TeapotScene partsWith(const std::string& head)
{
  movingteapot::SceneConfig config;
  config.HeadFile = head;
  return movingteapot::MakeTeapotScene(config);
}

}

MovingTeapotScene::MovingTeapotScene(const std::string& head, double scale)
  : MovingTeapotScene(partsWith(head), scale)
{
}

MovingTeapotScene::MovingTeapotScene(const movingteapot::TeapotScene& parts, double scale)
  : scale_(scale)
{
  std::vector<InputConnection> fixed;
  for (vtkPolyData* part :
    { parts.Room.Get(), parts.Lamp.Get(), parts.Plinth.Get(), parts.Head.Get() })
  {
    if (part)
    {
      fixed.push_back(connect(part));
    }
  }
  SceneReader reader;
  reader.read(fixed, { connect(parts.Teapot, poseAt(0, scale)) }, 0.5, {});
  objects_ = reader.objects();
}

SceneObjects MovingTeapotScene::objectsAt(double time) const
{
  SceneObjects objects = objects_;
  objects.dynamicObjects[0].worldFromObject = poseAt(time, scale_);
  return objects;
}
