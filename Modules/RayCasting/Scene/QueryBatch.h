// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_QueryBatch_h
#define irradiance_QueryBatch_h

#include "Kernels/IntersectionLanes.h"
#include "Kernels/TreeQuery.h"
#include "Scene/Scene.h"

namespace irradiance
{

/**
 * The tree queries of a batch of rays (which ray in which tree), and the confirmation in double of
 * the triangles that they find, which is put off until memory has delivered the triangles.
 */
class Scene::QueryBatch final : public QuerySource
{
public:
  /// Numbers of rays, in the order in which they are searched; empty: as they are.
  using Order = std::vector<std::uint32_t>;

  /// `best`: on input the hits known before, on output the closer ones. No hit of ray i comes
  /// before `from[i]`, in units of its direction, if `from` is given.
  QueryBatch(const Scene& scene, const Ray* rays, Hit* best, const double* from = nullptr);

  /// Adds searches of the rays at places from `first` to `end` of the order.
  void add(const MixedTree& mixed, std::uint32_t first, std::uint32_t end, const Order& order);
  /// Adds the rays at these places, eight at most, to all trees of the group that they may touch,
  /// except the trees that the tree over bodies leads to. If `alone` is given, they are added to the
  /// static tree as well, except rays that touch nothing, which are appended to `alone`.
  void addGroup(
    const Group& group, std::uint32_t first, std::uint32_t end, const Order& order, Order* alone);
  /// Searches all rays in the static tree.
  void runAllStatic(std::uint32_t count, const Order& order);
  /// Searches all rays in the tree over the bodies of the group, then in the trees of the bodies that
  /// they may touch.
  void runAllBodies(const Group& group, std::uint32_t count, const Order& order);
  /// Runs what was added.
  void run();
  /// Runs what was added once it is many. Call it only between rays.
  void runIfMany();

  std::size_t next(QueryRequest* requests, std::size_t most) override;
  void begin(TreeQuery& query) override;
  void finish(const TreeQuery& query, const std::uint32_t* references, std::size_t count) override;
  void test(TreeQuery& query, std::uint32_t reference) override;
  void narrow(const TreeQuery& query) override;

private:
  struct Job
  {
    std::uint32_t ray;
    std::uint32_t object;   ///< whose tree, if not a mixed one
    const MixedTree* mixed; ///< or null
    TreeQuery* query;       ///< the running query, or null
    double bound;           ///< the ray's best hit is not behind it
  };

  /// A triangle that may be the hit of a ray.
  struct PendingHit
  {
    std::uint32_t ray;
    TriangleId id;
  };

  Job jobOf(std::uint32_t number) const
  {
    return isForAll_ ? Job{ order_->empty() ? number : (*order_)[number], 0, nullptr, nullptr, 0 }
                     : jobs_[number];
  }
  /// The ray at a place of the order. Prefetches the ray some places after it: where rays are taken
  /// out of order, the hardware does not guess which come next.
  std::uint32_t rayAt(const Order& order, std::size_t place) const;
  /// Adds a search of the ray in the tree of an object.
  void add(std::uint32_t ray, std::uint32_t object);
  void add(std::uint32_t ray, const MixedTree& mixed);
  void request(const Job& job, QueryRequest& request) const;
  void runAll(std::uint32_t first, std::uint32_t end, const Order& order);
  /// Adds the search in the tree of a placed body, unless the ray misses its ellipsoid.
  void enter(std::uint32_t ray, std::uint32_t index);
  TriangleId idOf(const Job& job, std::uint32_t reference) const
  {
    return job.mixed ? job.mixed->ids[reference] : TriangleId{ job.object, reference };
  }
  /// Tests all pending hits in double.
  void confirm();
  /// Keeps this hit if it is the ray's closest.
  void take(const PendingHit& pending, double distance, double weightB, double weightC);

  static constexpr std::uint32_t kMany = 1024; ///< searches that stay in a processor's cache
  static constexpr std::size_t kMostPending = std::size_t{ 8 } * IntersectionLanes::kSize;

  const Scene& scene_;
  const Ray* rays_;
  Hit* best_;
  const double* from_;
  std::vector<Job>& jobs_;
  /// Instead of jobs, all rays are searched in one tree: the tree over bodies, or the static one.
  bool isForAll_ = false;
  const Group* group_ = nullptr; ///< whose bodies are searched; null otherwise
  const Order* order_ = nullptr; ///< of all rays; may be empty
  std::uint32_t next_ = 0, end_ = 0;
  std::vector<unsigned> passing_; ///< by body, the rays that pass its ball, one bit each
  std::size_t pendingCount_ = 0, confirmed_ = 0;
  std::array<PendingHit, kMostPending> pendingHits_;
  IntersectionLanes lanes_;
};

}

#endif
