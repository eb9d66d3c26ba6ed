// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "PathVertex.h"
#include "Random.h"
#include "Surfaces/SceneObjects.h"

#include <vector>

namespace pathtracedroom
{

/// All that shines in a scene: triangles of cells with exitance, and point lights. A subpath starts
/// from each in proportion to its flux, summed over the bands, and evenly over its area.
class Lamps
{
public:
  explicit Lamps(const irradiance::SceneObjects& objects);

  bool isEmpty() const { return lamps_.empty(); }
  /// W, in all bands together.
  double flux() const { return cumulativeFlux_.empty() ? 0 : cumulativeFlux_.back(); }
  /// Of the point lights.
  const irradiance::Box& pointBounds() const { return pointBounds_; }

  /// Where a light subpath starts, and its first direction.
  Departure start(Random& random) const;
  /// A vertex that an eye subpath came to, as the light subpath that starts there would have it.
  PathVertex lampAt(const PathVertex& vertex) const;

private:
  struct Lamp
  {
    TriangleId id;
    irradiance::Triangle triangle; ///< in the world; all corners of a point light coincide
    Spectrum light;                ///< exitance in W/m2; of a point light, flux in W
  };

  void add(const Lamp& lamp, double flux);
  void addTriangles(const irradiance::SceneObjects& objects, std::uint32_t object);
  void addPoints(const irradiance::SceneObject& object);

  std::vector<Lamp> lamps_;
  std::vector<double> cumulativeFlux_; ///< W, up to and including each lamp
  irradiance::Box pointBounds_;
};

}
