// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/DataMessage.h"

#include "Data/LeafData.h"
#include "Progress/InputError.h"

#include "vtkCharArray.h"
#include "vtkCommunicator.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <array>
#include <string>

namespace irradiance
{

namespace
{

/// VTK's format has no arrays without values. They travel as field data with one tuple.
struct Carried
{
  int attributes; ///< as in vtkDataObject::GetAttributes()
  const char* prefix;
};
constexpr std::array<Carried, 2> kCarried{ { { vtkDataObject::POINT, "irradiance:point:" },
  { vtkDataObject::CELL, "irradiance:cell:" } } };

/// So do coordinates, where there are points, but none: VTK's reader may leave them away or make
/// some up.
constexpr const char* kNoPoints = "irradiance:points";

void add(vtkAbstractArray* like, const std::string& name, vtkIdType tuples, vtkFieldData* fields)
{
  const auto array = vtk::TakeSmartPointer(like->NewInstance());
  array->SetNumberOfComponents(like->GetNumberOfComponents());
  array->SetNumberOfTuples(tuples);
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
  {
    array->SetVariantValue(i, 0);
  }
  array->SetName(name.c_str());
  fields->AddArray(array);
}

void load(vtkDataSet* leaf)
{
  for (const Carried& carried : kCarried)
  {
    vtkDataSetAttributes* attributes = leaf->GetAttributes(carried.attributes);
    const bool isEmpty = leaf->GetNumberOfElements(carried.attributes) == 0;
    for (int i = 0; isEmpty && i < attributes->GetNumberOfArrays(); ++i)
    {
      const char* name = attributes->GetArrayName(i);
      add(attributes->GetAbstractArray(i), carried.prefix + std::string(name ? name : ""), 1,
        leaf->GetFieldData());
    }
  }
  auto* points = vtkPointSet::SafeDownCast(leaf);
  if (points && points->GetPoints() && points->GetNumberOfPoints() == 0)
  {
    add(points->GetPoints()->GetData(), kNoPoints, 1, leaf->GetFieldData());
  }
}

void unload(vtkDataSet* leaf)
{
  vtkFieldData* fields = leaf->GetFieldData();
  for (const Carried& carried : kCarried)
  {
    const std::string prefix = carried.prefix;
    for (int i = 0; i < fields->GetNumberOfArrays();)
    {
      const std::string name = fields->GetArrayName(i) ? fields->GetArrayName(i) : "";
      if (name.compare(0, prefix.size(), prefix) != 0)
      {
        ++i;
        continue;
      }
      add(fields->GetAbstractArray(i), name.substr(prefix.size()), 0,
        leaf->GetAttributes(carried.attributes));
      fields->RemoveArray(i);
    }
  }
  auto* points = vtkPointSet::SafeDownCast(leaf);
  if (points && points->GetNumberOfPoints() == 0)
  {
    points->SetPoints(nullptr);
    if (vtkDataArray* coordinates = fields->GetArray(kNoPoints))
    {
      vtkNew<vtkPoints> none;
      none->SetDataType(coordinates->GetDataType());
      points->SetPoints(none);
      fields->RemoveArray(kNoPoints);
    }
  }
}

void forEachDataSet(vtkDataObject* data, void (*visit)(vtkDataSet*))
{
  for (const LeafData& leaf : leavesOf(data))
  {
    leaf.data ? visit(leaf.data) : void();
  }
}

}

vtkSmartPointer<vtkCharArray> messageOf(vtkDataObject* data)
{
  const auto loaded = snapshotOf(data);
  forEachDataSet(loaded, load);
  auto message = vtkSmartPointer<vtkCharArray>::New();
  if (!vtkCommunicator::MarshalDataObject(loaded, message))
  {
    throw InputError(
      std::string("VTK could not write a ") + data->GetClassName() + " for the other processes");
  }
  return message;
}

vtkSmartPointer<vtkDataObject> dataOf(vtkCharArray* message)
{
  auto data = vtkCommunicator::UnMarshalDataObject(message);
  if (!data)
  {
    throw InputError("VTK could not read the data of another process");
  }
  forEachDataSet(data, unload);
  return data;
}

}
