// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_ChosenArrays_h
#define irradiance_ChosenArrays_h

#include <array>
#include <cstddef>
#include <string>

class vtkAlgorithm;

namespace irradiance
{

struct InputPart;
struct SceneInputs;

/// The cell arrays that the filter reads. Their names and numbers are defined here alone.
enum MaterialArray : std::size_t
{
  Exitance,
  Reflectance,
  Specular,
  Exponent,
  Flux,
  kMaterialArrays
};

struct MaterialArrayRole
{
  int index;               ///< for SetInputArrayToProcess
  const char* defaultName; ///< where none is chosen
  const char* meaning;
};

constexpr std::array<MaterialArrayRole, kMaterialArrays> kArrayRoles{ {
  { 0, "RadiantExitance", "radiant exitance" },
  { 1, "DiffuseReflectance", "diffuse reflectance" },
  { 2, "SpecularReflectance", "specular reflectance" },
  { 3, "PhongExponent", "Phong exponent" },
  { 4, "RadiantFlux", "radiant flux" },
} };

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

#endif
