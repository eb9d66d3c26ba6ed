// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Execution/Execution.h"
#include "FinalGather/FinalGatherScene.h"
#include "FinalGather/FollowedPaths.h"
#include "FinalGather/PathLights.h"
#include "Surfaces/Absorption.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace irradiance
{

/**
 * Follows paths that look for the indirect light of some sides of cells, or of single points:
 * backwards along the ways of light. Each begins as a ray from a point of its side, in a direction
 * with the density cos(theta) / pi, and ends where it hits a cell that is read. On any other cell
 * it goes on as a walk does: it survives with probability = reflectance, or transmittance. So it
 * does on a cell of which nothing is known, or that is nearer than wide, whose mean says little of
 * the point that is hit: there the lights are asked. What they bring, see PathSums. They are asked
 * through clear sheets, so on these a path goes on straight as if there were none.
 *
 * Owns the memory that this takes: keep one for each thread.
 */
class FinalGatherPaths
{
public:
  /// Follows all paths that addStarts(FinalGatherPaths) adds to their ends, in the order in which
  /// they were added. Throws std::runtime_error for one that does not end. `memory`: of paths that
  /// nobody needs any more.
  template <class AddStarts>
  static FollowedPaths follow(Pool<FinalGatherPaths>& pool, const FinalGatherScene& scene,
    const AddStarts& addStarts, FollowedPaths memory = {})
  {
    std::unique_ptr<FinalGatherPaths> paths = pool.take();
    paths->begin(scene);
    addStarts(*paths);
    FollowedPaths followed = paths->run(std::move(memory));
    pool.giveBack(std::move(paths));
    return followed;
  }
  /// Adds the paths of some rays of a side. `cell`: of the shapes. `number`: chooses its samples.
  /// `rays`: by number; each scene.rays of them are a start.
  void addSide(
    std::size_t cell, bool isFront, std::uint64_t number, const std::vector<std::uint32_t>& rays);
  /// Likewise of a point. From one that receives from all directions, rays have the density 1 / (4
  /// pi): four times what they bring is the fluence rate.
  void addPoint(
    const LitPoint& point, std::uint64_t number, const std::vector<std::uint32_t>& rays);
  /// Adds the paths of what a specular cell reflects to an eye: pi times its radiance for a
  /// specular reflectance of 1 is what they bring, the mean over the area. `toEye`: the unit vector
  /// from a point; 0: nothing is seen of it.
  using ToEye = std::function<Vector3(const Vector3& point)>;
  void addSpecular(std::size_t cell, std::uint64_t number, const ToEye& toEye);

private:
  struct Path
  {
    Bands weight;         ///< with which it brings what it finds
    std::uint64_t seed;   ///< of its start
    std::uint32_t number; ///< of the ray among those of its start
    std::uint32_t place;  ///< in the order of all paths
    bool isSpecular;      ///< it left a hit sharply, and since then only clear sheets
    bool isStraight;      ///< it left its last hit straight through a clear sheet
    double density; ///< of its direction if it left along a lobe, 1/sr; infinite from a mirror
  };

  /// A segment, its numbers, and the rays of lights to its end, of a path at this place.
  struct Step
  {
    std::uint32_t path;
    PathSegment segment;
    std::size_t value;  ///< in values_
    std::size_t shadow; ///< in shadows_
  };

  /// Where a ray ends.
  struct Arrival
  {
    CellSide side;
    bool isKnown;          ///< what the side received is read
    bool isUnknown;        ///< nothing of it is
    const PhongLobe* lobe; ///< along which the lights are asked, or null
    Hit hit;

    bool isFront() const { return side.side == 0; }
  };

  /// Forgets all paths.
  void begin(const FinalGatherScene& scene);
  FollowedPaths run(FollowedPaths memory);
  Path startOf(std::uint64_t seed, std::uint32_t ray);
  /// Asks the lights on the lobe of a start.
  void recordStart(
    const Path& path, const Vector3& place, const PathVertex& from, const PhongLobe& lobe);
  void cast();
  Arrival arrivalOf(const Ray& ray, const Hit& hit) const;
  PathVertex vertexOf(const Ray& ray, const Arrival& arrival) const;
  void record(const Path& path, const Ray& ray, const Arrival& arrival);
  /// Appends the numbers with which each step begins.
  void addStep(const Path& path, const PathSegment& segment);
  void askLights(const Path& path, const PathVertex& at, const Arrival& arrival);
  /// The steps by path, in the order of these.
  FollowedPaths sorted(FollowedPaths memory);
  /// Appends what goes on.
  void goOn(const Path& path, const Ray& ray, const Arrival& arrival);
  /// Appends the path to `paths` and its ray to `rays`.
  void goOnSpecularly(Path path, const PathVertex& from, const PhongLobe& lobe,
    std::vector<Path>& paths, std::vector<Ray>& rays) const;

  const FinalGatherScene* scene_ = nullptr; ///< that they go through
  std::uint32_t bounce_ = 0, numberOfPaths_ = 0;
  int bands_ = 1;
  std::vector<Path> paths_, next_;
  std::vector<Ray> rays_, nextRays_;
  std::vector<Hit> hits_;
  std::vector<Step> steps_; ///< bounce by bounce
  std::vector<double> values_;
  std::vector<ShadowRay> shadows_; ///< if paths are kept
};

}
