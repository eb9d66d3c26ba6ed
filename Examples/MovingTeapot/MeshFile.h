// SPDX-License-Identifier: BSD-3-Clause
/** A user's mesh, from whichever file format it comes in. */
#ifndef MeshFile_h
#define MeshFile_h

#include "Meshes.h"

#include <vtkSmartPointer.h>

#include <string>

class vtkPolyData;

namespace movingteapot
{

/**
 * Reads .obj .ply .stl .vtp .vtk or .off. Throws std::runtime_error that names the file when it is
 * missing, of another kind, damaged, or has no polygon.
 */
vtkSmartPointer<vtkPolyData> ReadMeshFile(const std::string& path);

/** The mesh (z up) scaled uniformly to fit into the box, standing in the middle of its floor. */
vtkSmartPointer<vtkPolyData> FitMesh(vtkPolyData* mesh, const Box& box);

}

#endif
