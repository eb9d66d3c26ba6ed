// SPDX-License-Identifier: BSD-3-Clause
#include "Input/InputConnection.h"

#include "Data/LeafData.h"
#include "Input/Pose.h"
#include "Progress/InputError.h"

#include "vtkAlgorithm.h"
#include "vtkDataObjectTree.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationObjectBaseKey.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <numeric>

namespace irradiance
{

namespace
{

vtkInformationObjectBaseKey* originKey()
{
  static auto* const key = new vtkInformationObjectBaseKey("GEOMETRY_ORIGIN", "vtkKeyFramedPose");
  return key;
}

/// A filter may copy the note to an output with other geometry; then it is not valid.
bool isSameGeometry(vtkPolyData* a, vtkPolyData* b)
{
  return a->GetPoints() == b->GetPoints() && a->GetVerts() == b->GetVerts() &&
    a->GetLines() == b->GetLines() && a->GetPolys() == b->GetPolys() &&
    a->GetStrips() == b->GetStrips() && a->GetCellGhostArray() == b->GetCellGhostArray();
}

InputConnection connectionOf(vtkAlgorithm* filter, int port, int index, vtkDataObject* data)
{
  InputConnection connection;
  connection.name = "input port " + std::to_string(port) + ", connection " + std::to_string(index);
  connection.data = data;
  const auto addPart = [&](const std::string& name, vtkDataObject* leaf) {
    vtkPolyData* polyData = vtkPolyData::SafeDownCast(leaf);
    throwIf(!polyData, name, " is ", leaf ? "a " : "null", leaf ? leaf->GetClassName() : "",
      "; only vtkPolyData can be computed (vtkGeometryFilter makes one of most data, in ParaView "
      "the filter Extract Surface)");
    InputPart part;
    part.name = name;
    part.polyData = part.piece = polyData;
    part.connectionFields = leaf == data ? nullptr : data->GetFieldData();
    part.lampGroup = port == 0 ? kStaticLampGroup : "Dynamic " + std::to_string(index);
    findArrays(filter, part);
    connection.parts.push_back(part);
  };
  if (vtkDataObjectTree* tree = vtkDataObjectTree::SafeDownCast(data))
  {
    forEachLeaf(tree, [&](vtkDataObjectTreeIterator* leaf) {
      addPart(connection.name + ", " + leafName(leaf), leaf->GetCurrentDataObject());
    });
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
  std::string with, without; // names of parts
  for (InputPart& part : connection.parts)
  {
    vtkFieldData* fields = part.polyData->GetFieldData();
    const bool hasPose = fields->GetAbstractArray(arrayName) != nullptr;
    part.innerPose = arrayName;
    with = hasPose ? part.name : with;
    without = hasPose || part.polyData->GetNumberOfCells() == 0 ? without : part.name;
    part.worldFromPart =
      checkedPose(part.name, composed(part.worldFromPart, poseOf(part.name, fields, arrayName)));
  }
  throwIf(!with.empty() && !without.empty(), without, " has no field array ", arrayName, ", but ",
    with, " has one (vtkGLTFReader writes it only for the first primitive of a mesh)");
}

}

InputConnection staticConnection(vtkAlgorithm* filter, int index, vtkDataObject* data)
{
  InputConnection connection = connectionOf(filter, 0, index, data);
  for (InputPart& part : connection.parts)
  {
    if (hasFieldPose(part.polyData->GetFieldData()) || hasFieldPose(data->GetFieldData()))
    {
      part.warnings.push_back({ part.name,
        std::string(" is static and stays where it is: its field array ") + kFieldPoseName +
          " is not read" });
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

void notePassedGeometry(vtkPolyData* output, vtkPolyData* input)
{
  output->GetInformation()->Set(originKey(), originOfGeometry(input));
}

vtkPolyData* originOfGeometry(vtkPolyData* polyData)
{
  vtkInformation* info = polyData->GetInformation();
  auto* origin =
    info->Has(originKey()) ? vtkPolyData::SafeDownCast(info->Get(originKey())) : nullptr;
  return origin && isSameGeometry(origin, polyData) ? origin : polyData;
}

void InputWarnings::add(const InputWarning& warning)
{
  auto kind = std::find_if(kinds_.begin(), kinds_.end(),
    [&](const auto& some) { return some.first.what == warning.what; });
  if (kind == kinds_.end())
  {
    kind = kinds_.insert(kind, { warning, {} });
  }
  kind->second[warning.input] = warning.cells;
}

std::vector<std::string> InputWarnings::take()
{
  std::vector<std::string> texts;
  for (const auto& [first, cells] : std::exchange(kinds_, {}))
  {
    const bool isOfCells = first.cells > 0;
    std::string text =
      first.input + (isOfCells ? ": " + std::to_string(first.cells) + " cells " : "") + first.what;
    if (isOfCells)
    {
      text += ", the first is cell " + std::to_string(first.firstCell) + "; " + first.consequence;
    }
    if (cells.size() > 1)
    {
      const vtkIdType all = std::accumulate(cells.begin(), cells.end(), vtkIdType{},
        [](vtkIdType sum, const auto& some) { return sum + some.second; });
      text += " (there are " + std::to_string(cells.size()) + " such inputs" +
        (isOfCells ? ", with " + std::to_string(all) + " such cells" : "") + ")";
    }
    texts.push_back(text);
  }
  return texts;
}

}
