// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the stages of a walk cost a segment, but for the cast: those of WalkStages, over fronts of walks,
 * beside those of WalkSampler, ScatteredRays and WalkTally, which take the same walks with the same hits in
 * the same minutes. Before any time counts, both have to keep the same walks, place their rays at the same
 * points, and bring the cells the same. One thread, CPU time.
 *
 * Arguments: [walks = 200000] [rounds = 7] [replicates = 1] [instruction set, 0 plain, 1 AVX2 = the best]
 */
#include "../../PhotonWalks/FrontWorld.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Measuring/Rounds.h"
#include "Scenes/PlainRoom.h"
#include "Simd/SimdLevel.h"
#include "Tally/WalkTally.h"

#include <stdexcept>

using namespace irradiance;

namespace
{

enum Stage
{
  kStart,
  kReceive,
  kAbsorb,
  kLeave,
  kAll,
  kStages
};
constexpr const char* kNames[kStages] = { "start", "receive", "absorb", "leave", "all" };

using Seconds = std::array<double, kStages>;

/// What reading the clock takes.
double clockSeconds()
{
  constexpr int kReadings = 1000;
  const double start = threadCpuSeconds();
  for (int i = 1; i < kReadings; ++i)
  {
    threadCpuSeconds();
  }
  return (threadCpuSeconds() - start) / kReadings;
}

/// Adds what it takes to a stage. A front takes some microseconds, so the clock itself is taken off.
template <class Work>
void timed(double& seconds, const Work& work)
{
  static const double clock = clockSeconds();
  seconds += threadCpuSecondsOf(work) - clock;
}

/// The stages of before, over the walks of a front, as WalkBatch runs them.
class RowStages
{
public:
  RowStages(const test::FrontWorld& world, WalkTally& tally)
    : world_(world)
    , tally_(tally)
  {
  }

  /// Not timed: the walks of a front that has been cast.
  void take(const WalkFront& front)
  {
    rays_.resize(front.size);
    hits_.resize(front.size);
    walks_.assign(front.walk.data(), front.walk.data() + front.size);
    bounces_.assign(front.bounce.data(), front.bounce.data() + front.size);
    for (std::size_t i = 0; i < front.size; ++i)
    {
      rays_[i] = world_.rayOf(front, i);
      hits_[i] = { front.distance[i], world_.triangles().idOf(front.hit[i]),
        { front.weightB[i], front.weightC[i] } };
    }
  }

  void start(const WalkFront& front)
  {
    rays_.resize(front.size);
    world_.sampler().start(front.walk.data(), front.size, rays_.data());
  }

  void receive()
  {
    const WalkSampler& sampler = world_.sampler();
    const std::size_t count = hits_.size();
    cells_.resize(count);
    slots_.resize(count);
    std::size_t received = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      if (i + kAhead < count)
      {
        sampler.prefetchTriangle(hits_[i + kAhead]);
      }
      if (hits_[i])
      {
        cells_[i] = sampler.cellOf(hits_[i].id);
        sampler.prefetchCell(hits_[i]);
        slots_[received] = tally_.slotOf(walks_[i], { hits_[i].id.object, cells_[i] });
        tally_.prefetch(slots_[received++]);
      }
    }
    slots_.resize(received);
    tally_.receive(slots_, sampler.powerPerWalk());
    tally_.escape(static_cast<std::int64_t>(count - received), sampler.powerPerWalk());
  }

  void absorb()
  {
    const WalkSampler& sampler = world_.sampler();
    probabilities_.resize(hits_.size());
    for (std::size_t i = 0; i < hits_.size(); ++i)
    {
      probabilities_[i] = hits_[i] ? sampler.reflectanceOf(hits_[i].id.object, cells_[i]) : 0;
    }
    survivors_.clear();
    sampler.survive(
      walks_.data(), bounces_.data(), probabilities_.data(), walks_.size(), 0, survivors_);
  }

  void leave()
  {
    ScatteredRays scattered(world_.sampler());
    next_.resize(survivors_.size());
    std::size_t kept = 0;
    for (const std::uint32_t i : survivors_)
    {
      const Hit& hit = hits_[i];
      const Reflection reflection =
        world_.sampler().reflectionAt(hit.id, walks_[i], bounces_[i] + 1, {});
      scattered.add({ walks_[i], bounces_[i] + 1, hit.id, weightsOf(hit), 0, rays_[i].direction,
                      reflection, rays_[i].origin },
        &next_[kept++]);
    }
    scattered.flush();
  }

  void check(const WalkFront& front) const
  {
    bool areSame = front.size == survivors_.size();
    for (std::size_t i = 0; areSame && i < front.size; ++i)
    {
      const Ray ray = world_.rayOf(front, i);
      areSame = front.walk[i] == walks_[survivors_[i]] && ray.origin == next_[i].origin &&
        (ray.direction - next_[i].direction).norm() < 1e-5;
    }
    if (!areSame)
    {
      throw std::runtime_error("The walks go other ways");
    }
  }

private:
  static constexpr std::size_t kAhead = 8;

  const test::FrontWorld& world_;
  WalkTally& tally_;
  std::vector<Ray> rays_, next_;
  std::vector<Hit> hits_;
  std::vector<std::uint32_t> walks_, bounces_, cells_, survivors_;
  std::vector<std::size_t> slots_;
  std::vector<double> probabilities_;
};

struct Round
{
  Seconds fronts{}, rows{};
  double segments = 0;
};

void takeBounces(const test::FrontWorld& world, FrontPair& fronts, RowStages& rows,
  FrontTally& tally, Round& round, bool isChecked)
{
  while (fronts.now.size > 0)
  {
    world.cast(fronts.now);
    round.segments += static_cast<double>(fronts.now.size);
    timed(round.fronts[kReceive], [&] { tally.receive(fronts.now); });
    timed(round.fronts[kAbsorb], [&] { world.stages().absorb(fronts.now, fronts.next, false); });
    timed(round.fronts[kLeave], [&] { world.stages().leave(fronts.next, false); });
    rows.take(fronts.now);
    timed(round.rows[kReceive], [&] { rows.receive(); });
    timed(round.rows[kAbsorb], [&] { rows.absorb(); });
    timed(round.rows[kLeave], [&] { rows.leave(); });
    if (isChecked)
    {
      rows.check(fronts.next);
    }
    fronts.swap();
  }
}

Round shootOnce(const test::FrontWorld& world, bool isChecked)
{
  Round round;
  CellSums sums(world.objects(), 1, world.plan()), others(world.objects(), 1, world.plan());
  PowerBalance balance, otherBalance;
  {
    FrontTally tally(
      world.triangles(), sums, balance, world.sampler().powerPerWalk(), 4 * WalkFront::kUsualSize);
    FrontPair& fronts = FrontPair::ofThread();
    for (std::uint32_t first = 0; first < world.plan().most();)
    {
      const auto count =
        std::min<std::uint32_t>(WalkFront::kUsualSize, world.plan().most() - first);
      world.enter(fronts.now, first, count);
      WalkTally rowTally(others, otherBalance);
      RowStages rows(world, rowTally);
      timed(round.rows[kStart], [&] { rows.start(fronts.now); });
      timed(round.fronts[kStart], [&] { world.stages().start(fronts.now); });
      takeBounces(world, fronts, rows, tally, round, isChecked);
      first += count;
    }
  }
  for (Seconds* seconds : { &round.fronts, &round.rows })
  {
    (*seconds)[kAll] =
      (*seconds)[kStart] + (*seconds)[kReceive] + (*seconds)[kAbsorb] + (*seconds)[kLeave];
  }
  if (isChecked)
  {
    CellNumbers(world.objects()).forEach([&](const SceneCell& cell) {
      if (sums.sum({ cell }, 0) != others.sum({ cell }, 0))
      {
        throw std::runtime_error("The cells receive something else");
      }
    });
  }
  return round;
}

}

void run(const Arguments& arguments)
{
  const auto walks = arguments.number<std::uint32_t>(0, 200000);
  const int rounds = arguments.number(1, 7);
  const auto replicates = arguments.number<std::uint32_t>(2, 1);
  limitSimd(static_cast<SimdLevel>(arguments.number(3, static_cast<int>(SimdLevel::Avx512))));
  const test::FrontWorld world(makePlainRoom().at(0), WalkPlan(walks, walks, replicates), 1);
  shootOnce(world, true);
  std::array<std::vector<double>, kStages> fronts, rows;
  for (int i = 0; i < rounds; ++i)
  {
    const Round round = shootOnce(world, false);
    for (int stage = 0; stage < kStages; ++stage)
    {
      fronts[stage].push_back(1e9 * round.fronts[stage] / round.segments);
      rows[stage].push_back(1e9 * round.rows[stage] / round.segments);
    }
  }
  for (int stage = 0; stage < kStages; ++stage)
  {
    report("FrontStages", kNames[stage], "fronts, ns a segment", fronts[stage]);
    report("FrontStages", kNames[stage], "rows, ns a segment", rows[stage]);
    report("FrontStages", kNames[stage], "rows / fronts", ratios(rows[stage], fronts[stage]));
  }
}
