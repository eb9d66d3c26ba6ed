// SPDX-License-Identifier: BSD-3-Clause
#include "Output/EmptyPiece.h"

#include "Data/ArrayNames.h"
#include "Data/LeafData.h"

#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <optional>

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

int bandsOf(vtkDataObject* data)
{
  if (auto* tree = vtkDataObjectTree::SafeDownCast(data))
  {
    std::optional<int> bands;
    forEachLeaf(tree, [&](vtkDataObjectTreeIterator* leaf) {
      bands = bands ? bands : bandsOf(leaf->GetCurrentDataObject());
    });
    return bands.value_or(1);
  }
  vtkPolyData* polyData = vtkPolyData::SafeDownCast(data);
  for (const char* suffix : kSideSuffixes)
  {
    if (vtkDataArray* array =
          polyData ? polyData->GetCellData()->GetArray(irradianceName(suffix).c_str()) : nullptr)
    {
      return array->GetNumberOfComponents();
    }
  }
  return 1;
}

}
