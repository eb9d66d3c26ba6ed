// SPDX-License-Identifier: BSD-3-Clause
#include "Input/LuminaireFields.h"

#include "Data/NamedArray.h"
#include "Input/PolyDataConverter.h"
#include "Progress/InputError.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <map>
#include <set>
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

template <class... Parts>
void failIf(bool isWrong, const LuminaireFields& fields, vtkIdType cell, const Parts&... parts)
{
  throwIf(isWrong, fields.where, ", cell ", cell, ": ", parts...);
}

Vector3 vectorOf(
  const LuminaireFields& fields, const char* name, vtkIdType cell, const Vector3& usual)
{
  vtkDataArray* const array = fields.input->GetCellData()->GetArray(name);
  if (!array)
  {
    return usual;
  }
  failIf(array->GetNumberOfComponents() != 3 || array->GetNumberOfTuples() <= cell, fields, cell,
    "the cell array ", name, " has no vector of 3 components for it");
  Vector3 vector;
  array->GetTuple(cell, vector.data());
  failIf(
    !vector.allFinite() || vector.isZero(0), fields, cell, "its ", name, " is not a direction");
  return vector;
}

/// With the axes of a cell.
Luminaire lampOf(const LuminaireFields& fields, vtkIdType cell)
{
  const Vector3 axis = vectorOf(fields, "LampAxis", cell, -Vector3::UnitZ()).normalized();
  const Vector3 given = vectorOf(fields, "LampReference", cell, Vector3::UnitX()).normalized();
  const Vector3 across = given - axis.dot(given) * axis;
  constexpr double kAlong = 1e-3; // rounding, and no more, may bring them off the right angle
  failIf(!(std::abs(axis.dot(given)) <= kAlong), fields, cell,
    "its LampReference is not across its LampAxis");
  return { fields.intensity, axis, across.normalized(), fields.flux, {} };
}

int idOf(const LuminaireFields& fields, vtkIdType cell)
{
  vtkDataArray* const ids = fields.input->GetCellData()->GetArray("LampId");
  return ids && cell < ids->GetNumberOfTuples() ? static_cast<int>(ids->GetComponent(cell, 0)) : 0;
}

/// Of an opening, whose faces are to be complete.
void checkFaces(const LuminaireFields& fields, const Luminaire& lamp, vtkIdType cell)
{
  constexpr std::size_t kMostFaces = 1024;
  failIf(lamp.faces.size() > kMostFaces, fields, cell, "its luminaire has faces that look into ",
    lamp.faces.size(), " directions; ", kMostFaces, " are possible");
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
  const double part = behind / all;
  failIf(part > kMostBehind, fields, cell, 100 * part,
    " % of the light of its table would leave behind the opening; no face looks there");
}

}

int bandsOfLuminaires(vtkPolyData* input)
{
  vtkDataArray* const flux = fieldOf(input, kFlux);
  return flux && flux->GetNumberOfComponents() == 3 && fieldOf(input, kIntensity) ? 3 : 1;
}

std::optional<LuminaireFields> readLuminaires(
  const std::string& where, vtkPolyData* input, int bands)
{
  if (!input->GetFieldData()->HasArray(kIntensity))
  {
    return std::nullopt;
  }
  const auto columnOf = [&](const char* name) {
    return irradiance::columnOf(where, input->GetFieldData(), name,
      joined(
        ": has the field-data array ", kIntensity, " but not ", name, ", which belongs to it"));
  };
  std::vector<double> polar = columnOf(kPolar), azimuths = columnOf(kAzimuths),
                      values = columnOf(kIntensity);
  LuminaireFields fields{ where, input, nullptr };
  try
  {
    fields.intensity =
      std::make_shared<DirectionTable>(std::move(polar), std::move(azimuths), std::move(values));
  }
  catch (const InputError& error)
  {
    throw InputError(where + ": of the table " + kIntensity + ", " + error.what());
  }
  const double ofTable = fields.intensity->integral();
  vtkDataArray* const flux = fieldOf(input, kFlux);
  throwIf(flux &&
      (flux->GetNumberOfTuples() != 1 ||
        (flux->GetNumberOfComponents() != 1 && flux->GetNumberOfComponents() != 3)),
    where, ": the field-data array ", kFlux, " is not one tuple of 1 or 3 components");
  for (int band = 0; band < bands; ++band)
  {
    const double watts =
      flux ? flux->GetComponent(0, flux->GetNumberOfComponents() == 1 ? 0 : band) : ofTable;
    constexpr double kBrightest = 1e30;
    throwIf(!(watts >= 0 && watts <= kBrightest), where, ": the field-data array ", kFlux, " has ",
      watts, " W, not within 0..", kBrightest);
    throwIf(watts > 0 && !(ofTable > 0), where, ": is to shine ", watts, " W, but its table ",
      kIntensity, " is 0");
    fields.flux.push_back(watts);
  }
  return fields;
}

void addLuminaires(const LuminaireFields& fields, std::size_t firstCell, std::size_t firstTriangle,
  ConvertedPolyData& target)
{
  Emission& emission = target.emission;
  const std::size_t cells = target.material.numberOfCells;
  const auto bands = static_cast<std::size_t>(emission.bands);
  if (std::all_of(fields.flux.begin(), fields.flux.end(), [](double watts) { return watts == 0; }))
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
      number = add(lampOf(fields, static_cast<vtkIdType>(source.cell - firstCell)));
    }
  }
  std::map<int, std::uint32_t> numbers; // by LampId
  std::map<std::uint32_t, double> areas;
  for (std::size_t i = firstTriangle; i < target.triangles.size(); ++i)
  {
    const std::uint32_t cell = target.material.cellOfTriangle[i];
    const auto own = static_cast<vtkIdType>(cell - firstCell);
    const auto [number, isNew] = numbers.try_emplace(idOf(fields, own), 0);
    number->second = isNew ? add(lampOf(fields, own)) : number->second;
    emission.luminaireOfCell[cell] = number->second;
    addFace(target.triangles[i], emission.luminaires[number->second].faces);
    areas[number->second] += target.triangles[i].area();
  }
  emission.exitance.resize(areas.empty() ? emission.exitance.size() : cells * bands, 0.0);
  std::set<std::uint32_t> checked;
  for (std::size_t cell = firstCell; cell < cells; ++cell)
  {
    const auto area = areas.find(emission.luminaireOfCell[cell]);
    if (area == areas.end())
    {
      continue;
    }
    for (std::size_t band = 0; band < bands; ++band)
    {
      emission.exitance[cell * bands + band] = fields.flux[band] / area->second;
    }
    if (checked.insert(area->first).second)
    {
      checkFaces(
        fields, emission.luminaires[area->first], static_cast<vtkIdType>(cell - firstCell));
    }
  }
}

}
