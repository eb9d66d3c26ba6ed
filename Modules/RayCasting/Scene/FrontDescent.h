// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Kernels/FrontStages.h"
#include "Meshes/TriangleMesh.h"
#include "Simd/Column.h"

#include <algorithm>
#include <vector>

namespace irradiance
{

/**
 * The first stages of a cast in one tree, each a loop over all rays: prepare and search. The first
 * reference that a search finds goes to a column, others, which are few, to a list; what must be
 * tested at once to test(). Rays that floats cannot follow are searched in double, one by one.
 *
 * Owns the memory of the stages, which is used again from call to call.
 */
class FrontDescent : private FrontTester
{
protected:
  /// `corners`: what lies in memory for references, to prefetch.
  void descend(const TriangleTree& tree, const TreeRays& rays, const CornerRows& corners)
  {
    const std::uint32_t room = TreeRays::roomFor(rays.count);
    queries_.need(room);
    others_.need(room);
    candidate_.need(room);
    further_.need(std::size_t{ 2 } * room);
    FrontSearches searches{ tree, queries_.data(), 0, others_.data(), 0, candidate_.data(),
      further_.data(), 0, static_cast<std::uint32_t>(further_.room()), corners, *this };
    frontStages().prepare(rays, searches);

    std::fill_n(candidate_.data(), room, TreeRays::kNone);
    frontStages().search(searches);
    furtherCount_ = searches.furtherCount;
    for (std::uint32_t i = 0; i < searches.otherCount; ++i)
    {
      searchExactly(tree, rays, searches.others[i], *this);
    }
  }

  Column<std::uint32_t> candidate_; ///< by ray, the first found, or kNone; to TreeRays::roomFor()
  Column<FurtherCandidate> further_;
  std::uint32_t furtherCount_ = 0;

private:
  Column<PreparedQuery> queries_;
  Column<std::uint32_t> others_;
};

/// The closest hits of rays in a tree of one object: what is found is confirmed in double, first the
/// column, then the list.
class FrontSearch final : private FrontDescent
{
public:
  /// `rays`: in the space of the body, with the best hits so far, which are replaced by closer
  /// ones. `corners`: of the triangles of the mesh, to the bit.
  void run(const TriangleTree& tree, const TriangleMesh& mesh, const TreeRays& rays,
    const CornerRows& corners)
  {
    if (rays.count == 0 || tree.isEmpty())
    {
      return;
    }
    mesh_ = &mesh;
    rays_ = rays;
    descend(tree, rays_, corners);
    frontStages().confirm(rays_, candidate_.data(), corners);
    confirmEach(rays_, furtherCount_, [&](std::size_t i, IntersectionLanes& lanes, unsigned lane) {
      const auto& [ray, reference] = further_[i];
      lanes.set(lane, originOf(rays_, ray), directionOf(rays_, ray), mesh[reference]);
      return FurtherCandidate{ ray, rays_.first + reference };
    });
  }

private:
  void test(std::uint32_t ray, std::uint32_t reference) override
  {
    double distance;
    Vector3 weights;
    if (ShearedRay(originOf(rays_, ray), directionOf(rays_, ray))
          .intersects((*mesh_)[reference], distance, &weights))
    {
      rays_.keepCloser(ray, rays_.first + reference, distance, weights[1], weights[2]);
    }
  }

  const TriangleMesh* mesh_ = nullptr; ///< during a run
  TreeRays rays_;
};

/// What rays may hit in a tree whose triangles, or bodies, are tested elsewhere: pairs of a ray and
/// a reference.
class FrontPairs final : private FrontDescent
{
public:
  using Pair = FurtherCandidate;

  /// The pairs, in no order; one may occur more than once. Nothing is sought behind the rays' best
  /// hits.
  const std::vector<Pair>& find(const TriangleTree& tree, const TreeRays& rays)
  {
    pairs_.clear();
    if (rays.count == 0 || tree.isEmpty())
    {
      return pairs_;
    }
    // Nothing is worth to be prefetched: what is found waits in a list.
    descend(tree, rays, { reinterpret_cast<const double*>(tree.blocks()), 0 });
    for (std::uint32_t ray = 0; ray < rays.count; ++ray)
    {
      if (candidate_[ray] != TreeRays::kNone)
      {
        pairs_.push_back({ ray, candidate_[ray] });
      }
    }
    pairs_.insert(pairs_.end(), further_.data(), further_.data() + furtherCount_);
    return pairs_;
  }
  /// Of bodies, by their balls, which see no hits. No pair occurs twice.
  const std::vector<Pair>& find(const BodyBalls& balls, const TreeRays& rays)
  {
    near_.need(std::size_t{ TreeRays::roomFor(rays.count) } / NearRays::kLeastLanes * balls.size());
    const std::uint32_t count = frontStages().findNear(rays, balls, near_.data());
    pairs_.clear();
    for (std::uint32_t i = 0; i < count; ++i)
    {
      for (unsigned lanes = near_[i].lanes; lanes != 0; lanes &= lanes - 1)
      {
        pairs_.push_back(
          { near_[i].first + static_cast<std::uint32_t>(__builtin_ctz(lanes)), near_[i].body });
      }
    }
    return pairs_;
  }

private:
  void test(std::uint32_t ray, std::uint32_t reference) override
  {
    pairs_.push_back({ ray, reference });
  }

  std::vector<Pair> pairs_;
  Column<NearRays> near_;
};

}
