// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_test_EngineRun_h
#define irradiance_test_EngineRun_h

#include "IrradianceEngine.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

// Sanitizers make tests about ten times slower, so they do less there.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define IRRADIANCE_TEST_IS_SANITIZED 1
#else
#define IRRADIANCE_TEST_IS_SANITIZED 0
#endif

namespace irradiance::test
{

constexpr bool kIsSanitized = IRRADIANCE_TEST_IS_SANITIZED != 0;

/// `count` in an ordinary build, a twelfth of it with sanitizers, at least 1.
constexpr std::uint32_t scaled(std::uint32_t count)
{
  return kIsSanitized ? std::max(count / 12, 1u) : count;
}

/// Of an engine whose photons can be collected.
inline EngineSettings keepingPhotons(std::uint32_t walks)
{
  EngineSettings settings;
  settings.numberOfWalks = walks;
  settings.keepPhotons = true;
  return settings;
}

/// The whole answer of an engine or of a set of walks, in quanta.
using Answer = std::vector<double>;

template <class Walks>
Answer answerOf(const Walks& walks, const SceneObjects& objects, bool separateSides = false)
{
  Answer answer;
  CellNumbers(objects).forEach([&](const SceneCell& cell) {
    for (int side = 0; side < (separateSides ? 2 : 1); ++side)
    {
      for (int band = 0; band < objects.staticObject.material->bands; ++band)
      {
        answer.push_back(walks.sums().sum({ cell, side }, band));
      }
    }
  });
  const PowerBalance& balance = walks.balance();
  for (const Power& power : { balance.emitted, balance.absorbed, balance.escaped })
  {
    answer.insert(answer.end(), power.quanta.begin(), power.quanta.end());
  }
  answer.push_back(static_cast<double>(balance.segments));
  return answer;
}

/// The answer of a new engine.
inline Answer freshAnswer(const SceneObjects& objects, const EngineSettings& settings)
{
  IrradianceEngine engine;
  Execution serial;
  engine.update(objects, settings, serial);
  return answerOf(engine, objects, settings.separateSides);
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
