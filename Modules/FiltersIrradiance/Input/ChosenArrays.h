// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>

class vtkAlgorithm;

namespace irradiance
{

struct InputPart;
struct SceneInputs;

/// The cell arrays that the filter reads, by their numbers for SetInputArrayToProcess.
enum MaterialArray : std::size_t
{
  Exitance,
  Reflectance,
  Specular,
  Exponent,
  Flux,
  DiffuseThrough,
  Straight,
  Index,
  Internal,
  kMaterialArrays
};

/// Their names where none is chosen, and what they mean.
constexpr std::array<const char*, kMaterialArrays> kArrayNames{ "RadiantExitance",
  "DiffuseReflectance", "SpecularReflectance", "PhongExponent", "RadiantFlux",
  "DiffuseTransmittance", "SpecularTransmittance", "RefractiveIndex", "InternalTransmittance" };
constexpr std::array<const char*, kMaterialArrays> kArrayMeanings{ "radiant exitance",
  "diffuse reflectance", "specular reflectance", "Phong exponent", "radiant flux",
  "diffuse transmittance", "specular transmittance", "refractive index", "internal transmittance" };

/// The arrays of one input, by MaterialArray; null where it has none.
template <class Array>
using MaterialArrays = std::array<Array*, kMaterialArrays>;

/// Finds the arrays that the filter was told to read in a part, and notes among its warnings which
/// ones it will overlook: on the points, or nearly called as the array of a quantity that the part
/// has no array for.
void findArrays(vtkAlgorithm* filter, InputPart& part);

/// Throws InputError if the filter was told to read an array of the points or of the field data, or
/// one that no input has.
void checkChosenArrays(vtkAlgorithm* filter, const SceneInputs& inputs);

/// What to say of a scene without light: which arrays it could come from, and which ones are there
/// but not read.
std::string noLightWarning(vtkAlgorithm* filter, const SceneInputs& inputs);

}
