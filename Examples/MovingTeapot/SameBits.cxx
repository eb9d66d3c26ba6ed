// SPDX-License-Identifier: BSD-3-Clause
#include "SameBits.h"

#include <vtkCellData.h>
#include <vtkCompositeDataIterator.h>
#include <vtkDataArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <cstring>
#include <vector>

namespace movingteapot
{
namespace
{

std::vector<vtkDataArray*> IrradiancesOf(vtkMultiBlockDataSet* scene)
{
  std::vector<vtkDataArray*> arrays;
  auto leaves = vtkSmartPointer<vtkCompositeDataIterator>::Take(scene->NewIterator());
  for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
  {
    auto* mesh = vtkPolyData::SafeDownCast(leaves->GetCurrentDataObject());
    arrays.push_back(mesh->GetCellData()->GetArray("Irradiance"));
  }
  return arrays;
}

bool HaveSameBits(vtkDataArray* a, vtkDataArray* b)
{
  return a && b && a->GetDataType() == b->GetDataType() &&
    a->GetNumberOfValues() == b->GetNumberOfValues() &&
    std::memcmp(a->GetVoidPointer(0), b->GetVoidPointer(0),
      std::size_t(a->GetNumberOfValues()) * a->GetDataTypeSize()) == 0;
}

}

bool HaveSameBits(vtkMultiBlockDataSet* a, vtkMultiBlockDataSet* b)
{
  const auto left = IrradiancesOf(a);
  const auto right = IrradiancesOf(b);
  bool same = left.size() == right.size() && !left.empty();
  for (std::size_t i = 0; same && i < left.size(); ++i)
  {
    same = HaveSameBits(left[i], right[i]);
  }
  return same;
}

}
