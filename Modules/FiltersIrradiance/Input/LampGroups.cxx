// SPDX-License-Identifier: BSD-3-Clause
#include "Input/LampGroups.h"

#include "Data/ArrayNames.h"
#include "Input/PolyDataConverter.h"
#include "Progress/InputError.h"

#include "vtkAbstractArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkPolyData.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cmath>

namespace irradiance
{

namespace
{

/// Of the part, or else of its connection; null if neither has one.
vtkAbstractArray* fieldOf(const InputPart& part, const char* name)
{
  vtkAbstractArray* const own = part.polyData->GetFieldData()->GetAbstractArray(name);
  return own || !part.connectionFields ? own : part.connectionFields->GetAbstractArray(name);
}

std::string nameIn(vtkAbstractArray* array, vtkIdType tuple, const std::string& where)
{
  const std::string name = array->GetVariantValue(tuple).ToString();
  throwIf(name.empty(), where, ": the array ", array->GetName(), " has an empty name at ", tuple);
  return name;
}

void checkNames(vtkAbstractArray* array, const std::string& where)
{
  throwIf(array->GetNumberOfComponents() != 1, where, ": the array ", array->GetName(), " has ",
    array->GetNumberOfComponents(), " components; 1 is possible");
}

}

std::uint32_t LampGroups::numberOf(const std::string& name, bool isNamed)
{
  const auto found = std::find_if(
    groups_.begin(), groups_.end(), [&](const LampGroup& group) { return group.name == name; });
  const auto number = static_cast<std::uint32_t>(found - groups_.begin());
  if (found == groups_.end())
  {
    groups_.push_back({ name, isNamed });
  }
  return number;
}

std::uint32_t LampGroups::numberOf(const InputPart& part)
{
  vtkAbstractArray* const names = fieldOf(part, kLightGroup);
  const bool isNamed = names && names->GetNumberOfTuples() == 1;
  if (isNamed)
  {
    checkNames(names, part.name);
  }
  return isNamed ? numberOf(nameIn(names, 0, part.name), true) : numberOf(part.lampGroup, false);
}

void LampGroups::read(const InputPart& part, std::size_t first, ConvertedPolyData& target)
{
  Emission& emission = target.emission;
  const std::size_t cells = target.material.numberOfCells;
  const std::uint32_t ofPart = numberOf(part);
  vtkAbstractArray* const names = part.polyData->GetCellData()->GetAbstractArray(kLightGroup);
  if (first == 0 && !names)
  {
    emission.group = ofPart;
    return;
  }
  if (emission.groups.empty() && (names || ofPart != emission.group))
  {
    emission.groups.assign(first, emission.group);
    emission.group = 0;
  }
  if (!emission.groups.empty())
  {
    emission.groups.resize(cells, ofPart);
  }
  if (names)
  {
    checkNames(names, part.name);
    throwIf(names->GetNumberOfTuples() != part.polyData->GetNumberOfCells(), part.name,
      ": the array ", kLightGroup, " has ", names->GetNumberOfTuples(), " tuples for ",
      part.polyData->GetNumberOfCells(), " cells");
    for (std::size_t cell = first; cell < cells; ++cell)
    {
      if (emission.emits(cell))
      {
        emission.groups[cell] =
          numberOf(nameIn(names, static_cast<vtkIdType>(cell - first), part.name), true);
      }
    }
  }
}

void LampGroups::readFactors(const SceneInputs& inputs, int bands)
{
  for (LampGroup& group : groups_)
  {
    group.factor = { { 1, 1, 1 } };
  }
  std::vector<std::string> from(groups_.size()); // the part that told the factor
  for (const InputPart* part : allPartsOf(inputs))
  {
    vtkAbstractArray* const given = fieldOf(*part, kLightGroupFactor);
    if (!given)
    {
      continue;
    }
    vtkDataArray* const factors = vtkDataArray::SafeDownCast(given);
    vtkAbstractArray* const names = fieldOf(*part, kLightGroup);
    const vtkIdType count = names ? names->GetNumberOfTuples() : 1;
    throwIf(!factors || factors->GetNumberOfTuples() != count ||
        (factors->GetNumberOfComponents() != 1 && factors->GetNumberOfComponents() != bands),
      part->name, ": the field-data array ", kLightGroupFactor, " needs numbers, ", count,
      " tuples (", names ? "one for each name in " : "as there is no ", kLightGroup, ") of 1 or ",
      bands, " components");
    for (vtkIdType i = 0; i < count; ++i)
    {
      const std::uint32_t number =
        names ? numberOf(nameIn(names, i, part->name), true) : numberOf(*part);
      from.resize(groups_.size());
      Bands factor{};
      for (int band = 0; band < bands; ++band)
      {
        double& value = factor[static_cast<std::size_t>(band)];
        value = factors->GetComponent(i, factors->GetNumberOfComponents() == 1 ? 0 : band);
        throwIf(!(value >= 0 && std::isfinite(value)), part->name, ": the factor of light group ",
          groups_[number].name, " is ", value, "; it has to be finite and 0 or more");
      }
      throwIf(!from[number].empty() && factor != groups_[number].factor, part->name,
        ": light group ", groups_[number].name, " has another factor than in ", from[number]);
      groups_[number].factor = factor;
      from[number] = part->name;
    }
  }
}

}
