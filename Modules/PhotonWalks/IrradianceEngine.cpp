#include "IrradianceEngine.h"

#include "WalkBatch.h"

#include <algorithm>
#include <atomic>
#include <memory>
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

void store(const WalkBatch& batch, WalkBlock& block)
{
  for (const WalkBatch::Tail& tail : batch.tails())
  {
    block.replaceTail(tail.walk % WalkBlock::kWalks, tail.bounce, tail.size);
  }
  for (const WalkBatch::Piece& piece : batch.pieces())
  {
    block.setSegment(
      batch.tails()[piece.tail].walk % WalkBlock::kWalks, piece.bounce, piece.segment);
  }
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
          if (next[i] == phase.size(i))
          {
            continue;
          }
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
  bool sameLights = doLightsStand(objects, settings);
  if (!sameLights)
  {
    EmitterTable emitters(objects, settings.numberOfWalks);
    sameLights = isValid_ && emitters == emitters_;
    emitters_ = std::move(emitters);
  }
  const bool repair = sameLights && canRepair(objects, settings);
  const std::vector<bool> moved = repair ? findMoved(objects) : std::vector<bool>();
  isValid_ = false; // until the end is reached
  objects_ = objects;
  settings_ = settings;
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

bool IrradianceEngine::doLightsStand(
  const SceneObjects& objects, const EngineSettings& settings) const
{
  if (!isValid_ || settings.numberOfWalks != settings_.numberOfWalks ||
    objects.size() != objects_.size())
  {
    return false;
  }
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    const SceneObject &now = objects[i], &before = objects_[i];
    if (now.surface != before.surface ||
      (now.surface->emits() &&
        (now.body != before.body || now.worldFromObject != before.worldFromObject)))
    {
      return false;
    }
  }
  return true;
}

bool IrradianceEngine::canRepair(
  const SceneObjects& objects, const EngineSettings& settings) const
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
  return true;
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
  sums_ = CellSums(objects_, settings_.separateSides ? 2 : 1);
  balance_ = {};
  history_.clear();
  const bool keep = settings_.verify && !objects_.dynamic.empty();
  Box world = scene_.bounds();
  world.add(emitters_.pointBounds());
  pointFrame_ = UnitFrame(world);
  pointReach_ = reachInFrame();
  for (std::size_t block = 0; keep && block < numberOfBlocks(); ++block)
  {
    history_.emplace_back(walksIn(block), objects_.fixed.surface->bands, pointFrame_);
  }
  const SobolSequence samples(settings_.seed);
  const WalkShooter shooter(scene_, objects_, emitters_, samples);
  const auto fill = [&](std::size_t block, WalkBatch& batch) {
    for (std::uint32_t i = 0; i < walksIn(block); ++i)
    {
      batch.shoot(static_cast<std::uint32_t>(block) * WalkBlock::kWalks + i);
    }
  };
  const auto finish = [&](std::size_t block, WalkBatch& batch, WalkBooking&, PowerBalance& balance) {
    for (const WalkBatch::Piece& piece : batch.pieces())
    {
      balance.emitted += piece.bounce == 0 ? piece.segment.power : Power{};
    }
    if (keep)
    {
      store(batch, history_[block]);
      history_[block].shrink();
    }
  };
  if (!emitters_.isEmpty())
  {
    overBatches(0, 1, shooter, fill, finish, execution);
  }
  statistics_.shootSeconds = secondsSince(start);
}

/// Runs one batch of walks for each block: `fill` says which, `finish` keeps them.
template <class Fill, class Finish>
void IrradianceEngine::overBatches(double progressFrom, double progressTo,
  const WalkShooter& shooter, const Fill& fill, const Finish& finish, Execution& execution)
{
  std::vector<std::unique_ptr<WalkBatch>> open(numberOfBlocks());
  Phase phase(progressFrom, progressTo);
  phase.size = [](std::size_t) { return 1; };
  phase.work = [&](std::size_t block, std::uint32_t& next, const Phase::Deadline& deadline,
                 PowerBalance& balance) {
    WalkBooking booking(sums_, balance);
    if (!open[block])
    {
      open[block] = std::make_unique<WalkBatch>(shooter);
      fill(block, *open[block]);
    }
    if (open[block]->run(booking, [&] { return deadline.hasPassed(); }))
    {
      finish(block, *open[block], booking, balance);
      open[block].reset();
      next = 1;
    }
  };
  overBlocks(phase, execution);
}

double IrradianceEngine::reachInFrame() const
{
  Box world = scene_.bounds();
  world.add(emitters_.pointBounds());
  return std::max(pointFrame_(world.lower).cwiseAbs().maxCoeff(),
    pointFrame_(world.upper).cwiseAbs().maxCoeff());
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
  const std::vector<std::vector<StaleSegment>> stale = verify(shooter, moved, execution);
  statistics_.verifySeconds = secondsSince(start);

  start = Clock::now();
  repair(shooter, stale, execution);
  statistics_.repairSeconds = secondsSince(start);
}

std::vector<std::vector<StaleSegment>> IrradianceEngine::verify(
  const WalkShooter& shooter, const std::vector<bool>& moved, Execution& execution)
{
  pointReach_ = std::max(pointReach_, reachInFrame()); // stored points are where objects have been
  SegmentScan scan(pointFrame_, pointReach_);
  for (std::uint32_t i = 0; i < moved.size(); ++i)
  {
    if (moved[i] && !objects_.dynamic[i].body->mesh().isEmpty())
    {
      scan.addBody(scene_.shadowBound(i));
      scan.addMoved(i + 1);
    }
  }
  const WalkVerifier verifier(shooter, moved, scan);
  std::vector<std::vector<StaleSegment>> stale(numberOfBlocks());
  Phase phase(0, 0.5);
  phase.size = [](std::size_t) { return 1; };
  phase.work = [&](std::size_t block, std::uint32_t& next, const Phase::Deadline&, PowerBalance&) {
    stale[block] = verifier.staleSegments(
      history_[block], static_cast<std::uint32_t>(block) * WalkBlock::kWalks);
    next = 1;
  };
  overBlocks(phase, execution);
  for (const auto& found : stale)
  {
    statistics_.invalidWalks += static_cast<std::int64_t>(found.size());
  }
  return stale;
}

void IrradianceEngine::repair(const WalkShooter& shooter,
  const std::vector<std::vector<StaleSegment>>& stale, Execution& execution)
{
  std::atomic<std::int64_t> repaired{ 0 };
  const auto fill = [&](std::size_t block, WalkBatch& batch) {
    const WalkBlock& walks = history_[block];
    for (const StaleSegment& segment : stale[block])
    {
      batch.resume(static_cast<std::uint32_t>(block) * WalkBlock::kWalks + segment.walkInBlock,
        segment.bounce, segment.ray, segment.hit, walks.power(segment.walkInBlock, 0),
        walks.power(segment.walkInBlock, segment.bounce));
      for (std::uint32_t i = segment.bounce; i < walks.size(segment.walkInBlock); ++i)
      {
        sums_.fetch(walks.hit(segment.walkInBlock, i).id); // will be taken back
      }
    }
  };
  const auto finish = [&](std::size_t block, WalkBatch& batch, WalkBooking& booking, PowerBalance&) {
    WalkBlock& walks = history_[block];
    for (const StaleSegment& segment : stale[block])
    {
      booking.remove(walks, segment.walkInBlock, segment.bounce);
      cacheStaticHit(walks, segment);
    }
    store(batch, walks);
    repaired += static_cast<std::int64_t>(batch.pieces().size());
  };
  overBatches(0.5, 1, shooter, fill, finish, execution);
  statistics_.repairedSegments = repaired;
}

/// Section 3.3 of the paper: a static hit that becomes hidden is kept until the segment goes.
void IrradianceEngine::cacheStaticHit(WalkBlock& block, const StaleSegment& stale) const
{
  const auto isDynamic = [](const Hit& hit) { return hit && hit.id.object > 0; };
  if (!isDynamic(stale.hit))
  {
    block.forgetStaticHit(stale.walkInBlock, stale.bounce);
  }
  else if (settings_.cacheStaticHits && !isDynamic(stale.old))
  {
    block.rememberStaticHit(stale.walkInBlock, stale.bounce, stale.old);
  }
}

double IrradianceEngine::irradiance(
  std::uint32_t object, std::size_t cell, int side, int band, double area) const
{
  return area > 0 ? watts(sums_.sum(object, cell, side, band)) / area : 0.0;
}

}
