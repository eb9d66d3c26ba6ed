// SPDX-License-Identifier: BSD-3-Clause
/** The Object File Format of Geomview (ASCII), which VTK has no reader for. */
#ifndef OffFile_h
#define OffFile_h

#include <vtkSmartPointer.h>

#include <string>

class vtkPolyData;

namespace movingteapot
{

/**
 * Points and polygons of an .off file; colours are passed over. Throws std::runtime_error that says
 * what is wrong where.
 */
vtkSmartPointer<vtkPolyData> ReadOffFile(const std::string& path);

}

#endif
