// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/ControllerRanks.h"

#include "Data/LeafData.h"
#include "Progress/InputError.h"

#include "vtkCharArray.h"
#include "vtkCommunicator.h"
#include "vtkDataSetAttributes.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace irradiance
{

namespace
{

/// VTK's format has no arrays without values. They travel as field data with one tuple, with these
/// prefixes, by attributes as in vtkDataObject::GetAttributes().
constexpr std::array<std::pair<int, const char*>, 2> kCarried{
  { { vtkDataObject::POINT, "irradiance:point:" }, { vtkDataObject::CELL, "irradiance:cell:" } }
};
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
  for (const auto& [type, prefix] : kCarried)
  {
    vtkDataSetAttributes* attributes = leaf->GetAttributes(type);
    const bool isEmpty = leaf->GetNumberOfElements(type) == 0;
    for (int i = 0; isEmpty && i < attributes->GetNumberOfArrays(); ++i)
    {
      const char* name = attributes->GetArrayName(i);
      add(attributes->GetAbstractArray(i), prefix + std::string(name ? name : ""), 1,
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
  for (const auto& [type, text] : kCarried)
  {
    const std::string prefix = text;
    for (int i = 0; i < fields->GetNumberOfArrays();)
    {
      const std::string name = fields->GetArrayName(i) ? fields->GetArrayName(i) : "";
      if (name.compare(0, prefix.size(), prefix) != 0)
      {
        ++i;
        continue;
      }
      add(fields->GetAbstractArray(i), name.substr(prefix.size()), 0, leaf->GetAttributes(type));
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

/// Data as bytes for another process, in VTK's own format.
vtkSmartPointer<vtkCharArray> messageOf(vtkDataObject* data)
{
  const auto loaded = snapshotOf(data);
  forEachDataSet(loaded, load);
  auto message = vtkSmartPointer<vtkCharArray>::New();
  throwIf(!vtkCommunicator::MarshalDataObject(loaded, message),
    std::string("VTK could not write a ") + data->GetClassName() + " for the other processes");
  return message;
}

vtkSmartPointer<vtkDataObject> dataOf(vtkCharArray* message)
{
  auto data = vtkCommunicator::UnMarshalDataObject(message);
  throwIf(!data, "VTK could not read the data of another process");
  forEachDataSet(data, unload);
  return data;
}

void broadcast(vtkCharArray* message, vtkMultiProcessController* controller, int from)
{
  constexpr vtkIdType most = 1 << 30; // MPI counts with an int
  const vtkIdType size = message->GetNumberOfTuples();
  for (vtkIdType begin = 0; begin < size; begin += most)
  {
    controller->Broadcast(message->GetPointer(begin), std::min(most, size - begin), from);
  }
}

}

std::uint32_t ControllerRanks::rank() const
{
  return controller_ ? static_cast<std::uint32_t>(controller_->GetLocalProcessId()) : 0;
}

std::uint32_t ControllerRanks::count() const
{
  return controller_ ? static_cast<std::uint32_t>(controller_->GetNumberOfProcesses()) : 1;
}

void ControllerRanks::allReduce(std::int64_t* numbers, std::size_t size)
{
  const std::vector<vtkTypeInt64> own(numbers, numbers + size);
  std::vector<vtkTypeInt64> sums(size);
  controller_->AllReduce(
    own.data(), sums.data(), static_cast<vtkIdType>(size), vtkCommunicator::SUM_OP);
  std::copy(sums.begin(), sums.end(), numbers);
}

std::vector<vtkSmartPointer<vtkDataObject>> ControllerRanks::dataOfAll(vtkDataObject* own)
{
  if (!areSeveral())
  {
    return own ? std::vector<vtkSmartPointer<vtkDataObject>>{ own }
               : std::vector<vtkSmartPointer<vtkDataObject>>{};
  }
  // What can fail is done before a message is on its way: a broadcast has no word for it.
  const auto ours = own ? messageOf(own) : vtkSmartPointer<vtkCharArray>::New();
  const std::vector<std::int64_t> sizes = concatenate({ ours->GetNumberOfTuples() });
  std::vector<vtkSmartPointer<vtkCharArray>> messages(sizes.size());
  for (std::size_t i = 0; i < messages.size(); ++i)
  {
    messages[i] = i == rank() ? ours : vtkSmartPointer<vtkCharArray>::New();
    messages[i]->SetNumberOfTuples(static_cast<vtkIdType>(sizes[i]));
  }
  expectSame(0, "no memory for the data of others");
  for (std::size_t i = 0; i < messages.size(); ++i)
  {
    broadcast(messages[i], controller_, static_cast<int>(i));
  }
  std::vector<vtkSmartPointer<vtkDataObject>> all;
  for (std::size_t i = 0; i < messages.size(); ++i)
  {
    if (sizes[i] > 0)
    {
      all.push_back(i == rank() ? vtkSmartPointer<vtkDataObject>(own) : dataOf(messages[i]));
    }
    messages[i] = nullptr; // its memory
  }
  return all;
}

}
