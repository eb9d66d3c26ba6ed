// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Emitter_h
#define irradiance_Emitter_h

#include "Geometry/Ray.h"
#include "Light/Contacts.h"
#include "Light/Power.h"
#include "Light/SceneCell.h"
#include "Light/SceneObjects.h"
#include "Meshes/SurfacePoint.h"

#include <map>
#include <vector>

namespace irradiance
{

/// A triangle of a cell with exitance, or a point light, in world space.
struct Emitter
{
  TriangleId id;                               ///< none for a point light
  Triangle triangle;                           ///< a point light lies in all three corners
  std::array<double, Power::kMaxBands> flux{}; ///< W
  SceneCell cell;                              ///< to which it belongs

  bool isPoint() const { return id == TriangleId{}; }
  double totalFlux() const { return flux[0] + flux[1] + flux[2]; }
  friend bool operator==(const Emitter& a, const Emitter& b);
};

/**
 * All lights of a frame. Every walk carries the same share of the total flux, a photon; which light
 * it starts from is sampled in proportion to flux.
 */
class EmitterTable
{
public:
  EmitterTable() = default;
  /// `contacts` finds walls in whose plane point lights lie; those shine to the other side alone.
  /// Null: no walls. Throws std::runtime_error for a light to which walls leave no side.
  EmitterTable(const SceneObjects& objects, std::uint64_t numberOfWalks,
    Contacts* contacts = nullptr, const Checkpoint& checkpoint = {});

  bool isEmpty() const { return emitters_.empty(); }
  const std::vector<Emitter>& emitters() const { return emitters_; }
  /// Bounds of the point lights.
  const Box& pointBounds() const { return pointBounds_; }
  /// W, of all lights in all bands.
  double flux() const { return emitters_.empty() ? 0 : cumulative_.back(); }
  /// Quanta with which every walk starts, in all bands together: the power of two for which all
  /// walks have 2^45 to 2^46. This leaves 2^16 times the emitted power for the cells to receive
  /// before a sum overflows.
  std::int64_t photon() const { return photon_; }

  /// Quanta with which a walk from any light may start, in each band.
  std::array<double, Power::kMaxBands> largestStart() const;

  /// The number of the emitter that a sample in (0, 1) chooses.
  std::size_t choose(double sample) const;
  /// With which walks leave an emitter.
  const Power& power(std::size_t emitter) const { return powers_[emitter]; }
  /// The ray that leaves a point light in the direction that a point of the unit square chooses.
  Ray pointRay(std::size_t emitter, const std::array<double, 2>& u) const;

  /// Equal tables start the same walks, bit for bit.
  friend bool operator==(const EmitterTable& a, const EmitterTable& b);

private:
  void addTriangles(const SceneObjects& objects, std::uint32_t object);
  void addPoints(const SceneObjects& objects, std::uint32_t object, Contacts* contacts,
    const Checkpoint& checkpoint);
  void add(const Emitter& emitter);
  Power powerOf(const Emitter& emitter) const;

  std::vector<Emitter> emitters_;
  /// By the index of a point light's emitter: the normals of its walls, to the side that it lights.
  std::map<std::size_t, std::vector<Vector3>> openSides_;
  std::vector<double> cumulative_; ///< W, up to and including each emitter
  std::vector<Power> powers_;
  std::int64_t photon_ = 1;
  Box pointBounds_;
};

}

#endif
