// SPDX-License-Identifier: BSD-3-Clause
#ifndef Smoothing_h
#define Smoothing_h

class vtkPolyData;

namespace movingteapot
{

/**
 * Spreads the cell array `name` (a density, W/m2) over neighbouring cells: each point takes the mean
 * of the cells around it, weighted by area, and each cell then the mean of its points; `passes`
 * times. Small cells, which few photons hit, become less noisy; the power of the whole stays, if all
 * cells have the same number of points. The array is replaced.
 */
void SmoothCellArray(vtkPolyData* mesh, const char* name, int passes);

}

#endif
