// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_CellAreas_h
#define irradiance_CellAreas_h

#include <vector>

class vtkDataSet;

namespace irradiance
{

/// The areas of all cells, in the squared unit of the points; 0 for cells that have none.
std::vector<double> cellAreas(vtkDataSet* data);

}

#endif
