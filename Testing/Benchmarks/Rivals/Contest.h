// SPDX-License-Identifier: BSD-3-Clause
#ifndef Contest_h
#define Contest_h

#include "Measuring/SharedReference.h"
#include "Measuring/Shot.h"

inline irradiance::EngineSettings withSeed(irradiance::EngineSettings settings, std::uint64_t seed)
{
  settings.seed = seed;
  return settings;
}

inline Shot shootNew(
  const irradiance::SceneObjects& objects, const irradiance::EngineSettings& settings)
{
  irradiance::IrradianceEngine engine;
  return shoot(engine, objects, settings);
}

/// The mean of what was added.
class Mean
{
public:
  void add(double value)
  {
    sum_ += value;
    ++count_;
  }
  double value() const { return sum_ / count_; }

private:
  double sum_ = 0;
  int count_ = 0;
};

/// A still scene that both shoot, and how wrong they are.
class Contest
{
public:
  Contest(const irradiance::SceneObjects& objects, const irradiance::EngineSettings& settings)
    : objects_(objects)
    , settings_(settings)
    , plain_(makePlainScene(objects))
    , tracer_(plain_)
    , reference_(
        areasOf(objects), [this](std::uint64_t seed) { return ours(seed).irradiance; },
        [this](std::uint64_t seed) { return theirs(tracer_, seed).irradiance; })
  {
  }

  /// Nothing is stored.
  Shot ours(std::uint64_t seed) const
  {
    irradiance::EngineSettings settings = withSeed(settings_, seed);
    settings.verify = false;
    return shootNew(objects_, settings);
  }
  Shot oursStored(std::uint64_t seed) const
  {
    return shootNew(objects_, withSeed(settings_, seed));
  }
  Shot theirs(const PlainTracer& tracer, std::uint64_t seed) const
  {
    return shoot(tracer, objects_, plain_, withSeed(settings_, seed));
  }

  const PlainScene& plain() const { return plain_; }
  const PlainTracer& tracer() const { return tracer_; }
  const SharedReference& reference() const { return reference_; }

private:
  irradiance::SceneObjects objects_;
  irradiance::EngineSettings settings_;
  PlainScene plain_;
  PlainTracer tracer_;
  SharedReference reference_;
};

/// Squared errors, the means of all rounds: the error of a single run varies.
struct Errors
{
  /// For the same time, how much more efficient ours is.
  double gain() const { return theirs.value() / ours.value(); }

  Mean ours, theirs;
};

#endif
