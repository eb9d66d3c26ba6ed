// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Sampling/DirectionTable.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

class vtkPolyData;

namespace irradiance
{

struct ConvertedPolyData;

/// The field-data arrays that make luminaires of the cells of a polydata, which also has cell arrays
/// that tell how they stand. vtkLuminaireReader describes them.
struct LuminaireFields
{
  std::string where;
  vtkPolyData* input;
  std::shared_ptr<const DirectionTable> intensity;
  std::vector<double> flux{}; ///< W of each lamp, one per band
};

/// How many bands the flux has; 1 if there is none.
int bandsOfLuminaires(vtkPolyData* input);

/// None, if it has no table of intensities. Throws InputError, naming `where`, the array and the
/// value.
std::optional<LuminaireFields> readLuminaires(
  const std::string& where, vtkPolyData* input, int bands);

/// Makes luminaires of a part of the target: of each cell in which a point shines, and of the
/// triangles from `firstTriangle` on, by their LampId.
void addLuminaires(const LuminaireFields& fields, std::size_t firstCell, std::size_t firstTriangle,
  ConvertedPolyData& target);

}
