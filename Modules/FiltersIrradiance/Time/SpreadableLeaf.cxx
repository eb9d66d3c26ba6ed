// SPDX-License-Identifier: BSD-3-Clause
#include "Time/SpreadableLeaf.h"

#include "Data/ArrayNames.h"
#include "Data/LeafData.h"
#include "Input/PolyDataConverter.h"
#include "Progress/InputError.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkPolyData.h"

#include <utility>

namespace irradiance
{

bool isSpreadable(vtkDataSet* leaf)
{
  auto* surface = vtkPolyData::SafeDownCast(leaf);
  return surface && surface->GetNumberOfPolys() + surface->GetNumberOfStrips() > 0;
}

ExposedSurface surfaceOf(const std::string& name, vtkDataSet* leaf, const CancelPoint& cancelPoint)
{
  ConvertedPolyData cells(1);
  vtkPolyData* surface = vtkPolyData::SafeDownCast(leaf);
  cells.reserve({ surface });
  convertPolyData(name, surface, {}, 0, cells, cancelPoint);
  return { std::move(cells.triangles), std::move(cells.material.cellOfTriangle),
    cells.material.numberOfCells };
}

void expectReplicates(vtkDataObject* data)
{
  for (const LeafData& leaf : leavesOf(data))
  {
    for (const char* suffix : kSideSuffixes)
    {
      const auto array = [&](const std::string& name) {
        return leaf.data->GetCellData()->GetArray(name.c_str());
      };
      if (!isSpreadable(leaf.data) || !array(irradianceName(suffix)))
      {
        continue;
      }
      vtkDataArray* replicates = array(replicatesName(suffix));
      if (!replicates ||
        replicates->GetNumberOfComponents() <
          2 * array(irradianceName(suffix))->GetNumberOfComponents())
      {
        throw InputError(leaf.name + " has no replicates of " + irradianceName(suffix) +
          ", by which NumberOfSpreadPhotons counts its photons: switch ComputeStandardError of "
          "vtkIrradianceFilter on, or set NumberOfSpreadPhotons to 0; data from files have none");
      }
    }
  }
}

}
