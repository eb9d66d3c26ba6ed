// SPDX-License-Identifier: BSD-3-Clause
/** The meshes of the scene: boxes cut into cells, the Utah teapot, a user's own from a file. */
#pragma once

#include <vtkSmartPointer.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

class vtkPolyData;

namespace movingteapot
{

/** xmin, xmax, ymin, ymax, zmin, zmax in m. */
using Box = std::array<double, 6>;

enum class Facing
{
  Inward,
  Outward
};

/** Diffuse reflectance (0..1) of the sides -x, +x, -y, +y, -z, +z; a side without is left out. */
using SideReflectances = std::array<std::optional<double>, 6>;

/**
 * The sides of a box as quads no longer than `cellSize` (m), with a cell array
 * `DiffuseReflectance`. Sides that meet share their points, so that no light gets through an edge.
 */
vtkSmartPointer<vtkPolyData> MakeGridBox(
  const Box& box, double cellSize, Facing facing, const SideReflectances& reflectances);

/** What its block is called in the output of vtkIrradianceFilter. */
void SetName(vtkPolyData* mesh, const std::string& name);

/** 4 x 4 control points of a Bezier patch, row after row. */
using Patch = std::array<std::array<double, 3>, 16>;

/** The patches of Data/UtahTeapot.bpt. Throws std::runtime_error when they cannot be read. */
std::vector<Patch> ReadTeapotPatches();

/**
 * The Utah teapot with `segments` cuts along each patch edge: 64 segments^2 - 8 segments triangles.
 * Neighbouring patches share their points, the triangles that collapse at the two poles are left
 * out, and the front of every triangle looks out of the china. Lengths have no unit, z is up, the
 * bottom is at 0, the spout looks along +x.
 */
vtkSmartPointer<vtkPolyData> MakeUtahTeapot(int segments = 10);

/**
 * Reads .obj .ply .stl .vtp .vtk or .off. Throws std::runtime_error that names the file when it is
 * missing, of another kind, damaged, or has no polygon.
 */
vtkSmartPointer<vtkPolyData> ReadMeshFile(const std::string& path);

/** The mesh (z up) scaled uniformly to fit into the box, standing in the middle of its floor. */
vtkSmartPointer<vtkPolyData> FitMesh(vtkPolyData* mesh, const Box& box);

}
