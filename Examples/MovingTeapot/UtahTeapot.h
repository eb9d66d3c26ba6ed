// SPDX-License-Identifier: BSD-3-Clause
/** The Utah teapot cut into triangles. */
#ifndef UtahTeapot_h
#define UtahTeapot_h

#include <vtkSmartPointer.h>

class vtkPolyData;

namespace movingteapot
{

/**
 * The teapot with `segments` cuts along each patch edge: 64 segments^2 - 8 segments triangles (6320
 * by default). Neighbouring patches share their points, the triangles that collapse at the two
 * poles are left out, and the front of every triangle looks out of the china. Units and axes are
 * those of UtahTeapotPatches.h.
 */
vtkSmartPointer<vtkPolyData> MakeUtahTeapot(int segments = 10);

}

#endif
