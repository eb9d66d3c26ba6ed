// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "DirectLight/DirectGather.h"
#include "Lights/LightTable.h"
#include "Sampling/WalkPlan.h"

#include <memory>
#include <optional>

namespace irradiance
{

/// Where the walks of a set start, and how many there are.
struct WalkSource
{
  LightTable lights;
  WalkPlan plan; ///< of the walks that divide the flux of the lights
  /// The cells where direct light is gathered and walks start; none: they start at the lights.
  std::optional<CellPart> cells;
  /// The lights: rays of a final gather meet them, see FirstHits, or escape to them: a sky.
  bool areFoundByRays = false;
  bool areNear = false;        ///< the lights, to what they shine on, see FirstHits
  std::uint32_t firstWalk = 0; ///< the number of the first of these walks
  /// With which a walk starts at cells, in all bands together.
  std::int64_t quantaPerStart = 0;
  double walksPerSample = 0;               ///< that a cell may receive for each of its samples
  FewestSamples fewest;                    ///< of cells
  std::shared_ptr<const LampPieces> lamps; ///< of the lights, if addLamps() made them

  /// Whether walks start at dynamic cells. Those at static ones have the same lights.
  bool isDynamic() const { return cells && *cells != kStaticPart; }
  std::shared_ptr<const LampPieces> knownLamps() const
  {
    return lamps ? lamps : std::make_shared<const LampPieces>(lights);
  }
  /// Whether cells look for a sky, so that walks start there: what they find counts for all cells
  /// but those whose rays escape to it.
  bool isSky() const { return cells && areFoundByRays; }
  /// With which a walk starts, in all bands together.
  std::int64_t quantaPerWalk() const { return cells ? quantaPerStart : lights.quantaPerWalk(); }

  /// Whether walks with the same number are the same here and there, but for the power of all; so
  /// one of them is the other with more walks. Of a single round that starts at lights.
  bool differsInNumber(const WalkSource& other) const
  {
    WalkSource like = *this;
    like.plan = other.plan;
    like.lights.setQuantaPerWalk(other.lights.quantaPerWalk());
    return like == other && !cells && plan.rounds().size() == 1 &&
      other.plan.rounds().size() == 1 &&
      plan.replicates().count() == other.plan.replicates().count() &&
      plan.replicates().firstWalk() == other.plan.replicates().firstWalk();
  }

  friend bool operator==(const WalkSource& a, const WalkSource& b)
  {
    return a.plan == b.plan && a.lights == b.lights && a.cells == b.cells &&
      a.areFoundByRays == b.areFoundByRays && a.areNear == b.areNear &&
      a.firstWalk == b.firstWalk && a.quantaPerStart == b.quantaPerStart &&
      a.walksPerSample == b.walksPerSample && a.fewest == b.fewest;
  }
};

}
