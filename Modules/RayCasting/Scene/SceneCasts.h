#ifndef irradiance_SceneCasts_h
#define irradiance_SceneCasts_h

#include "Kernels/MeetingLanes.h"
#include "Kernels/UnitCast.h"
#include "Scene/Scene.h"

namespace irradiance
{

/**
 * The searches that a batch of rays asks for: which ray in which tree; and the decisions, in double,
 * on the triangles that the searches find. Those are put off until their triangles have come from
 * memory.
 */
class Scene::Casts final : public CastSource
{
public:
  /// `best`: in, hits known before; out, what is closer.
  Casts(const Scene& scene, const Ray* rays, Hit* best, const double* from = nullptr);

  /// The ray in the tree of an object.
  void add(std::uint32_t ray, std::uint32_t object);
  void add(std::uint32_t ray, const MixedTree& mixed);
  /// All rays in the static tree, in this order if it is not empty. Nothing else may be added.
  void runAllStatic(std::uint32_t count, const std::vector<std::uint32_t>& order);
  /// The ray in all trees of the group that it may touch, but for those of many objects; false if
  /// there are none.
  bool addGroup(std::uint32_t ray, const Group& group);
  /// In another order than theirs, the memory does not guess which rays come next: this asks for the
  /// one some places behind `number`.
  void fetchAhead(const std::vector<std::uint32_t>& order, std::size_t number) const;
  /// Runs what was added.
  void run();
  /// The same, unless that is still little. Between rays only.
  void runIfMany();

  std::size_t next(CastRequest* requests, std::size_t most) override;
  void begin(UnitCast& cast) override;
  void finish(const UnitCast& cast, const std::uint32_t* references, std::size_t count) override;
  void test(UnitCast& cast, std::uint32_t reference) override;
  void narrow(const UnitCast& cast) override;

private:
  struct Job
  {
    std::uint32_t ray;
    std::uint32_t object;   ///< whose tree, if not a mixed one
    const MixedTree* mixed; ///< or null
    UnitCast* cast;         ///< when it runs
    double bound;           ///< the ray's best hit is not behind it
  };

  /// A triangle that may be the hit of a ray.
  struct Decision
  {
    std::uint32_t ray;
    TriangleId id;
  };

  Job jobOf(std::uint32_t number) const
  {
    return all_ == 0 ? jobs_[number]
                     : Job{ order_->empty() ? number : (*order_)[number], 0, nullptr, nullptr, 0 };
  }
  void request(const Job& job, CastRequest& request) const;
  TriangleId idOf(const Job& job, std::uint32_t reference) const
  {
    return job.mixed ? job.mixed->ids[reference] : TriangleId{ job.object, reference };
  }
  /// On all that was put off.
  void decide();
  /// A meeting, which may be the ray's best hit.
  void take(const Decision& decision, double distance, double weightB, double weightC);

  static constexpr std::size_t kPutOff = std::size_t{ 8 } * MeetingLanes::kSize;

  const Scene& scene_;
  const Ray* rays_;
  Hit* best_;
  const double* from_;
  std::vector<Job>& jobs_;
  std::uint32_t all_ = 0;                             ///< rays of runAllStatic()
  const std::vector<std::uint32_t>* order_ = nullptr; ///< in which they are searched, or empty
  std::uint32_t next_ = 0;
  std::size_t putOff_ = 0, decided_ = 0;
  std::array<Decision, kPutOff> decisions_;
  MeetingLanes lanes_;
};

}

#endif
