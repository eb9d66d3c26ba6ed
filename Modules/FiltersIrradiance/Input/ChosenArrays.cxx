// SPDX-License-Identifier: BSD-3-Clause
#include "Input/ChosenArrays.h"

#include "Input/InputConnection.h"
#include "Progress/InputError.h"

#include "vtkAlgorithm.h"
#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cctype>

namespace irradiance
{

namespace
{

/// Name of the array to read; null if an attribute was chosen, such as the active scalars.
const char* chosenName(vtkAlgorithm* filter, const MaterialArrayRole& role)
{
  return filter->GetInputArrayInformation(role.index)->Get(vtkDataObject::FIELD_NAME());
}

/// An empty name: the quantity is not read from any array.
bool isNone(vtkAlgorithm* filter, const MaterialArrayRole& role)
{
  const char* name = chosenName(filter, role);
  return name && *name == 0;
}

bool isDefault(vtkAlgorithm* filter, const MaterialArrayRole& role)
{
  const char* name = chosenName(filter, role);
  return name && std::string(name) == role.defaultName;
}

std::string quoted(const std::string& name)
{
  return '"' + name + '"';
}

vtkAbstractArray* findArray(
  vtkAlgorithm* filter, const MaterialArrayRole& role, vtkDataSetAttributes* attributes)
{
  vtkInformation* choice = filter->GetInputArrayInformation(role.index);
  if (isNone(filter, role))
  {
    return nullptr;
  }
  if (const char* name = chosenName(filter, role))
  {
    return attributes->GetAbstractArray(name);
  }
  return choice->Has(vtkDataObject::FIELD_ATTRIBUTE_TYPE())
    ? attributes->GetAbstractAttribute(choice->Get(vtkDataObject::FIELD_ATTRIBUTE_TYPE()))
    : nullptr;
}

vtkAbstractArray* readArray(vtkAlgorithm* filter, const MaterialArrayRole& role, InputPart& part)
{
  vtkAbstractArray* array = findArray(filter, role, part.polyData->GetCellData());
  vtkAbstractArray* ofPoints = findArray(filter, role, part.polyData->GetPointData());
  if (!array && ofPoints && ofPoints->GetName())
  {
    part.warnings.push_back({ part.name,
      std::string(": the array ") + ofPoints->GetName() + " (" + role.meaning +
        ") stands on the points and is not read; it has to stand on the cells" });
  }
  return array;
}

/// The names of the cell arrays that nothing is read from.
std::vector<std::string> unreadArrays(const InputPart& part)
{
  std::vector<std::string> names;
  vtkCellData* cells = part.polyData->GetCellData();
  for (int i = 0; i < cells->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = cells->GetAbstractArray(i);
    const bool isRead =
      std::find(part.arrays.begin(), part.arrays.end(), array) != part.arrays.end();
    const std::string name = array && array->GetName() ? array->GetName() : "";
    if (!isRead && !name.empty() && name != vtkDataSetAttributes::GhostArrayName())
    {
      names.push_back(name);
    }
  }
  return names;
}

/// Small letters and digits alone, without a unit: "Radiant_Exitance (W/m2)" is "radiantexitance".
std::string plainName(const std::string& name)
{
  std::string plain;
  for (const char c : name.substr(0, name.find_first_of("([")))
  {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte))
    {
      plain += static_cast<char>(std::tolower(byte));
    }
  }
  for (const std::string unit : { "wm2", "w" })
  {
    if (plain.size() > unit.size() &&
      plain.compare(plain.size() - unit.size(), unit.size(), unit) == 0)
    {
      return plain.substr(0, plain.size() - unit.size());
    }
  }
  return plain;
}

/// Plain names under which a quantity is known, too; the first is its default name.
const std::vector<std::string>& synonyms(std::size_t quantity)
{
  static const std::array<std::vector<std::string>, kMaterialArrays> names{ {
    { "radiantexitance", "exitance", "radiantemittance", "emittance" },
    { "diffusereflectance", "reflectance", "diffusereflectivity", "reflectivity", "albedo",
      "diffusealbedo" },
    { "specularreflectance", "specularreflectivity" },
    { "phongexponent", "specularexponent" },
    { "radiantflux", "radiantpower" },
  } };
  return names[quantity];
}

/// Whether the part has cells that could have the quantity.
bool hasCellsFor(std::size_t quantity, vtkPolyData* polyData)
{
  return (quantity == Flux ? polyData->GetNumberOfVerts()
                           : polyData->GetNumberOfPolys() + polyData->GetNumberOfStrips()) > 0;
}

/// Where somebody has chosen an array, or none, that is what was meant.
void noteNearNames(vtkAlgorithm* filter, InputPart& part)
{
  for (const std::string& name : unreadArrays(part))
  {
    const std::string plain = plainName(name);
    for (std::size_t i = 0; i < kArrayRoles.size(); ++i)
    {
      const auto& known = synonyms(i);
      if (!part.arrays[i] && isDefault(filter, kArrayRoles[i]) && hasCellsFor(i, part.polyData) &&
        std::find(known.begin(), known.end(), plain) != known.end())
      {
        const std::string quantity = quoted(kArrayRoles[i].defaultName);
        part.warnings.push_back({ part.name,
          ": the cell array " + quoted(name) + " is not read, as the " + kArrayRoles[i].meaning +
            " is read from " + quantity + "; rename it, or call SetCellArray(" + quantity + ", " +
            quoted(name) + ")" });
      }
    }
  }
}

std::string lightName(vtkAlgorithm* filter, MaterialArray quantity)
{
  const MaterialArrayRole& role = kArrayRoles[quantity];
  const char* name = chosenName(filter, role);
  return isNone(filter, role) ? std::string("(none was chosen)")
                              : quoted(name ? name : role.defaultName);
}

}

void findArrays(vtkAlgorithm* filter, InputPart& part)
{
  std::transform(kArrayRoles.begin(), kArrayRoles.end(), part.arrays.begin(),
    [&](const MaterialArrayRole& role) { return readArray(filter, role, part); });
  noteNearNames(filter, part);
}

void checkChosenArrays(vtkAlgorithm* filter, const SceneInputs& inputs)
{
  for (const MaterialArrayRole& role : kArrayRoles)
  {
    const char* name = chosenName(filter, role);
    const std::string choice = std::string("the array ") + (name ? name : "(an attribute)") +
      ", chosen for the " + role.meaning + ",";
    const int association =
      filter->GetInputArrayInformation(role.index)->Get(vtkDataObject::FIELD_ASSOCIATION());
    if (association == vtkDataObject::FIELD_ASSOCIATION_POINTS ||
      association == vtkDataObject::FIELD_ASSOCIATION_NONE)
    {
      throw InputError(choice + " is to be read from the " +
        (association == vtkDataObject::FIELD_ASSOCIATION_POINTS ? "points" : "field data") +
        "; only cell arrays can be read");
    }
    const auto parts = allPartsOf(inputs);
    const auto hasArray = [&](const InputPart* part) {
      return findArray(filter, role, part->polyData->GetCellData()) != nullptr;
    };
    if (!parts.empty() && std::none_of(parts.begin(), parts.end(), hasArray) &&
      !isDefault(filter, role) && !isNone(filter, role))
    {
      throw InputError(choice + " is not among the cell arrays of any input");
    }
  }
}

std::string noLightWarning(vtkAlgorithm* filter, const SceneInputs& inputs)
{
  std::string unread;
  int parts = 0;
  constexpr int mostParts = 10;
  for (const InputPart* part : allPartsOf(inputs))
  {
    const std::vector<std::string> names = unreadArrays(*part);
    for (std::size_t i = 0; i < names.size() && parts < mostParts; ++i)
    {
      unread +=
        (i > 0 ? ", " : (unread.empty() ? "" : "; ") + part->name + ": ") + quoted(names[i]);
    }
    parts += names.empty() ? 0 : 1;
  }
  return "the scene has no light: no surface with a cell array " + lightName(filter, Exitance) +
    " above 0, and no vertex with a " + lightName(filter, Flux) +
    (unread.empty() ? ". No cell array is there that is not read"
                    : ". Cell arrays that are not read: " + unread +
          (parts > mostParts ? "; and in more inputs" : "") + ". SetCellArray(" +
          quoted(kArrayRoles[Exitance].defaultName) + ", name) chooses one");
}

}
