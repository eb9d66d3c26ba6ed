// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Triangle.h"
#include "Input/InputConnection.h"
#include "Progress/CancelPoint.h"
#include "Surfaces/Emission.h"
#include "Surfaces/Material.h"

#include <string>
#include <vector>

class vtkDataArray;
class vtkPolyData;

namespace irradiance
{

/// The triangles of some polydata, how its cells reflect, what goes through, and what they emit. These keep their order.
struct ConvertedPolyData
{
  explicit ConvertedPolyData(int bands)
  {
    material.bands = bands;
    emission.bands = bands;
  }

  /// For the cells of these inputs at once: growth by doubling would copy all, which takes long.
  void reserve(const std::vector<vtkPolyData*>& inputs);

  std::vector<Triangle> triangles;
  Material material;
  Emission emission;
  std::vector<double> specular; ///< of material.setSpecular(), once all is converted; empty: none
  std::vector<double> exponents;
  /// Likewise of material.setSheets().
  std::vector<double> diffuseThrough, straight, index, internal;
};

/// Coordinates may not be larger, m: products of lengths, areas and powers have to stay finite.
constexpr double kMostDistant = 1e30;

/// Appends the cells of `input` to those of `target`, with the bands of `target`. Throws
/// InputError, naming `where` (as in "input port 1, connection 0"), the cell and the value, for
/// anything that cannot be computed. Ghost cells that are duplicates or hidden take no part.
std::vector<InputWarning> convertPolyData(const std::string& where, vtkPolyData* input,
  const MaterialArrays<vtkDataArray>& arrays, double defaultReflectance, ConvertedPolyData& target,
  const CancelPoint& cancelPoint);

}
