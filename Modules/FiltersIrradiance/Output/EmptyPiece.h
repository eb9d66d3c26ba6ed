// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Data/ArrayNames.h"
#include "Data/LeafData.h"

#include "vtkCellData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <functional>
#include <string>

/// What outputs are where they have no cells, see isEmptyPieceRequested(). What reads their arrays
/// by name, or counts bands, finds the same as elsewhere.
namespace irradiance
{

/// Gives a data set without points the arrays of another, without values.
inline void copyEmptyArrays(vtkDataSet* from, vtkDataSet* to)
{
  to->GetPointData()->CopyAllOn();
  to->GetPointData()->CopyAllocate(from->GetPointData(), 0);
  to->GetCellData()->CopyAllOn();
  to->GetCellData()->CopyAllocate(from->GetCellData(), 0);
}

/// Takes points and cells from data, and the field data of the root.
inline void removeElements(vtkDataObject* data)
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

/// Polydata with the arrays of another, without points and cells.
inline vtkSmartPointer<vtkPolyData> withoutCells(vtkPolyData* polyData)
{
  auto empty = vtkSmartPointer<vtkPolyData>::New();
  copyEmptyArrays(polyData, empty);
  return empty;
}

/// Makes `empty` a tree with polydata without cells; add() gives each further arrays.
inline void emptyLeaves(
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

/// The array of the irradiance in polydata, or in the first leaf of a tree of them, or of what
/// `nameOf` makes of that name; null if there is none.
template <class NameOf>
vtkDataArray* findIrradiance(vtkDataObject* data, const NameOf& nameOf)
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

/// Number of components that the irradiance has in polydata, or in the first leaf of a tree of
/// them; else 1.
inline int bandsOf(vtkDataObject* data)
{
  vtkDataArray* array = findIrradiance(data, [](const std::string& name) { return name; });
  return array ? array->GetNumberOfComponents() : 1;
}

/// Whether there are standard errors of the irradiance.
inline bool haveErrors(vtkDataObject* data)
{
  return findIrradiance(data, standardErrorName) != nullptr;
}

/// Whether there is an array of what a light group brings.
inline bool haveGroup(vtkDataObject* data, const std::string& group)
{
  return findIrradiance(data, [&](const std::string& name) { return nameOfGroup(name, group); }) !=
    nullptr;
}

}
