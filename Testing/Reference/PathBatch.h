// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Lamps.h"
#include "PathWeight.h"
#include "Scene/Scene.h"
#include "Sensor.h"
#include "Subpath.h"

#include <vector>

namespace pathtracedroom
{

/// What all paths of a picture have in common.
struct Tracing
{
  const irradiance::SceneObjects& objects;
  const irradiance::Scene& scene;
  const Lamps& lamps;
  const Sensor& sensor;
  const Strategies& strategies;
  std::uint64_t seed;
};

/**
 * Many pairs of an eye subpath and a light subpath, traced side by side, because rays are faster in
 * batches: all next segments at once, and at the end all connections at once.
 */
class PathBatch
{
public:
  explicit PathBatch(const Tracing& tracing)
    : tracing_(tracing)
  {
  }

  /// What paths contribute to a bin; to be divided by the number of pairs for the bin.
  struct Contribution
  {
    std::size_t bin;
    Spectrum value;
  };
  /// Traces the pairs `first` to `end` of a pass; pair i is for bin i modulo the number of bins.
  /// Appends to `contributions`, in an order that depends on nothing else.
  void trace(std::uint64_t pass, std::size_t first, std::size_t end,
    std::vector<Contribution>& contributions);

private:
  struct Pair
  {
    std::size_t bin;
    Subpath light, eye;
  };
  /// Counts if nothing lies between its ends.
  struct Connection
  {
    TriangleId target;
    Contribution contribution;
  };

  void begin(std::uint64_t pass, std::size_t first, std::size_t end);
  void extendAll();
  void join(const Pair& pair, std::vector<Contribution>& contributions);
  void addLampHits(const Pair& pair, std::vector<Contribution>& contributions) const;
  void addSensorHits(const Pair& pair, std::vector<Contribution>& contributions);
  void connect(std::size_t bin, PathPart light, PathPart eye);
  void castConnections(std::vector<Contribution>& contributions);

  Tracing tracing_;
  std::vector<Pair> pairs_;
  std::vector<Subpath*> growing_;
  std::vector<irradiance::Ray> rays_;
  std::vector<irradiance::Hit> hits_;
  std::vector<Connection> connections_;
};

}
