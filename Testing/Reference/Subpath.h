// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "PathVertex.h"
#include "Random.h"

#include <optional>
#include <vector>

namespace pathtracedroom
{

/// A random walk from a lamp or from the sensor. Roulette ends it with the probability that a
/// surface absorbs, so there is no longest one.
class Subpath
{
public:
  void begin(const Departure& departure, const Random& random);
  /// Chooses the direction of the next ray; false if the subpath ends.
  bool leave(irradiance::Ray& ray);
  /// Adds the vertex that the last ray has hit; false if the subpath ends before it.
  bool arrive(PathVertex vertex);

  const std::vector<PathVertex>& vertices() const { return vertices_; }

private:
  /// The direction in which the subpath continues from a surface, if it is not absorbed.
  std::optional<Vector3> reflect(PathVertex& vertex);

  std::vector<PathVertex> vertices_;
  Random random_;
  std::optional<Vector3> firstDirection_;
  Spectrum throughput_;     ///< with which the last ray arrives
  double directionDensity_; ///< of the last ray, per steradian
};

}
