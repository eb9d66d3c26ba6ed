// SPDX-License-Identifier: BSD-3-Clause
#include "Input/ChosenArrays.h"

#include "Input/InputConnection.h"
#include "Progress/InputError.h"

#include "vtkAlgorithm.h"
#include "vtkCellData.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cctype>

namespace irradiance
{

namespace
{

vtkInformation* informationOf(vtkAlgorithm* filter, std::size_t quantity)
{
  return filter->GetInputArrayInformation(static_cast<int>(quantity));
}

/// Name of the array to read; null if an attribute was chosen, such as the active scalars.
const char* chosenName(vtkAlgorithm* filter, std::size_t quantity)
{
  return informationOf(filter, quantity)->Get(vtkDataObject::FIELD_NAME());
}

/// An empty name: the quantity is not read from any array.
bool isNone(vtkAlgorithm* filter, std::size_t quantity)
{
  const char* name = chosenName(filter, quantity);
  return name && *name == 0;
}

bool isDefault(vtkAlgorithm* filter, std::size_t quantity)
{
  const char* name = chosenName(filter, quantity);
  return name && std::string(name) == kArrayNames[quantity];
}

std::string quoted(const std::string& name)
{
  return '"' + name + '"';
}

vtkAbstractArray* findArray(
  vtkAlgorithm* filter, std::size_t quantity, vtkDataSetAttributes* attributes)
{
  vtkInformation* choice = informationOf(filter, quantity);
  if (const char* name = chosenName(filter, quantity))
  {
    return *name ? attributes->GetAbstractArray(name) : nullptr;
  }
  return choice->Has(vtkDataObject::FIELD_ATTRIBUTE_TYPE())
    ? attributes->GetAbstractAttribute(choice->Get(vtkDataObject::FIELD_ATTRIBUTE_TYPE()))
    : nullptr;
}

vtkAbstractArray* readArray(vtkAlgorithm* filter, std::size_t quantity, InputPart& part)
{
  vtkAbstractArray* array = findArray(filter, quantity, part.polyData->GetCellData());
  vtkAbstractArray* ofPoints = findArray(filter, quantity, part.polyData->GetPointData());
  if (!array && ofPoints && ofPoints->GetName())
  {
    part.warnings.push_back({ part.name,
      std::string(": the array ") + ofPoints->GetName() + " (" + kArrayMeanings[quantity] +
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
    { "diffusetransmittance" },
    { "speculartransmittance", "transmittance", "directtransmittance" },
    { "refractiveindex", "indexofrefraction", "ior" },
    { "internaltransmittance" },
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
    for (std::size_t i = 0; i < kMaterialArrays; ++i)
    {
      const auto& known = synonyms(i);
      if (!part.arrays[i] && isDefault(filter, i) && hasCellsFor(i, part.polyData) &&
        std::find(known.begin(), known.end(), plain) != known.end())
      {
        const std::string quantity = quoted(kArrayNames[i]);
        part.warnings.push_back({ part.name,
          ": the cell array " + quoted(name) + " is not read, as the " + kArrayMeanings[i] +
            " is read from " + quantity + "; rename it, or call SetCellArray(" + quantity + ", " +
            quoted(name) + ")" });
      }
    }
  }
}

std::string lightName(vtkAlgorithm* filter, MaterialArray quantity)
{
  const char* name = chosenName(filter, quantity);
  return isNone(filter, quantity) ? std::string("(none was chosen)")
                                  : quoted(name ? name : kArrayNames[quantity]);
}

}

void findArrays(vtkAlgorithm* filter, InputPart& part)
{
  for (std::size_t i = 0; i < part.arrays.size(); ++i)
  {
    part.arrays[i] = readArray(filter, i, part);
  }
  noteNearNames(filter, part);
}

void checkChosenArrays(vtkAlgorithm* filter, const SceneInputs& inputs)
{
  for (std::size_t quantity = 0; quantity < kMaterialArrays; ++quantity)
  {
    const char* name = chosenName(filter, quantity);
    const std::string choice = std::string("the array ") + (name ? name : "(an attribute)") +
      ", chosen for the " + kArrayMeanings[quantity] + ",";
    const int association =
      informationOf(filter, quantity)->Get(vtkDataObject::FIELD_ASSOCIATION());
    throwIf(association == vtkDataObject::FIELD_ASSOCIATION_POINTS ||
        association == vtkDataObject::FIELD_ASSOCIATION_NONE,
      choice + " is to be read from the " +
        (association == vtkDataObject::FIELD_ASSOCIATION_POINTS ? "points" : "field data") +
        "; only cell arrays can be read");
    const auto parts = allPartsOf(inputs);
    const auto hasArray = [&](const InputPart* part) {
      return findArray(filter, quantity, part->polyData->GetCellData()) != nullptr;
    };
    throwIf(!parts.empty() && std::none_of(parts.begin(), parts.end(), hasArray) &&
        !isDefault(filter, quantity) && !isNone(filter, quantity),
      choice + " is not among the cell arrays of any input");
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
    " above 0, no vertex with a " + lightName(filter, Flux) + ", and no sky" +
    (unread.empty() ? ". No cell array is there that is not read"
                    : ". Cell arrays that are not read: " + unread +
          (parts > mostParts ? "; and in more inputs" : "") + ". SetCellArray(" +
          quoted(kArrayNames[Exitance]) + ", name) chooses one");
}

}
