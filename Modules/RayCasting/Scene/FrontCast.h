// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_FrontCast_h
#define irradiance_FrontCast_h

#include "Scene/FrontSearch.h"
#include "Scene/Scene.h"
#include "Scene/SurfaceRecords.h"

namespace irradiance
{

/// Rays in world space as columns, with room for TreeRays::roomFor(count) each. What stands beyond
/// `count` has no meaning and may be changed.
struct FrontRays
{
  std::uint32_t count;
  const double* origin[3];
  const float* direction[3];  ///< of length 1, up to rounding
  const std::uint32_t* start; ///< the number of the triangle that each leaves, or kNone
  /// In: the best hit so far, or infinite and kNone. Out: that or a closer one, by (distance, number).
  double* distance;
  std::uint32_t* hit;
  float* weight[2]; ///< of the second and third corner
};

/**
 * Casts all rays of a front together. What it finds is what Scene::cast() finds for rays with these
 * origins and directions, bit for bit; with hits given, what Scene::castDynamic() and castStatic() do.
 *
 * First the dynamic bodies, one after the other, with the rays that may touch them; then the static
 * tree, up to what was found. Where a scene has flattened objects, or so many bodies that they stand in
 * a tree, the dynamic ones are left to Scene.
 *
 * Owns the memory of its stages: keep one for each thread.
 */
class FrontCast
{
public:
  /// `records`: of the scene's objects in this frame.
  void cast(const Scene& scene, const SurfaceRecords& records, const FrontRays& rays);

private:
  void castStatic(const Scene& scene, const SurfaceRecords& records, const FrontRays& rays);
  void castBody(
    const Scene& scene, std::uint32_t index, const SurfaceRecords& records, const FrontRays& rays);
  void takeToBody(
    const Scene& scene, std::uint32_t object, const FrontRays& rays, std::uint32_t count);
  void giveBack(const FrontRays& rays, std::uint32_t count);
  void castDynamicByScene(const Scene& scene, const SurfaceRecords& records, const FrontRays& rays);

  /// The rays that may touch a body, in its space.
  struct LocalRays
  {
    Column<std::uint32_t> ray; ///< which of the front
    Column<double> origin[3], direction[3], distance;
    Column<std::uint32_t> start, hit;
    Column<float> weight[2];

    void need(std::uint32_t room);
    TreeRays columns(std::uint32_t count, std::uint32_t first, std::uint32_t triangles);
  };

  FrontSearch search_;
  LocalRays local_;
  std::vector<Ray> rays_; ///< for Scene
  std::vector<Hit> hits_;
};

}

#endif
