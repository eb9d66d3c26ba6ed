// SPDX-License-Identifier: BSD-3-Clause
#include "Input/SceneReader.h"

#include "Input/LuminaireFields.h"
#include "Input/SkyFields.h"
#include "Progress/InputError.h"

#include "vtkDataArray.h"

#include <algorithm>
#include <utility>

namespace irradiance
{

namespace
{

vtkDataArray* asNumbers(vtkAbstractArray* array, const std::string& where)
{
  vtkDataArray* numbers = vtkDataArray::SafeDownCast(array);
  throwIf(array && !numbers, where, ": the array ", array ? array->GetName() : "", " is a ",
    array ? array->GetClassName() : "", ", not numbers");
  return numbers;
}

bool isEqual(
  const std::vector<Triangle>& a, const std::vector<Triangle>& b, const CancelPoint& cancelPoint)
{
  ThrottledCancelPoint pace(cancelPoint);
  return std::equal(
    a.begin(), a.end(), b.begin(), b.end(), [&](const auto& one, const auto& other) {
      pace.step();
      return one == other;
    });
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
  throwIf(
    !(reach <= kMostDistant), where, ": the transform takes points out of range, to ", reach, " m");
}

/// Nothing may stand where the light of a sky does not reach it.
void checkLit(const std::string& where, const SceneObjects& objects, const SceneObject& object)
{
  const Box bounds = object.worldBounds();
  Box both = bounds;
  if (objects.sky && !bounds.isEmpty())
  {
    both.add(objects.sky->lit);
    throwIf(both.lower != objects.sky->lit.lower || both.upper != objects.sky->lit.upper, where,
      ": leaves the box that the sky lights; set SkyBounds (Bounds of vtkSunSkySource), so that it "
      "holds all of the scene wherever it moves");
  }
}

/// Positions are doubles, and rays start 2^-33 of the largest coordinate off the surface.
void checkDigits(const SceneObjects& objects)
{
  constexpr double kFarthest = 0x1p27; // in sizes of the scene
  Box scene = objects.staticObject.body->mesh().bounds();
  for (const SceneObject& object : objects.dynamicObjects)
  {
    scene.add(object.worldBounds());
  }
  const double size = scene.size();
  throwIf(scene.magnitude() > kFarthest * size, "the scene is ", size, " m large and ",
    scene.magnitude(),
    " m away from the origin: too far for its size, as positions there have too few digits");
}

}

SceneReader::Stamp SceneReader::stampOf(const InputPart& part)
{
  vtkPolyData* origin = originOfGeometry(part.polyData);
  return { origin, part.arrays, origin->GetMTime(), part.worldFromPart.linear.determinant() < 0 };
}

int SceneReader::countBands(const SceneInputs& inputs)
{
  int bands = 1;
  for (const InputPart* part : allPartsOf(inputs))
  {
    bands = std::max({ bands, bandsOfLuminaires(part->polyData), bandsOfSky(part->polyData) });
    for (std::size_t i = 0; i < part->arrays.size(); ++i)
    {
      vtkAbstractArray* array = part->arrays[i];
      bands = i != Exponent && array && array->GetNumberOfComponents() == 3 ? 3 : bands;
    }
  }
  return bands;
}

void SceneReader::read(
  const SceneInputs& inputs, double defaultReflectance, const CancelPoint& cancelPoint)
{
  const auto staticParts = partsOf(inputs.statics), dynamicParts = partsOf(inputs.dynamics);
  const int bands = countBands(inputs);
  if (bands != bands_ || defaultReflectance != defaultReflectance_)
  {
    staticStamps_.reset();
    dynamicStamps_.clear();
    bands_ = bands;
    defaultReflectance_ = defaultReflectance;
  }
  hasNews_ = hasNews_ || dynamicStamps_.size() != dynamicParts.size();
  dynamicStamps_.resize(dynamicParts.size());
  objects_.dynamicObjects.resize(dynamicParts.size());
  readStatic(staticParts, cancelPoint);
  for (std::size_t i = 0; i < dynamicParts.size(); ++i)
  {
    readDynamic(*dynamicParts[i], i, cancelPoint);
    SceneObject& object = objects_.dynamicObjects[i];
    object.worldFromObject = dynamicParts[i]->worldFromPart;
    if (object.isPresent)
    {
      checkReach(dynamicParts[i]->name, object.worldFromObject, object.body->mesh().bounds());
      checkLit(dynamicParts[i]->name, objects_, object);
    }
  }
  lampGroups_.readFactors(inputs, bands_);
  checkDigits(objects_);
  flattenManySmall(objects_);
}

void SceneReader::convert(
  const InputPart& part, ConvertedPolyData& target, const CancelPoint& cancelPoint)
{
  hasNews_ = true;
  const std::size_t firstCell = target.material.numberOfCells;
  MaterialArrays<vtkDataArray> arrays;
  std::transform(part.arrays.begin(), part.arrays.end(), arrays.begin(),
    [&](vtkAbstractArray* array) { return asNumbers(array, part.name); });
  for (const auto& warnings :
    { part.warnings,
      convertPolyData(part.name, part.polyData, arrays, defaultReflectance_, target, cancelPoint) })
  {
    for (const InputWarning& warning : warnings)
    {
      warnings_.add(warning);
    }
  }
  lampGroups_.read(part, firstCell, target);
}

void SceneReader::readStatic(
  const std::vector<const InputPart*>& staticParts, const CancelPoint& cancelPoint)
{
  std::vector<Stamp> stamps;
  std::vector<vtkPolyData*> inputs;
  for (const InputPart* part : staticParts)
  {
    stamps.push_back(stampOf(*part));
    inputs.push_back(part->polyData);
  }
  if (staticStamps_ == stamps)
  {
    return;
  }
  hasNews_ = true;
  staticStamps_.reset(); // until all is read
  ConvertedPolyData all(bands_);
  all.reserve(inputs);
  for (const InputPart* part : staticParts)
  {
    all.material.firstCellOfPart.push_back(all.material.numberOfCells);
    convert(*part, all, cancelPoint);
  }
  adopt(std::move(all), objects_.staticObject, false, cancelPoint);
  adoptSky(staticParts);
  staticStamps_ = std::move(stamps);
}

void SceneReader::adoptSky(const std::vector<const InputPart*>& staticParts)
{
  const InputPart* found = nullptr;
  for (const InputPart* part : staticParts)
  {
    if (hasSky(part->polyData))
    {
      throwIf(found != nullptr, part->name, ": has a sky, as ", found ? found->name : "",
        " has; there can be one");
      found = part;
    }
  }
  std::shared_ptr<const Sky> sky;
  isUnderSky_ = found != nullptr;
  if (found)
  {
    groupOfSky_ = lampGroups_.numberOf(*found);
    sky =
      readSky(found->name, found->polyData, bands_, objects_.staticObject.body->mesh().bounds());
    checkLit(found->name, { {}, {}, sky }, objects_.staticObject);
  }
  if (!sky || !objects_.sky || !(*sky == *objects_.sky))
  {
    objects_.sky = std::move(sky);
  }
}

void SceneReader::readDynamic(
  const InputPart& part, std::size_t index, const CancelPoint& cancelPoint)
{
  throwIf(hasSky(part.polyData), part.name, ": has a sky, which belongs to input port 0");
  SceneObject& object = objects_.dynamicObjects[index];
  const bool wasPresent = std::exchange(object.isPresent, part.polyData->GetNumberOfCells() > 0);
  hasNews_ = hasNews_ || object.isPresent != wasPresent;
  if (!object.isPresent && object.material && object.material->bands == bands_)
  {
    return; // its body and material stay: the object may come back unchanged
  }
  const Stamp stamp = stampOf(part);
  if (!(dynamicStamps_[index] == stamp))
  {
    dynamicStamps_[index].reset(); // until all is read
    ConvertedPolyData data(bands_);
    data.reserve({ part.polyData });
    convert(part, data, cancelPoint);
    for (std::size_t i = 0; stamp.isMirrored && i < data.triangles.size(); ++i)
    {
      std::swap(data.triangles[i].b, data.triangles[i].c);
    }
    adopt(std::move(data), object, true, cancelPoint);
    dynamicStamps_[index] = stamp;
  }
}

/// Equal values keep the old object, and with it its tree, its ellipsoid and the stored walks.
void SceneReader::adopt(
  ConvertedPolyData data, SceneObject& object, bool mayMove, const CancelPoint& cancelPoint)
{
  if (!data.specular.empty())
  {
    data.material.setSpecular(std::move(data.specular), std::move(data.exponents));
  }
  data.material.setSheets(std::move(data.diffuseThrough), std::move(data.straight),
    std::move(data.index), std::move(data.internal));
  if (!object.material || !(*object.material == data.material))
  {
    object.material = std::make_shared<Material>(std::move(data.material));
  }
  if (data.emission.isEmpty())
  {
    object.emission.reset();
  }
  else if (!object.emission || !(*object.emission == data.emission))
  {
    object.emission = std::make_shared<Emission>(std::move(data.emission));
  }
  if (!object.body || !isEqual(object.body->mesh().triangles(), data.triangles, cancelPoint))
  {
    object.body = std::make_shared<RigidObject>(
      TriangleMesh(std::move(data.triangles), cancelPoint), cancelPoint, mayMove);
    if (cancelPoint)
    {
      cancelPoint(); // freeing the memory of the build takes a while
    }
  }
}

SceneCell SceneReader::firstCellOf(std::size_t part) const
{
  return part < numberOfStatics()
    ? SceneCell{ 0, firstCells()[part] }
    : SceneCell{ static_cast<std::uint32_t>(part - numberOfStatics() + 1), 0 };
}

std::size_t SceneReader::partOf(const SceneCell& cell) const
{
  return cell.object == 0 ? objects_.staticObject.material->partOfCell(cell.cell) - 1
                          : numberOfStatics() + cell.object - 1;
}

std::string SceneReader::nameOf(const SceneCell& cell, const SceneInputs& inputs) const
{
  const std::size_t part = partOf(cell);
  return allPartsOf(inputs)[part]->name + ", cell " +
    std::to_string(cell.cell - firstCellOf(part).cell);
}

}
