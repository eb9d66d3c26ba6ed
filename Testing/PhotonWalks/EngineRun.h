// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IrradianceEngine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

namespace irradiance::test
{

/// Sanitizers make tests about ten times slower, so they do less there.
#if defined(VTKIRRADIANCE_IS_SANITIZED)
constexpr bool kIsSanitized = true;
#else
constexpr bool kIsSanitized = false;
#endif

/// `count` in an ordinary build, a twelfth of it with sanitizers, at least 1.
constexpr std::uint32_t scaled(std::uint32_t count)
{
  return kIsSanitized ? std::max(count / 12, 1u) : count;
}

/// Settings, told in a row: Shoot(3000).gathered().bySide().
struct Shoot : EngineSettings
{
  explicit Shoot(std::uint32_t walks) { numberOfWalks = walks; }
  Shoot& seeded(std::uint64_t number) { return seed = number, *this; }
  Shoot& unverified() { return verify = false, *this; }
  Shoot& cached(bool is = true) { return cacheStaticHits = is, *this; }
  Shoot& bySide(bool is = true) { return separateSides = is, *this; }
  Shoot& gathered(bool is = true) { return gathersDirectLight = is, *this; }
  Shoot& errors(std::uint32_t count) { return replicates = count, *this; }
  Shoot& budget(double seconds) { return repairTimeBudget = seconds, *this; }
  Shoot& target(double error, std::uint32_t most)
  {
    return targetRelativeError = error, maximumNumberOfWalks = most, *this;
  }
  Shoot& spread(double photons)
  {
    return cellEstimate = CellEstimate::Spread, spreadPhotons = photons, *this;
  }
  Shoot& finalGather(std::uint32_t rays)
  {
    return cellEstimate = CellEstimate::Gathered, gatherRays = rays, gathered();
  }
  Shoot& mostRays(std::uint32_t rays) { return maximumGatherRays = rays, *this; }
  Shoot& everywhere() { return gathersEverywhere = true, *this; }
  Shoot& unbiased() { return unbiasedGather = true, *this; }
  /// For views.
  Shoot& kept(bool is = true) { return keepPhotons = is, *this; }
  /// On each rank, and with notes of what was repaired.
  Shoot& keptByAll() { return allOnEachRank = listRepaired = true, kept(); }
};

/// Numbers to the bit.
using Answer = std::vector<std::int64_t>;

inline void addBits(Answer& answer, double value)
{
  std::int64_t bits;
  std::memcpy(&bits, &value, sizeof(bits));
  answer.push_back(bits);
}

/// Calls use(side, band) for all sides and bands of all cells.
template <class Use>
void forEachSide(const SceneObjects& objects, bool separateSides, const Use& use)
{
  CellNumbers(objects).forEach([&](const SceneCell& cell) {
    irradiance::forEachSide(cell, separateSides, [&](const CellSide& side) {
      for (int band = 0; band < objects.staticObject.material->bands; ++band)
      {
        use(side, band);
      }
    });
  });
}

/// Calls use(side, band, replicate, rounds) for all sums.
template <class Use>
void forEachSum(const CellSums& sums, const Use& use)
{
  sums.numbers().forEach([&](const SceneCell& cell) {
    irradiance::forEachSide(cell, sums.sides() == 2, [&](const CellSide& side) {
      for (int band = 0; band < sums.bands(); ++band)
      {
        for (std::uint32_t k = 0; k < sums.plan().replicates().count(); ++k)
        {
          for (std::size_t rounds = 1; rounds <= sums.rounds(); ++rounds)
          {
            use(side, band, k, rounds);
          }
        }
      }
    });
  });
}

inline void expectEqual(const CellSums& sums, const CellSums& expected)
{
  forEachSum(expected, [&](const CellSide& side, int band, std::uint32_t k, std::size_t rounds) {
    ASSERT_EQ(sums.sum(side, band, k, rounds), expected.sum(side, band, k, rounds));
  });
}

/// The whole answer of an engine or of a set of walks, in quanta.
template <class Walks>
Answer answerOf(const Walks& walks, const SceneObjects& objects, bool separateSides = false)
{
  Answer answer;
  forEachSide(objects, separateSides,
    [&](const CellSide& side, int band) { addBits(answer, walks.sums().sum(side, band)); });
  const PowerBalance& balance = walks.balance();
  for (const Power& power : { balance.emitted, balance.absorbed, balance.escaped })
  {
    answer.insert(answer.end(), power.quanta.begin(), power.quanta.end());
  }
  answer.push_back(balance.segments);
  return answer;
}

/// With a first frame, if there is one already. Serial, unless it is told otherwise.
class UpdatedEngine : public IrradianceEngine
{
public:
  UpdatedEngine() = default;
  UpdatedEngine(const SceneObjects& objects, const EngineSettings& settings, Execution& execution)
  {
    update(objects, settings, execution);
  }
  UpdatedEngine(const SceneObjects& objects, const EngineSettings& settings,
    Execution&& execution = Execution())
    : UpdatedEngine(objects, settings, execution)
  {
  }
  using IrradianceEngine::update;
  void update(const SceneObjects& objects, const EngineSettings& settings)
  {
    Execution serial;
    update(objects, settings, serial);
  }
};

/// The answer of a new engine.
inline Answer freshAnswer(const SceneObjects& objects, const EngineSettings& settings)
{
  return answerOf(UpdatedEngine(objects, settings), objects, settings.separateSides);
}

/// Law 1: the answer of an engine is that of a new one.
inline bool isAsFresh(const IrradianceEngine& engine)
{
  return answerOf(engine, engine.objects(), engine.settings().separateSides) ==
    freshAnswer(engine.objects(), engine.settings());
}

/// The engine's whole answer, and the bits of all that it says of cells: irradiance, stale
/// irradiance and standard errors.
inline Answer shownAnswer(const IrradianceEngine& engine)
{
  const bool separateSides = engine.settings().separateSides;
  Answer answer = answerOf(engine, engine.objects(), separateSides);
  const ErrorEstimate errors = engine.errorEstimate();
  forEachSide(engine.objects(), separateSides, [&](const CellSide& side, int band) {
    addBits(answer, engine.irradiance(side, band));
    addBits(answer, engine.staleIrradiance(side, band));
    addBits(answer, errors.standardError(side, band));
  });
  addBits(answer, engine.reachedRelativeError());
  answer.push_back(engine.numberOfWalks());
  return answer;
}

/// Law 1 for all that is said of cells.
inline bool isShownAsFresh(const IrradianceEngine& engine)
{
  return shownAnswer(engine) == shownAnswer(UpdatedEngine(engine.objects(), engine.settings()));
}

constexpr double kNoTime = 1e-9; ///< s; a budget that is over when it begins

/// Walks.
inline std::size_t numberOfStale(const IrradianceEngine& engine)
{
  std::size_t count = 0;
  for (const WalkSet& set : engine.walks().sets())
  {
    count += set.stale() ? set.stale()->numberOfUnborn() : 0;
    for (std::size_t block = 0; set.stale() && block < set.stale()->numberOfBlocks(); ++block)
    {
      count += set.stale()->marks(block).size();
    }
  }
  return count;
}

inline void expectBalance(const IrradianceEngine& engine)
{
  Power sum = engine.balance().absorbed;
  sum += engine.balance().escaped;
  EXPECT_EQ(sum.quanta, engine.balance().emitted.quanta);
}

/// Watts on cells [first, last) of an object.
inline double wattsOn(const IrradianceEngine& engine, std::uint32_t object, std::size_t first,
  std::size_t last, int band = 0)
{
  double quanta = 0;
  for (std::size_t cell = first; cell < last; ++cell)
  {
    quanta += engine.sums().sum({ object, cell }, band);
  }
  return engine.watts(quanta);
}

/// An estimate from independent replicates, with its standard error.
class ReplicateMean
{
public:
  void add(double value)
  {
    ++count_;
    const double delta = value - mean_;
    mean_ += delta / count_;
    squares_ += delta * (value - mean_);
  }
  int count() const { return count_; }
  double mean() const { return mean_; }
  double standardError() const { return std::sqrt(squares_ / (count_ - 1) / count_); }
  /// Student's t of `truth`, with count() - 1 degrees of freedom. Integer sums can be equal in all
  /// replicates; then the relative 1e-12 keeps rounding from counting as an error.
  double t(double truth) const
  {
    return (mean_ - truth) / (standardError() + 1e-12 * std::abs(truth));
  }

private:
  int count_ = 0;
  double mean_ = 0;
  double squares_ = 0;
};

/// Calls use(engine) with a first frame of so many seeds, from that of the settings on.
template <class Use>
void overSeeds(const SceneObjects& objects, int seeds, EngineSettings settings, const Use& use,
  Execution&& execution = Execution())
{
  settings.verify = false;
  for (int i = 0; i < seeds; ++i, ++settings.seed)
  {
    const UpdatedEngine engine(objects, settings, execution);
    expectBalance(engine);
    use(engine);
  }
}

/// Tests that hold however direct light is known: shot, or gathered.
class BothModes : public testing::TestWithParam<bool>
{
protected:
  static bool isGathered() { return GetParam(); }

  template <class Use>
  static void overSeeds(const SceneObjects& objects, int seeds, std::uint32_t walks, const Use& use)
  {
    test::overSeeds(objects, seeds, Shoot(walks).gathered(isGathered()), use);
  }
};

inline std::string nameOfMode(const testing::TestParamInfo<bool>& info)
{
  return info.param ? "Gathered" : "Shot";
}

/// The value that chi-square with `freedom` degrees exceeds as often as a normal variable exceeds
/// `z` (Wilson and Hilferty 1931).
inline double chiSquareLimit(double freedom, double z)
{
  const double part = 2 / (9 * freedom);
  return freedom * std::pow(1 - part + z * std::sqrt(part), 3);
}

/// Counts the 95 % intervals that hold a truth.
class IntervalCount
{
public:
  explicit IntervalCount(std::uint32_t replicates)
    : factor_(ErrorEstimate::confidenceFactor(replicates))
  {
  }

  /// `off`: the estimate less the truth. An error that is not known is no interval.
  void add(double off, double standardError)
  {
    ++all_;
    if (!std::isnan(standardError))
    {
      ++known_;
      least_ = std::min(least_, standardError);
      held_ += std::abs(off) <= factor_ * standardError ? 1 : 0;
      squares_ += std::pow(off / standardError, 2);
    }
  }

  double shareKnown() const { return known_ / all_; }
  double shareThatHolds() const { return held_ / known_; }

  /// At least 90 % hold it, and errors are not much smaller than claimed.
  void expectHonest() const
  {
    EXPECT_GT(least_, 0);
    EXPECT_GT(shareThatHolds(), 0.9);
    EXPECT_GT(squares_ / known_, 0.25) << "nor much too wide";
  }

private:
  double factor_, least_ = kInfinity, squares_ = 0, all_ = 0, known_ = 0, held_ = 0;
};

}
