// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_MaterialArrays_h
#define irradiance_MaterialArrays_h

#include <array>
#include <cstddef>

namespace irradiance
{

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

}

#endif
