// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_GeometryOrigin_h
#define irradiance_GeometryOrigin_h

class vtkPolyData;

namespace irradiance
{

/// Notes in `output` that it shares the points, cells and arrays of `input`, so that a reader who
/// knows `input` need not read `output`, which is newer in each time step. Copies do not have the
/// note.
void notePassedGeometry(vtkPolyData* output, vtkPolyData* input);

/// The polydata from which the geometry was passed on, through several filters perhaps; `polyData`
/// itself if there is no note.
vtkPolyData* originOfGeometry(vtkPolyData* polyData);

}

#endif
