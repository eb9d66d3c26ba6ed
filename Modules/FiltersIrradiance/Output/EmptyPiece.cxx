// SPDX-License-Identifier: BSD-3-Clause
#include "Output/EmptyPiece.h"

#include "Data/ArrayNames.h"
#include "Data/LeafData.h"

#include "vtkCellData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <string>

namespace irradiance
{

void copyEmptyArrays(vtkDataSet* from, vtkDataSet* to)
{
  to->GetPointData()->CopyAllOn();
  to->GetPointData()->CopyAllocate(from->GetPointData(), 0);
  to->GetCellData()->CopyAllOn();
  to->GetCellData()->CopyAllocate(from->GetCellData(), 0);
}

void removeElements(vtkDataObject* data)
{
  const auto whole = snapshotOf(data);
  const std::vector<LeafData> leaves = leavesOf(whole);
  data->Initialize();
  fillLeaves(whole, data, [&](std::size_t i) {
    vtkDataSet* leaf = leaves[i].data;
    const auto empty = vtk::TakeSmartPointer(leaf ? leaf->NewInstance() : nullptr);
    if (empty)
    {
      copyEmptyArrays(leaf, empty);
    }
    return empty;
  });
  data->GetFieldData()->Initialize();
}

vtkSmartPointer<vtkPolyData> withoutCells(vtkPolyData* polyData)
{
  auto empty = vtkSmartPointer<vtkPolyData>::New();
  copyEmptyArrays(polyData, empty);
  return empty;
}

void emptyLeaves(
  vtkDataObjectTree* tree, vtkDataObjectTree* empty, const std::function<void(vtkPolyData*)>& add)
{
  empty->ShallowCopy(tree);
  forEachLeaf(empty, [&](vtkDataObjectTreeIterator* leaf) {
    if (auto* polyData = vtkPolyData::SafeDownCast(leaf->GetCurrentDataObject()))
    {
      const auto bare = withoutCells(polyData);
      add(bare);
      empty->SetDataSet(leaf, bare);
    }
  });
}

namespace
{

/// The array of the irradiance in polydata, or in the first leaf of a tree of them, or of what
/// `nameOf` makes of that name; null if there is none.
template <class NameOf>
vtkDataArray* findArray(vtkDataObject* data, const NameOf& nameOf)
{
  vtkPolyData* first = vtkPolyData::SafeDownCast(data);
  if (auto* tree = vtkDataObjectTree::SafeDownCast(data))
  {
    forEachLeaf(tree, [&](vtkDataObjectTreeIterator* leaf) {
      first = first ? first : vtkPolyData::SafeDownCast(leaf->GetCurrentDataObject());
    });
  }
  vtkDataArray* found = nullptr;
  for (const char* suffix : kSideSuffixes)
  {
    found = found || !first
      ? found
      : first->GetCellData()->GetArray(nameOf(irradianceName(suffix)).c_str());
  }
  return found;
}

}

int bandsOf(vtkDataObject* data)
{
  vtkDataArray* array = findArray(data, [](const std::string& name) { return name; });
  return array ? array->GetNumberOfComponents() : 1;
}

bool haveErrors(vtkDataObject* data)
{
  return findArray(data, standardErrorName) != nullptr;
}

bool haveGroup(vtkDataObject* data, const std::string& group)
{
  return findArray(data, [&](const std::string& name) { return nameOfGroup(name, group); }) !=
    nullptr;
}

}
