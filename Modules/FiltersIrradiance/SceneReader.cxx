#include "SceneReader.h"

#include "Geometry/MovedBox.h"
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

bool isEqual(
  const std::vector<Triangle>& a, const std::vector<Triangle>& b, const Checkpoint& checkpoint)
{
  CheckpointPace pace(checkpoint);
  bool isEqual = a.size() == b.size();
  for (std::size_t i = 0; isEqual && i < a.size(); ++i)
  {
    isEqual = a[i] == b[i];
    pace.step();
  }
  return isEqual;
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
    scene.add(movedBox(object.worldFromObject, object.body->mesh().bounds()));
  }
  const double size = scene.isEmpty() ? 0.0 : scene.extent().maxCoeff();
  if (scene.magnitude() > kFarthest * size)
  {
    throw InputError("the scene is " + text(size) + " m large and " + text(scene.magnitude()) +
      " m away from the origin: too far for its size, as positions there have too few digits");
  }
}

}

SceneReader::Parts SceneReader::partsOf(const std::vector<InputConnection>& connections)
{
  Parts parts;
  for (const InputConnection& connection : connections)
  {
    for (const InputPart& part : connection.parts)
    {
      parts.push_back(&part);
    }
  }
  return parts;
}

SceneReader::Stamp SceneReader::stampOf(const InputPart& part)
{
  return { part.polyData, { part.exitance, part.reflectance, part.flux },
    part.polyData->GetMTime() };
}

int SceneReader::countBands(const Parts& parts)
{
  int bands = 1;
  for (const InputPart* part : parts)
  {
    for (vtkAbstractArray* array : { part->exitance, part->reflectance, part->flux })
    {
      bands = array && array->GetNumberOfComponents() == 3 ? 3 : bands;
    }
  }
  return bands;
}

void SceneReader::read(const std::vector<InputConnection>& fixedConnections,
  const std::vector<InputConnection>& movingConnections, double defaultReflectance,
  const Checkpoint& checkpoint)
{
  const Parts fixed = partsOf(fixedConnections), moving = partsOf(movingConnections);
  const Settings settings{ std::max(countBands(fixed), countBands(moving)), defaultReflectance };
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
    readMoving(*moving[i], i, checkpoint);
    SceneObject& object = objects_.dynamic[i];
    checkReach(moving[i]->name, moving[i]->worldFromPart, object.body->mesh().bounds());
    object.worldFromObject = moving[i]->worldFromPart;
    areas_[i + 1] = cellAreas(object, checkpoint);
  }
  checkDigits(objects_);
}

void SceneReader::convert(
  const InputPart& part, ConvertedPolyData& target, const Checkpoint& checkpoint)
{
  SurfaceArrays arrays;
  arrays.exitance = asNumbers(part.exitance, part.name);
  arrays.reflectance = asNumbers(part.reflectance, part.name);
  arrays.flux = asNumbers(part.flux, part.name);
  arrays.defaultReflectance = settings_.defaultReflectance;
  for (const auto& oddities : { part.oddities,
         PolyDataConverter(part.name, part.polyData, arrays, target, checkpoint).convert() })
  {
    for (const std::string& oddity : oddities)
    {
      warn(oddity);
    }
  }
}

void SceneReader::readFixed(const Parts& fixed, const Checkpoint& checkpoint)
{
  std::vector<Stamp> stamps;
  std::transform(fixed.begin(), fixed.end(), std::back_inserter(stamps),
    [](const InputPart* part) { return stampOf(*part); });
  if (fixedStamps_ == stamps)
  {
    return;
  }
  fixedStamps_.reset(); // until all is read
  firstCell_.clear();
  ConvertedPolyData all;
  all.surface.bands = settings_.bands;
  for (const InputPart* part : fixed)
  {
    firstCell_.push_back(all.surface.numberOfCells);
    all.surface.firstCellOfPart = firstCell_;
    convert(*part, all, checkpoint);
  }
  adopt(std::move(all), objects_.fixed, false, checkpoint);
  areas_[0] = cellAreas(objects_.fixed, checkpoint);
  fixedStamps_ = std::move(stamps);
}

void SceneReader::readMoving(const InputPart& part, std::size_t index, const Checkpoint& checkpoint)
{
  const Stamp stamp = stampOf(part);
  if (!(movingStamps_[index] == stamp))
  {
    movingStamps_[index].reset(); // until all is read
    ConvertedPolyData data;
    data.surface.bands = settings_.bands;
    convert(part, data, checkpoint);
    adopt(std::move(data), objects_.dynamic[index], true, checkpoint);
    movingStamps_[index] = stamp;
  }
}

/// Equal values keep the old object, and with it its tree, its ellipsoid and the stored walks.
void SceneReader::adopt(
  ConvertedPolyData data, SceneObject& object, bool mayMove, const Checkpoint& checkpoint)
{
  if (!object.surface || !(*object.surface == data.surface))
  {
    object.surface = std::make_shared<Surface>(std::move(data.surface));
  }
  if (!object.body || !isEqual(object.body->mesh().triangles(), data.triangles, checkpoint))
  {
    object.body = std::make_shared<RigidObject>(
      TriangleMesh(std::move(data.triangles), checkpoint), checkpoint, mayMove);
    if (checkpoint)
    {
      checkpoint(); // to give back the memory of building takes a while
    }
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
