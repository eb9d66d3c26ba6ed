// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "PathVertex.h"
#include "Random.h"

#include <cstddef>
#include <optional>

namespace pathtracedroom
{

/// What measures light, in bins: the pixels of a camera, or cells of the scene.
class Sensor
{
public:
  virtual ~Sensor() = default;

  virtual std::size_t numberOfBins() const = 0;
  /// Where rays start off all surfaces.
  virtual irradiance::Box pointBounds() const { return {}; }

  /// Where an eye subpath for this bin starts, and its first direction.
  virtual Departure start(std::size_t bin, Random& random) const = 0;

  /// Light that arrives at a vertex of a light subpath may count for any bin: for the pixel that
  /// sees the vertex (the eye subpath is then the pinhole alone, 1 vertex), or for the cell in
  /// which it lies (0 vertices). So this strategy uses the light subpaths of all bins.
  virtual int sharedEyeVertices() const = 0;
  struct Place
  {
    std::size_t bin;
    PathVertex vertex; ///< the first one of an eye subpath for the bin
  };
  virtual std::optional<Place> placeOf(const PathVertex& lightVertex) const = 0;
};

}
