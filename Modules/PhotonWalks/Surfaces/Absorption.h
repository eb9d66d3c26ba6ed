// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Absorption_h
#define irradiance_Absorption_h

#include "Surfaces/Material.h"
#include "Surfaces/Power.h"

#include <algorithm>

namespace irradiance
{

/// The probabilities with which a walk survives a hit. One sample decides: below `diffuse` the walk
/// leaves diffusely, then up to their sum specularly, else it is absorbed.
struct SurvivalProbabilities
{
  double diffuse, specular = 0;

  double total() const { return diffuse + specular; }
  double of(bool isSpecular) const { return isSpecular ? specular : diffuse; }
  bool isSpecularAt(double sample) const { return specular != 0 && !(sample < diffuse); }
};

/// The part of the strongest band that a material of these reflectances (by band) reflects.
inline double reflectedPart(const Power& incoming, const double* reflectances, int bands)
{
  double strongest = 0, mostReflected = 0;
  for (int band = 0; band < bands; ++band)
  {
    strongest = std::max(strongest, reflectances[band] * static_cast<double>(incoming[band]));
    mostReflected = std::max(mostReflected, reflectances[band]);
  }
  // The quotient may be rounded up.
  return std::min(strongest / static_cast<double>(incoming.largest()), mostReflected);
}

/**
 * One band: the reflectances (section 3.1 of the paper), in all at most 1. Several: the parts of
 * the strongest band that are reflected diffusely and specularly. If these add up to more than 1,
 * as they may if they are of different bands, both are divided by their sum.
 */
inline SurvivalProbabilities survivalProbabilities(
  const Power& incoming, const Material& material, std::size_t cell)
{
  const std::size_t first = cell * static_cast<std::size_t>(material.bands);
  if (material.bands == 1)
  {
    return material.isSpecular() ? SurvivalProbabilities{ material.reflectance[first],
      material.totalReflectance()[first] - material.reflectance[first] }
                                 : SurvivalProbabilities{ material.reflectance[first] };
  }
  SurvivalProbabilities survival{ reflectedPart(
    incoming, &material.reflectance[first], material.bands) };
  if (material.isSpecular())
  {
    survival.specular =
      reflectedPart(incoming, &material.specularReflectance[first], material.bands);
    const double scale = std::max(1.0, survival.total());
    survival.diffuse /= scale;
    survival.specular /= scale;
  }
  return survival;
}

/// The power of a walk that survived by this reflection, with `probability` > 0. The reflected
/// power over the probability keeps the mean. Without scaling, see above, it leaves the strongest
/// band what it had: one band keeps its power.
inline Power survivingPower(const Power& incoming, const Material& material, std::size_t cell,
  bool isSpecular, double probability)
{
  if (material.bands == 1)
  {
    return incoming;
  }
  const std::vector<double>& reflectances =
    isSpecular ? material.specularReflectance : material.reflectance;
  const double* const first = &reflectances[cell * static_cast<std::size_t>(material.bands)];
  const bool isScaled =
    material.isSpecular() && probability < reflectedPart(incoming, first, material.bands);
  Power outgoing;
  for (int band = 0; band < material.bands; ++band)
  {
    const double reflected = first[band] * static_cast<double>(incoming[band]);
    const std::int64_t quanta = nearestQuanta(reflected / probability);
    outgoing[band] = isScaled ? quanta : std::min(quanta, incoming.largest());
  }
  return outgoing;
}

/// What becomes of a walk at a hit.
struct Reflection
{
  bool survives = false, isSpecular = false;
  Power outgoing; ///< if it survives
};

/// `sample`: of the survival.
inline Reflection reflectionOf(
  const Power& incoming, const Material& material, std::size_t cell, double sample)
{
  const SurvivalProbabilities survival = survivalProbabilities(incoming, material, cell);
  // In one band the sum of both parts may be rounded, and is not what decides.
  if (!(sample < (material.bands == 1 ? material.totalReflectance()[cell] : survival.total())))
  {
    return {};
  }
  const bool isSpecular = survival.isSpecularAt(sample);
  return { true, isSpecular,
    survivingPower(incoming, material, cell, isSpecular, survival.of(isSpecular)) };
}

}

#endif
