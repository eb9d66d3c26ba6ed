// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_GatherPaths_h
#define irradiance_GatherPaths_h

#include "FinalGather/CellRoles.h"
#include "FinalGather/KnownLight.h"
#include "Gathering/PointDirectLight.h"
#include "Surfaces/Absorption.h"
#include "Surfaces/CellShapes.h"

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

namespace irradiance
{

/// What the paths of a final gather go through.
struct GatherScene
{
  GatherSpace space;
  const SceneObjects& objects;
  const SceneCells& cells;
  const CellShapes& shapes;
  CellRoles roles;
  KnownLight known;
  const std::deque<PointDirectLight>& lights; ///< what shines, for points on near cells
  std::uint32_t rays;   ///< of each side of a cell, dealt to the replicates in blocks of equal size
  double quantaPerWatt; ///< of the light of all replicates
  std::uint64_t seed;
};

/**
 * Paths that look for the indirect light of some sides of cells, or of single points: backwards along the ways of
 * light. Each begins as a ray from a point of its side, in a direction with the density cos(theta) / pi. Where it hits
 * a cell that is read, it brings what that side of the cell received, times its reflectance. On any other cell it brings
 * what came to it straight from the lights, and goes on as a walk does: it survives with probability = reflectance.
 * So it does on a cell of which nothing is known, or that is nearer than wide, whose mean says little of the point that is
 * hit: there it looks for the lights.
 *
 * A lamp that it meets brings nothing: that light is direct. Only behind a specular reflection it counts, as
 * no sum knows of it.
 *
 * Owns the memory that this takes: keep one for each thread.
 */
class GatherPaths
{
public:
  /// Irradiance, in quanta/m2.
  using Bands = std::array<double, Power::kMaxBands>;

  /// Forgets all sides and points.
  void begin(const GatherScene& scene);
  /// Adds a side, numbered in order from 0 on. `cell`: of the shapes. `number`: chooses its samples.
  void addSide(const GatherScene& scene, std::size_t cell, bool isFront, std::uint64_t number);
  /// Adds a point, numbered in the same order. Of one that receives from all directions the fluence rate is found,
  /// by rays of the density 1 / (4 pi).
  void addPoint(const GatherScene& scene, const LitPoint& point, std::uint64_t number);
  /// Follows all paths to their ends. Throws std::runtime_error for one that does not end.
  void run(const GatherScene& scene);

  /// What a replicate found.
  Bands found(std::size_t side, std::uint32_t replicate) const
  {
    return sums_[side * replicates_ + replicate];
  }
  /// What of all replicates' together rests on stale walks.
  const Bands& stale(std::size_t side) const { return staleSums_[side]; }

private:
  struct Path
  {
    Bands weight;         ///< with which it brings what it finds
    std::uint64_t seed;   ///< of its side
    std::uint32_t number; ///< of the ray among those of its side
    std::uint32_t sum;
    bool isSpecular; ///< how it left its last hit
  };

  /// Where a ray ends.
  struct Arrival
  {
    CellSide side;
    double area;    ///< of the cell, m2
    bool isKnown;   ///< what the side received is read
    bool isUnknown; ///< nothing of it is
    Hit hit;

    bool isFront() const { return side.side == 0; }
  };

  /// `perRay`: the irradiance for each radiosity that a ray meets. `rayOf(i)`: the ray of this number.
  template <class RayOf>
  void addStart(const GatherScene& scene, std::uint64_t seed, double perRay, const RayOf& rayOf);
  void cast(const GatherScene& scene);
  static Arrival arrivalOf(const GatherScene& scene, const Ray& ray, const Hit& hit);
  void bring(const GatherScene& scene, const Path& path, const Arrival& arrival);
  void bringFromLights(const GatherScene& scene, const Path& path, const Arrival& arrival);
  void addEmission(const GatherScene& scene, const Path& path, const Arrival& arrival);
  double quantaPerWatt(const GatherScene& scene) const { return scene.quantaPerWatt / replicates_; }
  /// Appends what goes on.
  void goOn(const GatherScene& scene, const Path& path, const Ray& ray, const Arrival& arrival);

  std::uint32_t replicates_ = 1, bounce_ = 0;
  int bands_ = 1;
  std::vector<Bands> sums_, staleSums_;
  std::vector<Path> paths_, next_;
  std::vector<Ray> rays_, nextRays_;
  std::vector<Hit> hits_;
};

}

#endif
