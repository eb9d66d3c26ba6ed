#ifndef EmbreeWalks_h
#define EmbreeWalks_h

#include "Light/Emitter.h"
#include "Tally/WalkTally.h"

/// Where a walk stands.
struct EmbreeWalk
{
  std::uint32_t walk;
  std::uint32_t bounce;   ///< of the next ray
  std::int64_t threshold; ///< of Russian roulette
  irradiance::Power power;
};

/// What the engine's walks do at their start and at each hit (same lights, samples, reflection,
/// roulette and sums), for rays that another program casts. Nothing is stored.
class EmbreeWalks
{
public:
  /// `objects` and `sums` must outlive this.
  EmbreeWalks(const irradiance::SceneObjects& objects, std::uint32_t numberOfWalks,
    std::uint64_t seed, irradiance::CellSums& sums);

  ~EmbreeWalks() { handIn(); }
  EmbreeWalks(const EmbreeWalks&) = delete;
  EmbreeWalks& operator=(const EmbreeWalks&) = delete;

  std::uint32_t numberOfWalks() const { return numberOfWalks_; }
  EmbreeWalk start(std::uint32_t walk, irradiance::Ray& ray) const;

  /// Books a hit at which a ray of this direction ends. False: so does the walk; else `ray` is the
  /// next.
  bool reportProgress(EmbreeWalk& walk, const irradiance::Vector3& direction,
    const irradiance::TriangleId& id, const irradiance::Vector3& weights, irradiance::Ray& ray);

  /// Have the memory bring what goOn() will read; the second when the first has come.
  void prefetchTriangle(const irradiance::TriangleId& id) const;
  void prefetchCell(const irradiance::TriangleId& id) const;

private:
  void handIn();

  const irradiance::SceneObjects& objects_;
  std::uint32_t numberOfWalks_;
  irradiance::EmitterTable emitters_;
  irradiance::SobolSequence samples_;
  irradiance::CellSums& sums_;
  std::vector<irradiance::Deposit> deposits_;
};

#endif
