#ifndef irradiance_SceneCasts_h
#define irradiance_SceneCasts_h

#include "Scene.h"
#include "UnitCast.h"

namespace irradiance
{

/// The searches that a batch of rays asks for: which ray in which tree.
class Scene::Casts final : public CastSource
{
public:
  /// `best`: in, hits known before; out, what is closer.
  Casts(const Scene& scene, const Ray* rays, Hit* best, const double* from = nullptr);

  /// The ray in the tree of an object.
  void add(std::uint32_t ray, std::uint32_t object);
  void add(std::uint32_t ray, const MixedTree& mixed);
  /// The ray in all trees of the group that it may touch, but for those of many objects.
  void addGroup(std::uint32_t ray, const Group& group);
  void run();

  bool next(UnitCast& cast) override;
  void test(UnitCast& cast, std::uint32_t reference) override;

private:
  struct Job
  {
    std::uint32_t ray;
    std::uint32_t object;   ///< whose tree, if not a mixed one
    const MixedTree* mixed; ///< or null
    UnitCast* cast;         ///< when it runs
  };

  bool prepare(const Job& job, UnitCast& cast) const;
  void shorten(std::uint32_t job, std::uint32_t ray) const;

  const Scene& scene_;
  const Ray* rays_;
  Hit* best_;
  const double* from_;
  std::vector<Job>& jobs_;
  std::uint32_t next_ = 0;
};

}

#endif
