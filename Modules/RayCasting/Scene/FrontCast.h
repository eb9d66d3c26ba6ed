// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Scene/FrontDescent.h"
#include "Scene/Scene.h"
#include "Scene/SurfaceRecords.h"

namespace irradiance
{

/// How a cast knows the triangles of a scene.
struct FrontTriangles
{
  const TriangleNumbers& numbers;
  CornerRows corners; ///< of the static ones

  /// From the records of the scene's objects in this frame, which those who use the hits read as
  /// well.
  FrontTriangles(const SurfaceRecords& records);
  FrontTriangles(const TriangleNumbers& all, const TriangleMesh& still);
};

/**
 * Casts all rays of a front together. What it finds is what brute force finds, bit for bit.
 *
 * Beside few dynamic bodies it goes from one to the next with the rays that may touch it, then to
 * the static tree, up to what was found. Beside many, or flattened objects, the static tree comes
 * first (not if TraversalMode::Sequential); the balls of bodies or a tree over them, or a tree over
 * flattened triangles, then tell which ray may touch what before its hit.
 *
 * Owns the memory of its stages: keep one for each thread.
 */
class FrontCast
{
public:
  /// The closest hits of rays among all triangles, from none on.
  void cast(const Scene& scene, const Ray* rays, std::size_t count, Hit* hits);
  /// Rays in world space, of no tree: `first` and `triangles` are 0.
  void cast(const Scene& scene, const FrontTriangles& triangles, const TreeRays& rays);
  /// The dynamic objects alone.
  void castDynamic(const Scene& scene, const FrontTriangles& triangles, const TreeRays& rays)
  {
    castGroup(scene, scene.dynamic_, triangles, rays);
  }
  /// Those marked as moved, see Scene::commit().
  void castMoved(const Scene& scene, const FrontTriangles& triangles, const TreeRays& rays)
  {
    castGroup(scene, scene.moved_, triangles, rays);
  }
  /// Sets distances and weights to those at which rays hit the triangles in `rays.hit`. The
  /// distance is infinite if a ray misses its triangle, or has none.
  void findDistances(const Scene& scene, const FrontTriangles& triangles, const TreeRays& rays);

private:
  void castSome(const Scene& scene, const Ray* rays, std::uint32_t count, Hit* hits);
  void castStatic(const Scene& scene, const FrontTriangles& triangles, const TreeRays& rays);
  void castGroup(const Scene& scene, const Scene::Group& group, const FrontTriangles& triangles,
    const TreeRays& rays);
  void castMixed(const Scene& scene, const Scene::MixedTree& mixed, const FrontTriangles& triangles,
    const TreeRays& rays);
  void castBody(
    const Scene& scene, std::uint32_t index, const FrontTriangles& triangles, const TreeRays& rays);
  void castBodies(const Scene& scene, const Scene::Group& group, const FrontTriangles& triangles,
    const TreeRays& rays);
  void castPicked(const Scene& scene, std::uint32_t index, const FrontTriangles& triangles,
    const TreeRays& rays, std::uint32_t count);
  void addTest(const Scene& scene, std::uint32_t ray, std::uint32_t number, const TriangleId& id);
  void runTests(const Scene& scene, const FrontTriangles& triangles, const TreeRays& rays);

  /// Rays with exact directions: those that may touch a body, in its space.
  struct LocalRays
  {
    Column<std::uint32_t> ray; ///< which of the front
    Column<double> origin[3], direction[3], distance;
    Column<std::uint32_t> start, hit;
    Column<float> weight[2];

    void need(std::uint32_t room);
    TreeRays columns(std::uint32_t count, std::uint32_t first, std::uint32_t triangles);
  };

  /// Rays, body by body; each at most once.
  class RaysOfBodies
  {
  public:
    /// `pairs`: of rays, fewer than `rays`, and bodies, fewer than `bodies`.
    void set(const std::vector<FrontPairs::Pair>& pairs, std::uint32_t rays, std::uint32_t bodies);
    /// Calls visit(ray) for each ray of the body. To be called once for each.
    template <class Visit>
    void forEach(std::uint32_t body, const Visit& visit)
    {
      for (std::uint32_t place = firsts_[body]; place < firsts_[body + 1]; ++place)
      {
        const std::uint32_t ray = rays_[place];
        if (last_[ray] != body)
        {
          last_[ray] = body;
          visit(ray);
        }
      }
    }

  private:
    std::vector<std::uint32_t> firsts_, rays_;
    std::vector<std::uint32_t> last_; ///< by ray, the body of the last visit
  };

  FrontSearch search_;
  FrontPairs pairs_;
  LocalRays local_, own_; ///< own: rays that come in no columns
  RaysOfBodies raysOfBodies_;
  std::vector<FrontPairs::Pair> tests_; ///< rays, and numbers of triangles
  Column<std::uint32_t> candidate_, start_;
};

}
