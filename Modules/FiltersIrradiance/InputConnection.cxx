// SPDX-License-Identifier: BSD-3-Clause
#include "InputConnection.h"

#include "InputError.h"
#include "Pose.h"

#include "vtkAlgorithm.h"
#include "vtkCellData.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>

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
    part.oddities.push_back(part.name + ": the array " + ofPoints->GetName() + " (" + role.meaning +
      ") stands on the points and is not read; it has to stand on the cells");
  }
  return array;
}

InputPart partOf(vtkAlgorithm* filter, const std::string& name, vtkPolyData* polyData)
{
  InputPart part;
  part.name = name;
  part.polyData = polyData;
  std::transform(kArrayRoles.begin(), kArrayRoles.end(), part.arrays.begin(),
    [&](const MaterialArrayRole& role) { return readArray(filter, role, part); });
  return part;
}

std::string leafName(const std::string& connection, vtkDataObjectTreeIterator* leaf)
{
  std::string name = connection + ", block " + std::to_string(leaf->GetCurrentFlatIndex());
  if (leaf->HasCurrentMetaData() && leaf->GetCurrentMetaData()->Has(vtkCompositeDataSet::NAME()))
  {
    name += std::string(" (") + leaf->GetCurrentMetaData()->Get(vtkCompositeDataSet::NAME()) + ")";
  }
  return name;
}

InputConnection connectionOf(vtkAlgorithm* filter, int port, int index, vtkDataObject* data)
{
  InputConnection connection;
  connection.name = "input port " + std::to_string(port) + ", connection " + std::to_string(index);
  connection.data = data;
  const auto addPart = [&](const std::string& name, vtkDataObject* leaf) {
    vtkPolyData* polyData = vtkPolyData::SafeDownCast(leaf);
    if (!polyData)
    {
      throw InputError(name + " is " + (leaf ? std::string("a ") + leaf->GetClassName() : "null") +
        "; only vtkPolyData can be computed (vtkGeometryFilter makes one of most data)");
    }
    connection.parts.push_back(partOf(filter, name, polyData));
  };
  if (vtkDataObjectTree* tree = vtkDataObjectTree::SafeDownCast(data))
  {
    const auto leaves = vtk::TakeSmartPointer(tree->NewTreeIterator());
    leaves->VisitOnlyLeavesOn();
    for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
    {
      addPart(leafName(connection.name, leaves), leaves->GetCurrentDataObject());
    }
  }
  else
  {
    addPart(connection.name, data);
  }
  return connection;
}

/// Moves each part by this array of its own first.
void addInnerPoses(InputConnection& connection, const char* arrayName)
{
  const InputPart* with = nullptr;
  const InputPart* without = nullptr;
  for (InputPart& part : connection.parts)
  {
    vtkFieldData* fields = part.polyData->GetFieldData();
    const bool hasPose = fields->GetAbstractArray(arrayName) != nullptr;
    part.innerPose = arrayName;
    with = hasPose ? &part : with;
    without = hasPose || part.polyData->GetNumberOfCells() == 0 ? without : &part;
    part.worldFromPart =
      checkedPose(part.name, composed(part.worldFromPart, poseOf(part.name, fields, arrayName)));
  }
  if (with && without)
  {
    throw InputError(without->name + " has no field array " + arrayName + ", but " + with->name +
      " has one (vtkGLTFReader writes it only for the first primitive of a mesh)");
  }
}

}

InputConnection staticConnection(vtkAlgorithm* filter, int index, vtkDataObject* data)
{
  InputConnection connection = connectionOf(filter, 0, index, data);
  for (InputPart& part : connection.parts)
  {
    for (vtkFieldData* fields : { part.polyData->GetFieldData(), data->GetFieldData() })
    {
      if (hasFieldPose(fields))
      {
        part.oddities.push_back(part.name + " is static and stays where it is: its field array " +
          kFieldPoseName + " is not read");
        break;
      }
    }
  }
  return connection;
}

InputConnection dynamicConnection(vtkAlgorithm* filter, int index, vtkDataObject* data,
  vtkLinearTransform* transform, const char* innerPose)
{
  InputConnection connection = connectionOf(filter, 1, index, data);
  const AffineMap worldFromConnection =
    transform ? poseOf(connection.name, transform) : poseOf(connection.name, data->GetFieldData());
  for (InputPart& part : connection.parts)
  {
    part.worldFromPart = worldFromConnection;
    if (part.polyData != data)
    {
      const AffineMap connectionFromPart = poseOf(part.name, part.polyData->GetFieldData());
      part.worldFromPart =
        checkedPose(part.name, composed(worldFromConnection, connectionFromPart));
    }
  }
  if (innerPose && *innerPose)
  {
    addInnerPoses(connection, innerPose);
  }
  return connection;
}

void checkChosenArrays(vtkAlgorithm* filter, const std::vector<InputConnection>& statics,
  const std::vector<InputConnection>& dynamics)
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
    bool hasParts = false, isFound = false;
    for (const auto* connections : { &statics, &dynamics })
    {
      for (const InputConnection& connection : *connections)
      {
        for (const InputPart& part : connection.parts)
        {
          hasParts = true;
          isFound = isFound || findArray(filter, role, part.polyData->GetCellData());
        }
      }
    }
    if (hasParts && !isFound && !isDefault(filter, role) && !isNone(filter, role))
    {
      throw InputError(choice + " is not among the cell arrays of any input");
    }
  }
}

}
