// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Surfaces/Material.h"
#include "Surfaces/Power.h"

#include <algorithm>

namespace irradiance
{

/// The probabilities with which a walk survives a hit, by how it leaves. One sample decides: they
/// lie one behind the other, and beyond their sum the walk is absorbed.
struct SurvivalProbabilities
{
  std::array<double, kLeavings> ways{};

  double total() const { return ways[0] + ways[1] + ways[2] + ways[3]; }
  double of(Leaving way) const { return ways[static_cast<std::size_t>(way)]; }
  /// Of a sample that survives. Their sum may be rounded down: the last way has the rest.
  Leaving at(double sample) const
  {
    std::size_t last = 0;
    double sum = 0;
    for (std::size_t way = 0; way < ways.size() && !(sample < sum); ++way)
    {
      last = ways[way] > 0 ? way : last;
      sum += ways[way];
    }
    return static_cast<Leaving>(last);
  }
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
 * One band: the reflectances (section 3.1 of the paper) and transmittances, in all at most 1.
 * Several: the parts of the strongest band. If these add up to more than 1, as they may if they are
 * of different bands, all are divided by their sum. `cosine`: of incidence; it matters for panes.
 */
inline SurvivalProbabilities survivalProbabilities(
  const Power& incoming, const Material& material, std::size_t cell, double cosine = 1)
{
  const std::size_t first = cell * static_cast<std::size_t>(material.bands);
  if (!material.hasOtherWays())
  {
    return { { material.bands == 1
        ? material.reflectance[first]
        : reflectedPart(incoming, &material.reflectance[first], material.bands) } };
  }
  const std::array<Bands, kLeavings> parts = material.partsOf(cell, cosine);
  SurvivalProbabilities survival;
  for (std::size_t way = 0; way < kLeavings; ++way)
  {
    survival.ways[way] = material.bands == 1
      ? parts[way][0]
      : reflectedPart(incoming, parts[way].data(), material.bands);
  }
  const double scale = material.bands == 1 ? 1 : std::max(1.0, survival.total());
  for (double& probability : survival.ways)
  {
    probability /= scale;
  }
  return survival;
}

/// The power of a walk that survived in this way, with `probability` > 0. The power that leaves
/// over the probability keeps the mean. Without scaling, see above, it leaves the strongest band
/// what it had: one band keeps its power.
inline Power survivingPower(const Power& incoming, const Material& material, std::size_t cell,
  Leaving way, double probability, double cosine = 1)
{
  if (material.bands == 1)
  {
    return incoming;
  }
  const Bands part = material.partOf(way, cell, cosine);
  const bool isScaled =
    material.hasOtherWays() && probability < reflectedPart(incoming, part.data(), material.bands);
  Power outgoing;
  for (int band = 0; band < material.bands; ++band)
  {
    const double left = part[static_cast<std::size_t>(band)] * static_cast<double>(incoming[band]);
    const std::int64_t quanta = nearestQuanta(left / probability);
    outgoing[band] = isScaled ? quanta : std::min(quanta, incoming.largest());
  }
  return outgoing;
}

/// What becomes of a walk at a hit.
struct Fate
{
  bool survives = false;
  Leaving way = Leaving::Diffuse; ///< if it survives
  Power outgoing{};

  friend bool operator==(const Fate& a, const Fate& b)
  {
    return a.survives == b.survives && a.way == b.way && a.outgoing == b.outgoing;
  }
};

/// `sample`: of the survival. Not of a pane, where it depends on the direction.
inline Fate fateOf(const Power& incoming, const Material& material, std::size_t cell, double sample)
{
  const SurvivalProbabilities survival = survivalProbabilities(incoming, material, cell);
  // In one band the sum of all ways may be rounded, and is not what decides.
  if (!(sample < (material.bands == 1 ? material.surviving()[cell] : survival.total())))
  {
    return {};
  }
  const Leaving way = survival.at(sample);
  return { true, way, survivingPower(incoming, material, cell, way, survival.of(way)) };
}

}
