#include "IrradianceEngine.h"

#include "SlicedPass.h"
#include "WalkBatch.h"

#include <algorithm>
#include <atomic>
#include <memory>

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

bool hasMoved(const SceneObject& now, const SceneObject& before)
{
  return now.body != before.body || now.worldFromObject != before.worldFromObject;
}

void store(const WalkBatch& batch, std::vector<WalkBlock>& history)
{
  for (const WalkBatch::Tail& tail : batch.tails())
  {
    history[tail.walk / WalkBlock::kWalks].replaceTail(
      tail.walk % WalkBlock::kWalks, tail.bounce, tail.size);
  }
  for (const WalkBatch::Piece& piece : batch.pieces())
  {
    const std::uint32_t walk = batch.tails()[piece.tail].walk;
    history[walk / WalkBlock::kWalks].setSegment(
      walk % WalkBlock::kWalks, piece.bounce, piece.segment);
  }
}

}

/// Batches of walks, each for some blocks in a row.
struct IrradianceEngine::BatchPass
{
  double progressFrom, progressTo;
  std::size_t blocksTogether;
  std::function<void(std::size_t block, WalkBatch& batch)> fill;
  /// Keeps what a batch has shot.
  std::function<void(const WalkBatch& batch, WalkBooking& booking, PowerBalance& balance)> finish;
};

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
    if (now.surface != before.surface || (now.surface->emits() && hasMoved(now, before)))
    {
      return false;
    }
  }
  return true;
}

bool IrradianceEngine::canRepair(const SceneObjects& objects, const EngineSettings& settings) const
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
    moved.push_back(hasMoved(objects.dynamic[i], objects_.dynamic[i]));
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
  pointFrame_ = UnitFrame(walkBounds());
  clearance_ = scene_.clearance();
  pointReach_ = reachInFrame();
  for (std::size_t block = 0; keep && block < numberOfBlocks(); ++block)
  {
    history_.emplace_back(walksIn(block), objects_.fixed.surface->bands, pointFrame_);
  }
  const SobolSequence samples(settings_.seed);
  const WalkShooter shooter(scene_, objects_, emitters_, samples);
  BatchPass pass{ 0, 1, 1 };
  pass.fill = [&](std::size_t block, WalkBatch& batch) {
    for (std::uint32_t i = 0; i < walksIn(block); ++i)
    {
      batch.shoot(static_cast<std::uint32_t>(block) * WalkBlock::kWalks + i);
    }
  };
  pass.finish = [&](const WalkBatch& batch, WalkBooking&, PowerBalance& balance) {
    for (const WalkBatch::Piece& piece : batch.pieces())
    {
      balance.emitted += piece.bounce == 0 ? piece.segment.power : Power{};
    }
    if (keep)
    {
      store(batch, history_);
      history_[batch.tails().front().walk / WalkBlock::kWalks].shrink();
    }
  };
  if (!emitters_.isEmpty())
  {
    run(pass, shooter, execution);
  }
  statistics_.shootSeconds = secondsSince(start);
}

void IrradianceEngine::run(const BatchPass& pass, const WalkShooter& shooter, Execution& execution)
{
  const std::size_t together = pass.blocksTogether;
  std::vector<std::unique_ptr<WalkBatch>> open((numberOfBlocks() + together - 1) / together);
  SlicedPass sliced{ pass.progressFrom, pass.progressTo, open.size(), {} };
  sliced.work = [&](std::size_t unit, const Deadline& deadline, PowerBalance& balance) {
    WalkBooking booking(sums_, balance);
    std::unique_ptr<WalkBatch>& batch = open[unit];
    if (!batch)
    {
      batch = std::make_unique<WalkBatch>(shooter);
      for (std::size_t i = unit * together; i < std::min((unit + 1) * together, numberOfBlocks());
           ++i)
      {
        pass.fill(i, *batch);
      }
    }
    if (!batch->run(booking, [&] { return deadline.hasPassed(); }))
    {
      return false;
    }
    pass.finish(*batch, booking, balance);
    batch.reset();
    return true;
  };
  sliced.run(execution, balance_);
}

Box IrradianceEngine::walkBounds() const
{
  Box bounds = scene_.bounds();
  bounds.add(emitters_.pointBounds());
  return bounds;
}

double IrradianceEngine::reachInFrame() const
{
  const Box world = walkBounds();
  return std::max(pointFrame_(world.lower).cwiseAbs().maxCoeff(),
           pointFrame_(world.upper).cwiseAbs().maxCoeff()) +
    clearance_ * pointFrame_.scale;
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
  // Stored points are where objects have been.
  clearance_ = std::max(clearance_, scene_.clearance());
  pointReach_ = std::max(pointReach_, reachInFrame());
  SegmentScan scan(pointFrame_, pointReach_);
  for (std::uint32_t i = 0; i < moved.size(); ++i)
  {
    if (moved[i] && !objects_.dynamic[i].body->mesh().isEmpty())
    {
      scan.addBody(scene_.shadowBound(i, clearance_));
      scan.addMoved(i + 1);
    }
  }
  const WalkVerifier verifier(shooter, moved, scan, clearance_);
  std::vector<std::vector<StaleSegment>> stale(numberOfBlocks());
  SlicedPass pass{ 0, 0.5, numberOfBlocks(), {} };
  pass.work = [&](std::size_t block, const Deadline&, PowerBalance&) {
    stale[block] = verifier.staleSegments(
      history_[block], static_cast<std::uint32_t>(block) * WalkBlock::kWalks);
    return true;
  };
  pass.run(execution, balance_);
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
  // A block has few stale walks: those of several make a batch worth its name, if that leaves enough
  // batches for all threads.
  constexpr std::size_t kBatches = 32, kMostTogether = 16;
  BatchPass pass{ 0.5, 1, std::clamp<std::size_t>(numberOfBlocks() / kBatches, 1, kMostTogether) };
  pass.fill = [&](std::size_t block, WalkBatch& batch) {
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
  pass.finish = [&](const WalkBatch& batch, WalkBooking& booking, PowerBalance&) {
    for (const WalkBatch::Tail& tail : batch.tails())
    {
      booking.remove(
        history_[tail.walk / WalkBlock::kWalks], tail.walk % WalkBlock::kWalks, tail.bounce);
    }
    store(batch, history_);
    repaired += static_cast<std::int64_t>(batch.pieces().size());
  };
  run(pass, shooter, execution);
  for (std::size_t block = 0; block < stale.size(); ++block)
  {
    for (const StaleSegment& segment : stale[block])
    {
      cacheStaticHit(history_[block], segment);
    }
  }
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
