// SPDX-License-Identifier: BSD-3-Clause
#include "Output/EmptyPiece.h"

#include "Data/ArrayNames.h"

#include "vtkCellData.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

namespace irradiance
{

bool isEmptyPieceRequested(vtkInformation* output)
{
  auto* piece = vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER();
  return output->Has(piece) != 0 && output->Get(piece) > 0;
}

void requestWhole(vtkInformation* input)
{
  input->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), 0);
  input->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), 1);
  input->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
}

vtkSmartPointer<vtkPolyData> withoutCells(vtkPolyData* polyData)
{
  auto empty = vtkSmartPointer<vtkPolyData>::New();
  empty->GetPointData()->CopyAllOn();
  empty->GetPointData()->CopyAllocate(polyData->GetPointData(), 0);
  empty->GetCellData()->CopyAllOn();
  empty->GetCellData()->CopyAllocate(polyData->GetCellData(), 0);
  return empty;
}

int bandsOf(vtkDataObject* data)
{
  if (auto* tree = vtkDataObjectTree::SafeDownCast(data))
  {
    const auto leaves = vtk::TakeSmartPointer(tree->NewTreeIterator());
    leaves->VisitOnlyLeavesOn();
    leaves->InitTraversal();
    return leaves->IsDoneWithTraversal() ? 1 : bandsOf(leaves->GetCurrentDataObject());
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

void addEmptyArray(vtkDataSetAttributes* attributes, const char* name, int components)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  attributes->AddArray(array);
}

}
