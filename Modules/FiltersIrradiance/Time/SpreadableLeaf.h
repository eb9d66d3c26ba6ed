// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SpreadableLeaf_h
#define irradiance_SpreadableLeaf_h

#include "Exposure/ExposureSpread.h"
#include "Progress/CancelPoint.h"

#include <string>

class vtkDataObject;
class vtkDataSet;

namespace irradiance
{

/// Whether exposure is spread over the cells of a leaf: it is vtkPolyData with polygons or strips.
bool isSpreadable(vtkDataSet* leaf);

/// The cells of such a leaf. `name`: for messages; throws InputError for cells that are no
/// polygons.
ExposedSurface surfaceOf(const std::string& name, vtkDataSet* leaf, const CancelPoint& cancelPoint);

/// Throws InputError if such a leaf of the data has irradiance, but not two replicates of it.
void expectReplicates(vtkDataObject* data);

}

#endif
