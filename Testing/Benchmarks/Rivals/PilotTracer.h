// SPDX-License-Identifier: BSD-3-Clause
#ifndef PilotTracer_h
#define PilotTracer_h

#include "Scenes/TradeScene.h"
#include "Shooting/StoredRays.h"
#include "Shooting/WalkBatch.h"

/**
 * The rival of verification: selective photon tracing (Dmitriev, Brabec, Myszkowski, Seidel 2002).
 * A part of the walks, the pilots, is shot again in every frame. Where one of a group of like walks
 * has changed, the whole group is shot again, the groups of which most pilots changed first; the
 * others are taken to be valid. All but this choice is the engine's: the walks, their history, the
 * rays, the sums.
 *
 * In which way it is simplified, Report/SpeedAndAccuracy.md.in says.
 */
class PilotTracer
{
public:
  PilotTracer(const irradiance::SceneObjects& objects, std::uint32_t walks, std::uint64_t seed,
    const StartStrata& strata);

  /// Returns the number of walks that were shot. `pilots`: share of the walks. `seconds`: CPU time
  /// for the frame, at the end of which no further group is begun.
  std::size_t update(const irradiance::SceneObjects& objects, double pilots, double seconds);
  /// All walks again.
  void shootAll(const irradiance::SceneObjects& objects);

  const irradiance::CellSums& sums() const { return sums_; }
  double watts(std::int64_t quanta) const
  {
    return lights_.flux() *
      (static_cast<double>(quanta) / (static_cast<double>(lights_.quantaPerWalk()) * plan_.most()));
  }
  /// A number for each walk that differs if a hit or a power of the walks does.
  std::vector<std::uint64_t> signatures() const;

private:
  using Walks = std::vector<std::uint32_t>;

  Walks allWalks() const;
  std::uint32_t groupOf(std::uint32_t walk) const;
  /// In place of what is stored of them.
  void shoot(const Walks& walks);
  std::vector<std::uint64_t> signaturesOf(const Walks& walks) const;
  /// The groups with pilots that differ from these old signatures, those with the most first.
  std::vector<std::size_t> flag(const Walks& pilots, const std::vector<std::uint64_t>& old) const;
  std::uint64_t signatureOf(std::uint32_t walk) const;

  irradiance::WalkPlan plan_;
  StartStrata strata_;
  irradiance::SceneObjects objects_;
  irradiance::LightTable lights_;
  irradiance::SobolSequence samples_;
  std::shared_ptr<const irradiance::Scene> scene_;
  irradiance::SceneTriangles triangles_;
  irradiance::CellSums sums_;
  irradiance::PowerBalance balance_;
  irradiance::WalkHistory history_;
  irradiance::WalkBatch batch_;
  irradiance::WalkFront old_; ///< segments that are taken back
  std::vector<Walks> groups_;
  std::vector<std::uint32_t> groupOfWalk_;
  std::size_t frame_ = 0;
};

#endif
