#include "SceneReader.h"

#include "InputError.h"

#include "vtkDataArray.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <utility>

namespace irradiance
{

namespace
{

vtkDataArray* asNumbers(vtkAbstractArray* array, const std::string& where)
{
  vtkDataArray* numbers = vtkDataArray::SafeDownCast(array);
  if (array && !numbers)
  {
    throw InputError(where + ": the array " + array->GetName() + " is a " + array->GetClassName() +
      ", not numbers");
  }
  return numbers;
}

/// A finite map can take finite points to where squares and volumes are not finite.
void checkReach(const std::string& where, const AffineMap& map, const Box& box)
{
  if (box.isEmpty())
  {
    return;
  }
  const double reach =
    (map.linear.cwiseAbs() * box.lower.cwiseAbs().cwiseMax(box.upper.cwiseAbs()) +
      map.translation.cwiseAbs())
      .maxCoeff();
  if (!(reach <= PolyDataConverter::kMostDistant))
  {
    throw InputError(where + ": the transform takes points out of range, to " + text(reach) + " m");
  }
}

/// Positions are kept in double, and rays start clear of surfaces by 2^-33 of the largest coordinate.
void checkDigits(const SceneObjects& objects)
{
  constexpr double kFarthest = 0x1p27; // in sizes of the scene
  Box scene = objects.fixed.body->mesh().bounds();
  for (const SceneObject& object : objects.dynamic)
  {
    const Box& model = object.body->mesh().bounds();
    if (!model.isEmpty())
    {
      const AffineMap& map = object.worldFromObject;
      const Vector3 center = map(model.center());
      const Vector3 reach = 0.5 * map.linear.cwiseAbs() * model.extent();
      scene.add(Box{ center - reach, center + reach });
    }
  }
  const double size = scene.isEmpty() ? 0.0 : scene.extent().maxCoeff();
  if (scene.magnitude() > kFarthest * size)
  {
    throw InputError("the scene is " + text(size) + " m large and " + text(scene.magnitude()) +
      " m away from the origin: too far for its size, as positions there have too few digits");
  }
}

void append(ConvertedPolyData& all, const ConvertedPolyData& part)
{
  const auto firstCell = static_cast<std::uint32_t>(all.surface.numberOfCells);
  const auto& from = part.surface;
  auto& to = all.surface;
  all.triangles.insert(all.triangles.end(), part.triangles.begin(), part.triangles.end());
  std::transform(from.cellOfTriangle.begin(), from.cellOfTriangle.end(),
    std::back_inserter(to.cellOfTriangle),
    [firstCell](std::uint32_t cell) { return firstCell + cell; });
  to.reflectance.insert(to.reflectance.end(), from.reflectance.begin(), from.reflectance.end());
  if (!from.exitance.empty())
  {
    to.exitance.resize(to.numberOfCells * static_cast<std::size_t>(to.bands), 0.0);
    to.exitance.insert(to.exitance.end(), from.exitance.begin(), from.exitance.end());
  }
  to.pointLights.insert(to.pointLights.end(), from.pointLights.begin(), from.pointLights.end());
  to.numberOfCells += from.numberOfCells;
  if (!to.exitance.empty())
  {
    to.exitance.resize(to.numberOfCells * static_cast<std::size_t>(to.bands), 0.0);
  }
}

}

SceneReader::Stamp SceneReader::stampOf(const InputConnection& connection)
{
  return { connection.polyData, { connection.exitance, connection.reflectance, connection.flux },
    connection.polyData->GetMTime() };
}

int SceneReader::countBands(
  const std::vector<InputConnection>& fixed, const std::vector<InputConnection>& moving)
{
  int bands = 1;
  for (const auto* connections : { &fixed, &moving })
  {
    for (const InputConnection& c : *connections)
    {
      for (vtkAbstractArray* array : { c.exitance, c.reflectance, c.flux })
      {
        bands = array && array->GetNumberOfComponents() == 3 ? 3 : bands;
      }
    }
  }
  return bands;
}

void SceneReader::read(const std::vector<InputConnection>& fixed,
  const std::vector<InputConnection>& moving, const std::vector<AffineMap>& poses,
  double defaultReflectance, const Checkpoint& checkpoint)
{
  const Settings settings{ countBands(fixed, moving), defaultReflectance };
  if (settings != settings_)
  {
    fixedStamps_.reset();
    movingStamps_.clear();
    settings_ = settings;
  }
  movingStamps_.resize(moving.size());
  objects_.dynamic.resize(moving.size());
  areas_.resize(moving.size() + 1);
  readFixed(fixed, checkpoint);
  for (std::size_t i = 0; i < moving.size(); ++i)
  {
    readMoving(moving[i], i, checkpoint);
    checkReach(moving[i].name, poses[i], objects_.dynamic[i].body->mesh().bounds());
    objects_.dynamic[i].worldFromObject = poses[i];
    areas_[i + 1] = cellAreas(objects_.dynamic[i]);
  }
  checkDigits(objects_);
}

ConvertedPolyData SceneReader::convert(const InputConnection& connection)
{
  SurfaceArrays arrays;
  arrays.exitance = asNumbers(connection.exitance, connection.name);
  arrays.reflectance = asNumbers(connection.reflectance, connection.name);
  arrays.flux = asNumbers(connection.flux, connection.name);
  arrays.defaultReflectance = settings_.defaultReflectance;
  ConvertedPolyData data =
    PolyDataConverter(connection.name, connection.polyData, arrays, settings_.bands).convert();
  if (data.cellsWithoutArea > 0)
  {
    warn(connection.name + ": " + std::to_string(data.cellsWithoutArea) +
      " cells have no area, the first is cell " + std::to_string(data.firstCellWithoutArea) +
      "; their irradiance is 0");
  }
  if (data.crossedCells > 0)
  {
    warn(connection.name + ": " + std::to_string(data.crossedCells) +
      " polygons cross themselves, the first is cell " + std::to_string(data.firstCrossedCell) +
      "; what lies inside them is not clear");
  }
  return data;
}

void SceneReader::readFixed(const std::vector<InputConnection>& fixed, const Checkpoint& checkpoint)
{
  std::vector<Stamp> stamps;
  std::transform(fixed.begin(), fixed.end(), std::back_inserter(stamps), stampOf);
  if (fixedStamps_ == stamps)
  {
    return;
  }
  fixedStamps_.reset(); // until all is read
  firstCell_.clear();
  ConvertedPolyData all;
  all.surface.bands = settings_.bands;
  for (const InputConnection& connection : fixed)
  {
    firstCell_.push_back(all.surface.numberOfCells);
    append(all, convert(connection));
  }
  adopt(std::move(all), objects_.fixed, checkpoint);
  areas_[0] = cellAreas(objects_.fixed);
  fixedStamps_ = std::move(stamps);
}

void SceneReader::readMoving(
  const InputConnection& connection, std::size_t index, const Checkpoint& checkpoint)
{
  const Stamp stamp = stampOf(connection);
  if (!(movingStamps_[index] == stamp))
  {
    movingStamps_[index].reset(); // until all is read
    adopt(convert(connection), objects_.dynamic[index], checkpoint);
    movingStamps_[index] = stamp;
  }
}

/// Equal values keep the old object, and with it its tree, its ellipsoid and the stored walks.
void SceneReader::adopt(ConvertedPolyData data, SceneObject& object, const Checkpoint& checkpoint)
{
  if (!object.surface || !(*object.surface == data.surface))
  {
    object.surface = std::make_shared<Surface>(std::move(data.surface));
  }
  if (!object.body || object.body->mesh().triangles() != data.triangles)
  {
    object.body =
      std::make_shared<RigidObject>(TriangleMesh(std::move(data.triangles)), checkpoint);
  }
}

/// What was read before an error is read, and reported, once more.
void SceneReader::warn(const std::string& warning)
{
  if (std::find(warnings_.begin(), warnings_.end(), warning) == warnings_.end())
  {
    warnings_.push_back(warning);
  }
}

std::vector<std::string> SceneReader::takeWarnings()
{
  return std::exchange(warnings_, {});
}

}
