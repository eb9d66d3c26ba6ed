// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

/// The names of arrays of outputs that several places use. Names of cell arrays end with the side
/// of the cell.
namespace irradiance
{

/// Of both sides together, and of each.
constexpr std::array<const char*, 3> kSideSuffixes{ "", "Front", "Back" };

inline std::string irradianceName(const std::string& suffix = "")
{
  return "Irradiance" + suffix;
}

inline std::string staleName(const std::string& suffix)
{
  return "Stale" + irradianceName(suffix);
}

inline std::string exposureName(const std::string& suffix = "")
{
  return "RadiantExposure" + suffix;
}

/// Of an array of irradiance or exposure.
inline std::string standardErrorName(const std::string& name)
{
  return name + "StandardError";
}

/// What each replicate alone says of the irradiance: one component for each replicate and band, the
/// bands of the first replicate first, W/m2. It is there with ComputeStandardError, if a filter
/// requests it.
inline std::string replicatesName(const std::string& suffix)
{
  return irradianceName(suffix) + "Replicates";
}

/// The irradiance that one photon of full power is, in each band, W/m2. It is there if a filter
/// requests it, with or without standard errors.
inline std::string photonName(const std::string& suffix)
{
  return irradianceName(suffix) + "OfPhoton";
}

inline std::string pointIrradianceName(const std::string& suffix = "")
{
  return "PointIrradiance" + suffix;
}

/// The part of an array of light that the lamps of a group bring.
inline std::string nameOfGroup(const std::string& array, const std::string& group)
{
  return array + "_" + group;
}

/// Of lamps: cell or field data.
constexpr const char* kLightGroup = "LightGroup";
constexpr const char* kLightGroupFactor = "LightGroupFactor";

constexpr const char* kRadiance = "Radiance";
constexpr const char* kFluenceRate = "FluenceRate";
constexpr const char* kNumberOfPhotons = "NumberOfPhotons";
constexpr const char* kSearchRadius = "SearchRadius";

/// Field data of vtkIrradianceFilter that others read, too.
constexpr const char* kEmittedPower = "EmittedPower";
constexpr const char* kAbsorbedPower = "AbsorbedPower";
constexpr const char* kEscapedPower = "EscapedPower";
constexpr const char* kStalePower = "StalePower";
constexpr const char* kNumberOfWalks = "NumberOfWalks";

/// Field data of vtkSunSkySource, and of skies that users make.
constexpr const char* kSkyRadiance = "SkyRadiance";
constexpr const char* kSkyPolarAngles = "SkyPolarAngles";
constexpr const char* kSkyAzimuths = "SkyAzimuths";
constexpr const char* kSkyWeights = "SkyWeights";
constexpr const char* kSkyBounds = "SkyBounds";
constexpr const char* kSunDirection = "SunDirection";
constexpr const char* kSunIrradiance = "SunIrradiance";
constexpr const char* kSunAngularRadius = "SunAngularRadius";

}
