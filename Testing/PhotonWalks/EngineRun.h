// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_test_EngineRun_h
#define irradiance_test_EngineRun_h

#include "IrradianceEngine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <vector>

// Sanitizers make tests about ten times slower, so they do less there.
#ifndef VTKIRRADIANCE_IS_SANITIZED
#define VTKIRRADIANCE_IS_SANITIZED 0
#endif

namespace irradiance::test
{

constexpr bool kIsSanitized = VTKIRRADIANCE_IS_SANITIZED != 0;

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

/// Of an engine whose photons can be collected.
inline EngineSettings keepingPhotons(std::uint32_t walks)
{
  EngineSettings settings;
  settings.numberOfWalks = walks;
  settings.keepPhotons = true;
  return settings;
}

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

/// With a first frame.
class UpdatedEngine : public IrradianceEngine
{
public:
  UpdatedEngine(const SceneObjects& objects, const EngineSettings& settings, Execution& execution)
  {
    update(objects, settings, execution);
  }
  UpdatedEngine(const SceneObjects& objects, const EngineSettings& settings,
    Execution&& execution = Execution())
    : UpdatedEngine(objects, settings, execution)
  {
  }
};

/// The answer of a new engine.
inline Answer freshAnswer(const SceneObjects& objects, const EngineSettings& settings)
{
  return answerOf(UpdatedEngine(objects, settings), objects, settings.separateSides);
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

  void print(const char* name, double truth) const
  {
    std::printf("%-28s %12.8g, true %12.8g, off by %+.4f %%, t %+.2f\n", name, mean_, truth,
      100 * (mean_ / truth - 1), t(truth));
  }

private:
  int count_ = 0;
  double mean_ = 0;
  double squares_ = 0;
};

/// The value that chi-square with `freedom` degrees exceeds as often as a normal variable exceeds
/// `z` (Wilson and Hilferty 1931).
inline double chiSquareLimit(double freedom, double z)
{
  const double part = 2 / (9 * freedom);
  return freedom * std::pow(1 - part + z * std::sqrt(part), 3);
}

}

#endif
