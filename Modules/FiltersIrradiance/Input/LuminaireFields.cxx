// SPDX-License-Identifier: BSD-3-Clause
#include "Input/LuminaireFields.h"

#include "Input/PolyDataConverter.h"
#include "Progress/InputError.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <map>
#include <utility>

namespace irradiance
{

namespace
{

constexpr const char *kIntensity = "RadiantIntensity", *kPolar = "PolarAngles",
                     *kAzimuths = "AzimuthAngles", *kFlux = "Flux";

vtkDataArray* fieldOf(vtkPolyData* input, const char* name)
{
  return input->GetFieldData()->GetArray(name);
}

/// All values of a field-data array of one component.
std::vector<double> numbersOf(const std::string& where, vtkPolyData* input, const char* name)
{
  vtkDataArray* const array = fieldOf(input, name);
  throwIf(!array,
    where + ": has the field-data array " + kIntensity + " but not " + name +
      ", which belongs to it");
  throwIf(array->GetNumberOfComponents() != 1,
    where + ": the field-data array " + name + " has " +
      std::to_string(array->GetNumberOfComponents()) + " components; 1 is possible");
  std::vector<double> numbers(static_cast<std::size_t>(array->GetNumberOfTuples()));
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    numbers[i] = array->GetComponent(static_cast<vtkIdType>(i), 0);
  }
  return numbers;
}

/// Adds a triangle to the face that looks the same way, up to .1 degrees: rounding to floats turns
/// small triangles of a plane.
void addFace(const Triangle& triangle, std::vector<Vector3>& faces)
{
  constexpr double kSame = 1 - 1e-6; // cosine
  const Vector3 area = triangle.areaVector() / 2;
  const auto same = std::find_if(faces.begin(), faces.end(),
    [&](const Vector3& face) { return face.dot(area) >= kSame * face.norm() * area.norm(); });
  same != faces.end() ? void(*same += area) : faces.push_back(area);
}

}

int LuminaireFields::bandsOf(vtkPolyData* input)
{
  vtkDataArray* const flux = fieldOf(input, kFlux);
  return flux && flux->GetNumberOfComponents() == 3 && fieldOf(input, kIntensity) ? 3 : 1;
}

std::optional<LuminaireFields> LuminaireFields::of(
  const std::string& where, vtkPolyData* input, int bands)
{
  if (!input->GetFieldData()->HasArray(kIntensity))
  {
    return std::nullopt;
  }
  LuminaireFields fields;
  fields.where_ = where;
  fields.input_ = input;
  std::vector<double> polar = numbersOf(where, input, kPolar),
                      azimuths = numbersOf(where, input, kAzimuths),
                      values = numbersOf(where, input, kIntensity);
  try
  {
    fields.intensity_ =
      std::make_shared<DirectionTable>(std::move(polar), std::move(azimuths), std::move(values));
  }
  catch (const InputError& error)
  {
    throw InputError(where + ": of the table " + kIntensity + ", " + error.what());
  }
  const double ofTable = fields.intensity_->integral();
  vtkDataArray* const flux = fieldOf(input, kFlux);
  throwIf(flux &&
      (flux->GetNumberOfTuples() != 1 ||
        (flux->GetNumberOfComponents() != 1 && flux->GetNumberOfComponents() != 3)),
    where + ": the field-data array " + kFlux + " is not one tuple of 1 or 3 components");
  for (int band = 0; band < bands; ++band)
  {
    const double watts =
      flux ? flux->GetComponent(0, flux->GetNumberOfComponents() == 1 ? 0 : band) : ofTable;
    constexpr double kBrightest = 1e30;
    throwIf(!(watts >= 0 && watts <= kBrightest),
      where + ": the field-data array " + kFlux + " has " + text(watts) + " W, not within 0.." +
        text(kBrightest));
    throwIf(watts > 0 && !(ofTable > 0),
      where + ": is to shine " + text(watts) + " W, but its table " + kIntensity + " is 0");
    fields.flux_.push_back(watts);
  }
  return fields;
}

void LuminaireFields::addTo(
  ConvertedPolyData& target, std::size_t firstCell, std::size_t firstTriangle) const
{
  Emission& emission = target.emission;
  const std::size_t cells = target.material.numberOfCells;
  const auto bands = static_cast<std::size_t>(emission.bands);
  if (std::all_of(flux_.begin(), flux_.end(), [](double watts) { return watts == 0; }))
  {
    return;
  }
  emission.luminaireOfCell.resize(cells, Emission::kNone);
  const auto add = [&](Luminaire lamp) {
    emission.luminaires.push_back(std::move(lamp));
    return static_cast<std::uint32_t>(emission.luminaires.size() - 1);
  };
  for (const PointSource& source : emission.points)
  {
    std::uint32_t& number = emission.luminaireOfCell[source.cell];
    if (source.cell >= firstCell && number == Emission::kNone)
    {
      number = add(lampOf(static_cast<vtkIdType>(source.cell - firstCell)));
    }
  }
  std::map<int, std::uint32_t> numbers; // by LampId
  std::map<std::uint32_t, double> areas;
  for (std::size_t i = firstTriangle; i < target.triangles.size(); ++i)
  {
    const std::uint32_t cell = target.material.cellOfTriangle[i];
    const auto own = static_cast<vtkIdType>(cell - firstCell);
    const auto [number, isNew] = numbers.try_emplace(idOf(own), 0);
    number->second = isNew ? add(lampOf(own)) : number->second;
    emission.luminaireOfCell[cell] = number->second;
    addFace(target.triangles[i], emission.luminaires[number->second].faces);
    areas[number->second] += target.triangles[i].area();
  }
  emission.exitance.resize(areas.empty() ? emission.exitance.size() : cells * bands, 0.0);
  for (std::size_t cell = firstCell; cell < cells && !areas.empty(); ++cell)
  {
    const auto area = areas.find(emission.luminaireOfCell[cell]);
    for (std::size_t band = 0; area != areas.end() && band < bands; ++band)
    {
      emission.exitance[cell * bands + band] = flux_[band] / area->second;
    }
  }
  for (std::size_t cell = firstCell; cell < cells; ++cell)
  {
    if (const auto area = areas.find(emission.luminaireOfCell[cell]); area != areas.end())
    {
      checkReach(emission.luminaires[area->first], static_cast<vtkIdType>(cell - firstCell));
      areas.erase(area);
    }
  }
}

Luminaire LuminaireFields::lampOf(vtkIdType cell) const
{
  const Vector3 axis = vectorOf("LampAxis", cell, -Vector3::UnitZ()).normalized();
  const Vector3 given = vectorOf("LampReference", cell, Vector3::UnitX()).normalized();
  const Vector3 across = given - axis.dot(given) * axis;
  constexpr double kAlong = 1e-3; // rounding, and no more, may bring them off the right angle
  if (!(std::abs(axis.dot(given)) <= kAlong))
  {
    fail(cell, "its LampReference is not across its LampAxis");
  }
  return { intensity_, axis, across.normalized(), flux_, {} };
}

Vector3 LuminaireFields::vectorOf(const char* name, vtkIdType cell, const Vector3& usual) const
{
  vtkDataArray* const array = input_->GetCellData()->GetArray(name);
  if (!array)
  {
    return usual;
  }
  if (array->GetNumberOfComponents() != 3 || array->GetNumberOfTuples() <= cell)
  {
    fail(cell, std::string("the cell array ") + name + " has no vector of 3 components for it");
  }
  Vector3 vector;
  array->GetTuple(cell, vector.data());
  if (!vector.allFinite() || vector.isZero(0))
  {
    fail(cell, std::string("its ") + name + " is not a direction");
  }
  return vector;
}

int LuminaireFields::idOf(vtkIdType cell) const
{
  vtkDataArray* const ids = input_->GetCellData()->GetArray("LampId");
  return ids && cell < ids->GetNumberOfTuples() ? static_cast<int>(ids->GetComponent(cell, 0)) : 0;
}

void LuminaireFields::checkReach(const Luminaire& lamp, vtkIdType cell) const
{
  constexpr std::size_t kMostFaces = 1024;
  if (lamp.faces.size() > kMostFaces)
  {
    fail(cell,
      "its luminaire has faces that look into " + std::to_string(lamp.faces.size()) +
        " directions; " + std::to_string(kMostFaces) + " are possible");
  }
  double behind = 0, all = 0;
  const Vector3 third = lamp.reference.cross(lamp.axis);
  lamp.intensity->forEachPart([&](const Vector3& local, double weight) {
    const Vector3 direction = local[0] * lamp.reference + local[1] * third + local[2] * lamp.axis;
    const bool isLit = std::any_of(lamp.faces.begin(), lamp.faces.end(),
      [&](const Vector3& face) { return face.dot(direction) > 0; });
    behind += isLit ? 0 : weight;
    all += weight;
  });
  constexpr double kMostBehind = 1e-3;
  if (const double part = behind / all; part > kMostBehind)
  {
    fail(cell,
      text(100 * part) +
        " % of the light of its table would leave behind the opening; no face "
        "looks there");
  }
}

void LuminaireFields::fail(vtkIdType cell, const std::string& what) const
{
  throw InputError(where_ + ", cell " + std::to_string(cell) + ": " + what);
}

}
