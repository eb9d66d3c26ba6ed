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
 * the triangles that they find, which is put off until those have come from memory.
 */
class Scene::QueryBatch final : public QuerySource
{
public:
  /// `best`: on input the hits known before, on output the closer ones. No hit of ray i comes
  /// before `from[i]`, in units of its direction, if `from` is given.
  QueryBatch(const Scene& scene, const Ray* rays, Hit* best, const double* from = nullptr);

  /// Adds a search of the ray in the tree of an object.
  void add(std::uint32_t ray, std::uint32_t object);
  void add(std::uint32_t ray, const MixedTree& mixed);
  /// Searches all rays in the static tree, in this order if it is not empty. Add nothing else.
  void runAllStatic(std::uint32_t count, const std::vector<std::uint32_t>& order);
  /// Adds the ray to all trees of the group that it may touch, except instanced objects that stand
  /// in a tree of boxes; false if there are none.
  bool addGroup(std::uint32_t ray, const Group& group);
  /// Prefetches the ray some places after `number`: where rays are taken out of order, the hardware
  /// does not guess which come next.
  void prefetchAhead(const std::vector<std::uint32_t>& order, std::size_t number) const;
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
    return all_ == 0 ? jobs_[number]
                     : Job{ order_->empty() ? number : (*order_)[number], 0, nullptr, nullptr, 0 };
  }
  void request(const Job& job, QueryRequest& request) const;
  TriangleId idOf(const Job& job, std::uint32_t reference) const
  {
    return job.mixed ? job.mixed->ids[reference] : TriangleId{ job.object, reference };
  }
  /// Tests all pending hits in double.
  void confirm();
  /// Keeps this hit if it is the ray's closest.
  void take(const PendingHit& decision, double distance, double weightB, double weightC);

  static constexpr std::size_t kPutOff = std::size_t{ 8 } * IntersectionLanes::kSize;

  const Scene& scene_;
  const Ray* rays_;
  Hit* best_;
  const double* from_;
  std::vector<Job>& jobs_;
  std::uint32_t all_ = 0;                             ///< rays of runAllStatic()
  const std::vector<std::uint32_t>* order_ = nullptr; ///< in which they are searched, or empty
  std::uint32_t next_ = 0;
  std::size_t putOff_ = 0, confirmed_ = 0;
  std::array<PendingHit, kPutOff> pendingHits_;
  IntersectionLanes lanes_;
};

}

#endif
