#include "IrradianceEngine.h"

#include <algorithm>
#include <atomic>
#include <mutex>

namespace irradiance
{

namespace
{

double secondsSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

bool isSameLook(const SceneObject& a, const SceneObject& b)
{
  return a.surface == b.surface && a.isLoose == b.isLoose &&
    a.body->mesh().size() == b.body->mesh().size();
}

}

/// A pass over the blocks. It is cut into slices of kSlice, between which progress is told and an
/// interruption can happen; `next` says where a block goes on. What is computed does not depend on
/// the cuts.
struct IrradianceEngine::Phase
{
  static constexpr std::chrono::milliseconds kSlice{ 30 };

  class Deadline
  {
  public:
    bool hasPassed() const { return Clock::now() >= end_; }

  private:
    Clock::time_point end_ = Clock::now() + kSlice;
  };

  Phase(double from, double to)
    : progressFrom(from)
    , progressTo(to)
  {
  }

  double progressFrom, progressTo;
  /// Works on a block from item `next` until its end or the deadline.
  std::function<void(
    std::size_t block, std::uint32_t& next, const Deadline& deadline, PowerBalance& balance)>
    work;
  /// Number of items of a block.
  std::function<std::uint32_t(std::size_t block)> size;
};

void IrradianceEngine::overBlocks(const Phase& phase, Execution& execution)
{
  std::vector<std::uint32_t> next(numberOfBlocks(), 0);
  double total = 0;
  for (std::size_t block = 0; block < next.size(); ++block)
  {
    total += phase.size(block);
  }
  std::size_t first = 0;
  double done = 0;
  while (first < next.size())
  {
    const Phase::Deadline deadline;
    std::mutex mutex;
    std::exception_ptr error;
    execution.parallelFor(next.size() - first, [&](std::size_t begin, std::size_t end) {
      PowerBalance balance;
      try
      {
        for (std::size_t i = first + begin; i < first + end && !deadline.hasPassed(); ++i)
        {
          phase.work(i, next[i], deadline, balance);
        }
      }
      catch (...)
      {
        const std::lock_guard<std::mutex> lock(mutex);
        error = std::current_exception();
      }
      const std::lock_guard<std::mutex> lock(mutex);
      balance_ += balance;
    });
    if (error)
    {
      std::rethrow_exception(error);
    }
    checkReceived(balance_);
    while (first < next.size() && next[first] == phase.size(first))
    {
      done += phase.size(first++);
    }
    double inside = done;
    for (std::size_t i = first; i < next.size(); ++i)
    {
      inside += next[i];
    }
    const double part = total > 0 ? inside / total : 1.0;
    if (!execution.goOn(phase.progressFrom + part * (phase.progressTo - phase.progressFrom)))
    {
      throw Interrupted();
    }
  }
}

std::size_t IrradianceEngine::numberOfBlocks() const
{
  return (std::size_t{ settings_.numberOfWalks } + WalkBlock::kWalks - 1) / WalkBlock::kWalks;
}

std::uint32_t IrradianceEngine::walksIn(std::size_t block) const
{
  return std::min<std::uint32_t>(WalkBlock::kWalks,
    settings_.numberOfWalks - static_cast<std::uint32_t>(block) * WalkBlock::kWalks);
}

void IrradianceEngine::update(
  const SceneObjects& objects, const EngineSettings& settings, Execution& execution)
{
  EmitterTable emitters(objects, settings.numberOfWalks);
  const bool repair = canRepair(objects, settings, emitters);
  const std::vector<bool> moved = repair ? findMoved(objects) : std::vector<bool>();
  isValid_ = false; // until the end is reached
  objects_ = objects;
  settings_ = settings;
  emitters_ = std::move(emitters);
  statistics_ = {};
  if (repair)
  {
    verifyAndRepair(moved, execution);
  }
  else
  {
    shootAll(execution);
  }
  for (const WalkBlock& block : history_)
  {
    statistics_.historyBytes += block.bytes();
  }
  isValid_ = true;
}

bool IrradianceEngine::canRepair(
  const SceneObjects& objects, const EngineSettings& settings, const EmitterTable& emitters) const
{
  if (!isValid_ || !settings.verify || !settings_.verify ||
    settings.numberOfWalks != settings_.numberOfWalks || settings.seed != settings_.seed ||
    settings.separateSides != settings_.separateSides || objects.size() != objects_.size() ||
    objects.dynamic.empty() || objects.fixed.body != objects_.fixed.body)
  {
    return false;
  }
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    if (!isSameLook(objects[i], objects_[i]))
    {
      return false;
    }
  }
  return emitters == emitters_;
}

std::vector<bool> IrradianceEngine::findMoved(const SceneObjects& objects) const
{
  std::vector<bool> moved;
  for (std::size_t i = 0; i < objects.dynamic.size(); ++i)
  {
    const SceneObject &now = objects.dynamic[i], &before = objects_.dynamic[i];
    moved.push_back(now.body != before.body || now.worldFromObject != before.worldFromObject);
  }
  return moved;
}

void IrradianceEngine::commitScene(const std::vector<bool>& moved, Execution& execution)
{
  std::vector<PlacedObject> placed;
  for (const SceneObject& object : objects_.dynamic)
  {
    placed.push_back({ object.body, object.worldFromObject, object.isLoose });
  }
  scene_.setTraversalMode(settings_.traversalMode);
  scene_.setStatic(objects_.fixed.body);
  scene_.setDynamic(placed);
  scene_.setPointSources(emitters_.pointBounds());
  scene_.commit(moved, [&execution] {
    if (!execution.goOn(0))
    {
      throw Interrupted();
    }
  });
}

void IrradianceEngine::shootAll(Execution& execution)
{
  commitScene({}, execution);
  const Clock::time_point start = Clock::now();
  const int bands = objects_.fixed.surface->bands;
  sums_ = CellSums(objects_, settings_.separateSides ? 2 : 1);
  balance_ = {};
  history_.clear();
  const bool keep = settings_.verify && !objects_.dynamic.empty();
  for (std::size_t block = 0; keep && block < numberOfBlocks(); ++block)
  {
    history_.emplace_back(walksIn(block), bands, settings_.separateSides);
  }
  const SobolSequence samples(settings_.seed);
  const WalkShooter shooter(scene_, objects_, emitters_, samples);
  Phase phase(0, 1);
  phase.size = [this](std::size_t block) { return walksIn(block); };
  phase.work = [&](std::size_t block, std::uint32_t& next, const Phase::Deadline& deadline,
                 PowerBalance& balance) {
    WalkTrace trace;
    WalkBooking booking(sums_, balance);
    for (; next < walksIn(block) && !deadline.hasPassed(); ++next)
    {
      shooter.shoot(static_cast<std::uint32_t>(block) * WalkBlock::kWalks + next, trace);
      booking.add(trace, 0);
      if (keep)
      {
        history_[block].replaceTail(next, 0, trace);
      }
    }
    if (keep && next == walksIn(block))
    {
      history_[block].shrink();
    }
  };
  if (!emitters_.isEmpty())
  {
    overBlocks(phase, execution);
  }
  statistics_.shootSeconds = secondsSince(start);
}

void IrradianceEngine::verifyAndRepair(const std::vector<bool>& moved, Execution& execution)
{
  if (!settings_.cacheStaticHits)
  {
    std::for_each(
      history_.begin(), history_.end(), [](WalkBlock& block) { block.forgetAllStaticHits(); });
  }
  if (std::none_of(moved.begin(), moved.end(), [](bool b) { return b; }) || emitters_.isEmpty())
  {
    return;
  }
  Clock::time_point start = Clock::now();
  commitScene(moved, execution);
  const SobolSequence samples(settings_.seed);
  const WalkShooter shooter(scene_, objects_, emitters_, samples);
  const WalkVerifier verifier(scene_, shooter, moved);
  std::vector<std::vector<StaleSegment>> stale(numberOfBlocks());

  Phase verification(0, 0.5);
  verification.size = [this](std::size_t block) { return walksIn(block); };
  verification.work = [&](std::size_t block, std::uint32_t& next, const Phase::Deadline& deadline,
                        PowerBalance&) {
    for (; next < walksIn(block) && (next % 16 != 0 || !deadline.hasPassed()); ++next)
    {
      const auto walk = static_cast<std::uint32_t>(block) * WalkBlock::kWalks + next;
      if (const auto found = verifier.firstStaleSegment(history_[block], next, walk))
      {
        stale[block].push_back(*found);
      }
    }
  };
  overBlocks(verification, execution);
  statistics_.verifySeconds = secondsSince(start);

  start = Clock::now();
  std::atomic<std::int64_t> repaired{ 0 };
  Phase repair(0.5, 1);
  repair.size = [&](std::size_t block) { return static_cast<std::uint32_t>(stale[block].size()); };
  repair.work = [&](std::size_t block, std::uint32_t& next, const Phase::Deadline& deadline,
                  PowerBalance& balance) {
    WalkTrace trace;
    for (; next < stale[block].size() && !deadline.hasPassed(); ++next)
    {
      repairWalk(block, stale[block][next], shooter, trace, balance);
      repaired += trace.size();
    }
  };
  overBlocks(repair, execution);
  statistics_.repairSeconds = secondsSince(start);
  statistics_.repairedSegments = repaired;
  for (const auto& found : stale)
  {
    statistics_.invalidWalks += static_cast<std::int64_t>(found.size());
  }
}

void IrradianceEngine::repairWalk(std::size_t block, const StaleSegment& stale,
  const WalkShooter& shooter, WalkTrace& trace, PowerBalance& balance)
{
  WalkBlock& walks = history_[block];
  const std::uint32_t inBlock = stale.walkInBlock, bounce = stale.bounce;
  WalkSegment segment = walks.segment(inBlock, bounce);
  segment.hit = stale.hit;
  shooter.resume(static_cast<std::uint32_t>(block) * WalkBlock::kWalks + inBlock, bounce, segment,
    walks.power(inBlock, 0), walks.power(inBlock, bounce), trace);

  WalkBooking booking(sums_, balance);
  booking.remove(walks, inBlock, bounce);
  booking.add(trace, bounce);
  if (bounce == 0)
  {
    balance.emitted -= trace.power(0); // it was emitted before
  }
  cacheStaticHit(walks, stale);
  walks.replaceTail(inBlock, bounce, trace);
}

/// Section 3.3 of the paper: a static hit that becomes hidden is kept until the segment goes.
void IrradianceEngine::cacheStaticHit(WalkBlock& block, const StaleSegment& stale) const
{
  const auto isDynamic = [](const Hit& hit) { return hit && hit.id.object > 0; };
  const Hit& old = block.segment(stale.walkInBlock, stale.bounce).hit;
  if (!isDynamic(stale.hit))
  {
    block.forgetStaticHit(stale.walkInBlock, stale.bounce);
  }
  else if (settings_.cacheStaticHits && !isDynamic(old))
  {
    block.rememberStaticHit(stale.walkInBlock, stale.bounce, old);
  }
}

double IrradianceEngine::irradiance(
  std::uint32_t object, std::size_t cell, int side, int band, double area) const
{
  return area > 0 ? watts(sums_.sum(object, cell, side, band)) / area : 0.0;
}

}
