// SPDX-License-Identifier: BSD-3-Clause
/**
 * What it costs to keep photons. One thread, CPU time.
 *
 * PhotonSets: photons come to sets at random and leave them, beside the standard library's hash
 * table and a vector that is searched from end to end. CellPhotonSets: a room with specular cells,
 * whose photons the engine keeps, beside the same room without any. LeafPhotons: all photons of a
 * room, in the leaf cells of its trees, beside the same frames without. In every round all have to
 * hold the right photons.
 *
 * Arguments: [walks = 1000000] [rounds = 5]
 */
#include "../../PhotonWalks/HistoryPhotons.h"
#include "Measuring/EngineTiming.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Rivals/CellPhotonSets.h"
#include "Rivals/PhotonBags.h"
#include "Scenes/PhotonTraffic.h"
#include "Scenes/PlainRoom.h"

#include <algorithm>
#include <stdexcept>
#include <type_traits>

using namespace irradiance;

namespace
{

void require(bool isRight, const std::string& what)
{
  if (!isRight)
  {
    throw std::runtime_error(what);
  }
}

/// Prefetches what the later steps will need, as CellPhotonSets does.
template <class Bag, class Work>
void forEachStep(
  std::vector<Bag>& bags, const std::vector<PhotonTraffic::Step>& steps, const Work& work)
{
  constexpr std::size_t kAhead = 16;
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    prefetchLine(&bags[steps[std::min(i + 2 * kAhead, steps.size() - 1)].set]);
    const PhotonTraffic::Step& later = steps[std::min(i + kAhead, steps.size() - 1)];
    bags[later.set].prefetch(later.photon);
    work(bags[steps[i].set], steps[i].photon);
  }
}

template <class Bag>
void requireContents(const std::vector<Bag>& bags, const std::vector<PhotonTraffic::Photons>& model)
{
  for (std::size_t i = 0; i < bags.size(); ++i)
  {
    PhotonTraffic::Photons expected = model[i], found;
    bags[i].forEach([&](const SegmentRef& photon) { found.push_back(photon); });
    std::sort(expected.begin(), expected.end());
    std::sort(found.begin(), found.end());
    require(found == expected, std::string(Bag::kName) + " holds other photons");
  }
}

/// After as many changes as there are photons, so that nothing is as new. `size`: photons in a set.
template <class Bag>
void timeSets(std::size_t photons, std::size_t size, int rounds)
{
  const auto insert = [](Bag& bag, const SegmentRef& photon) { bag.insert(photon); };
  const auto remove = [](Bag& bag, const SegmentRef& photon) { bag.remove(photon); };
  constexpr int kRoundsToAge = 10;
  PhotonTraffic traffic(photons / size, size);
  std::vector<Bag> bags(traffic.photons().size());
  forEachStep(bags, traffic.arrived(), insert);
  std::vector<double> removal, insertion;
  for (int round = -kRoundsToAge; round < rounds; ++round)
  {
    traffic.nextRound(photons / kRoundsToAge);
    const double perStep = 1e9 / static_cast<double>(traffic.gone().size());
    const double gone = threadCpuSecondsOf([&] { forEachStep(bags, traffic.gone(), remove); });
    const double arrived =
      threadCpuSecondsOf([&] { forEachStep(bags, traffic.arrived(), insert); });
    requireContents(bags, traffic.photons());
    if (round >= 0)
    {
      removal.push_back(perStep * gone);
      insertion.push_back(perStep * arrived);
    }
  }
  double bytes = 0;
  for (const Bag& bag : bags)
  {
    bytes += static_cast<double>(bag.memory());
  }
  const std::string row = std::string(Bag::kName) + ", " + std::to_string(size) + " photons each";
  const bool isMain = std::is_same_v<Bag, OurBag> && size == 500;
  if (isMain)
  {
    report("PhotonSets", row, "insertion, ns", insertion, { 60, 25 });
    report("PhotonSets", row, "removal, ns", removal, { 60, 25 });
  }
  report("PhotonSetSizes", row, "insertion, ns", insertion);
  report("PhotonSetSizes", row, "removal, ns", removal);
  report("PhotonSetSizes", row, "bytes a photon", bytes / static_cast<double>(photons));
}

/// The mean over all sizes up to the largest, of a set that grows.
void measureBytes()
{
  constexpr std::uint32_t kMost = 10000;
  OurBag set;
  double sum = 0;
  while (set.size() < kMost)
  {
    set.insert({ static_cast<std::uint32_t>(set.size()), 0 });
    sum += static_cast<double>(set.memory()) / static_cast<double>(set.size());
  }
  report("PhotonSets", "PhotonSet, mean over sizes of 1 to " + std::to_string(kMost),
    "bytes a photon", sum / kMost, { 24, 12 });
}

void timeAllSets(std::size_t photons, int rounds)
{
  for (const std::size_t size : { 5, 50, 500, 5000 })
  {
    timeSets<OurBag>(photons, size, rounds);
    timeSets<StandardBag>(photons, size, rounds);
    timeSets<PlainBag>(photons, size, rounds);
  }
  measureBytes();
}

/// What is on each cell.
std::vector<PhotonTraffic::Photons> contentsOf(
  const CellPhotonSets& sets, const SceneObjects& objects)
{
  std::vector<PhotonTraffic::Photons> contents;
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    for (std::size_t cell = 0; cell < objects[object].material->numberOfCells; ++cell)
    {
      contents.push_back(sets.sorted({ object, cell }));
    }
  }
  return contents;
}

/// What is in each leaf, in order.
std::vector<PhotonTraffic::Photons> contentsOf(
  const LeafPhotons& photons, const SceneObjects& objects)
{
  std::vector<PhotonTraffic::Photons> contents;
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    for (std::uint32_t leaf = 0; leaf < photons.tree(object).numberOfBlocks(); ++leaf)
    {
      contents.emplace_back();
      for (const LeafPhoton& photon : photons.leaf(object, leaf).photons())
      {
        contents.back().push_back(photon.reference());
      }
      std::sort(contents.back().begin(), contents.back().end());
    }
  }
  return contents;
}

template <class Photons>
void reportMemory(const Photons& photons, const SceneObjects& objects, const std::string& table,
  const std::string& row)
{
  std::size_t count = 0;
  for (const PhotonTraffic::Photons& cell : contentsOf(photons, objects))
  {
    count += cell.size();
  }
  report(table, row, "photons, millions", 1e-6 * static_cast<double>(count));
  report(table, row, "bytes a photon",
    static_cast<double>(photons.bytes()) / static_cast<double>(count));
}

/// The photons on the specular cells of an engine's walks, kept up to date.
class SpecularPhotons
{
public:
  SpecularPhotons(const IrradianceEngine& engine, Execution& execution)
    : sets_(collected(engine, execution))
    , photons_(test::photonsOf(test::onlySet(engine).history()))
  {
  }

  const CellPhotonSets& sets() const { return sets_; }
  static CellPhotonSets collected(const IrradianceEngine& engine, Execution& execution)
  {
    CellPhotonSets sets(engine.objects());
    const WalkHistory& history = test::onlySet(engine).history();
    sets.add(history, 0, history.size(), execution);
    return sets;
  }
  /// Seconds, without the time to find what has changed, which the engine knows.
  double follow(const IrradianceEngine& engine, Execution& execution)
  {
    std::vector<Photon> now = test::photonsOf(test::onlySet(engine).history());
    const PhotonChanges changes = test::changesBetween(photons_, now);
    photons_ = std::move(now);
    return threadCpuSecondsOf([&] { sets_.apply(changes, execution); });
  }

private:
  CellPhotonSets sets_;
  std::vector<Photon> photons_;
};

/// As the filter asks for them.
EngineSettings keeping(EngineSettings settings)
{
  settings.keepPhotons = true;
  return settings;
}

/// A room with specular cells beside the same room without any. Its walks are longer.
void timeSpecularPhotons(const EngineSettings& settings, int rounds)
{
  const std::string table = "CellPhotonSets", row = "20 % of the cells";
  const MovingScene matte = makePlainRoom(), glossy = makeGlossyRoom(0.2);
  const EngineSettings kept = keeping(settings);
  CpuTime execution;
  for (int round = 0; round < rounds; ++round)
  {
    IrradianceEngine plain, engine;
    const double plainFirst = timeUpdate(plain, matte.at(0), settings).whole;
    const double first = timeUpdate(engine, glossy.at(0), kept).whole;
    const double building =
      threadCpuSecondsOf([&] { SpecularPhotons::collected(engine, execution); });
    SpecularPhotons photons(engine, execution);
    report(table, row, "first shooting / without", (first + building) / plainFirst, { 1.35, 1.15 });
    report(table + "Parts", row, "built, ms", 1e3 * building);
    report(table + "Parts", row, "built / first shooting", building / (first + building));
    report(table + "Parts", row, "segments / without",
      static_cast<double>(engine.balance().segments) /
        static_cast<double>(plain.balance().segments));
    constexpr int kFrames = 4;
    double frames = 0, plainFrames = 0, changed = 0;
    for (int frame = 1; frame <= kFrames; ++frame)
    {
      plainFrames += timeUpdate(plain, matte.inFrame(frame), settings).whole;
      frames += timeUpdate(engine, glossy.inFrame(frame), kept).whole;
      frames += photons.follow(engine, execution);
      changed += static_cast<double>(engine.statistics().invalidWalks);
    }
    const SceneObjects objects = glossy.inFrame(kFrames);
    require(contentsOf(photons.sets(), objects) ==
        contentsOf(SpecularPhotons::collected(engine, execution), objects),
      "Updated photons differ from new ones");
    report(table, row, "frame / without", frames / plainFrames, { 1.35, 1.15 });
    report(
      table + "Parts", row, "walks changed, %", 100 * changed / kFrames / settings.numberOfWalks);
    reportMemory(photons.sets(), glossy.at(0), table + "Parts", row);
  }
}

/// Throws unless the engine, which kept its photons up to date, has what a new one collects.
void requireFreshLeaves(const IrradianceEngine& engine, Execution& execution)
{
  LeafPhotons fresh(engine.objects());
  fresh.add(test::onlySet(engine).history(), 0, test::onlySet(engine).history().size(), execution);
  require(contentsOf(engine.photons(), engine.objects()) == contentsOf(fresh, engine.objects()),
    "Updated leaves differ from new ones");
}

/// All photons in the leaf cells, kept up to date, beside the same frames without them.
void timeLeafPhotons(const EngineSettings& settings, int rounds)
{
  constexpr int kFrames = 4;
  constexpr double kSize = 1.05; // some 4 % of the walks change
  const std::string table = "LeafPhotons", row = "plain room";
  const MovingScene room = makePlainRoom(kSize);
  const EngineSettings kept = keeping(settings);
  CpuTime execution;
  for (int round = 0; round < rounds; ++round)
  {
    IrradianceEngine plain, engine;
    timeUpdate(plain, room.at(0), settings);
    const double first = timeUpdate(engine, room.at(0), kept).whole;
    const double building = threadCpuSecondsOf([&] { engine.collectPhotons(execution); });
    double frames = 0, plainFrames = 0, changed = 0;
    for (int frame = 1; frame <= kFrames; ++frame)
    {
      plainFrames += timeUpdate(plain, room.inFrame(frame), settings).whole;
      frames += timeUpdate(engine, room.inFrame(frame), kept).whole;
      changed += static_cast<double>(engine.statistics().invalidWalks);
    }
    requireFreshLeaves(engine, execution);
    report(table, row, "share of a frame", 1 - plainFrames / frames, { 0.30, 0.10 });
    report(table + "Parts", row, "frame / without", frames / plainFrames);
    report(table + "Parts", row, "built, ms", 1e3 * building);
    report(table + "Parts", row, "built / first shooting", building / first);
    report(table + "Parts", row, "frame without, ms", 1e3 * plainFrames / kFrames);
    report(
      table + "Parts", row, "walks changed, %", 100 * changed / kFrames / settings.numberOfWalks);
    reportMemory(engine.photons(), room.at(0), table + "Parts", row);
  }
}

}

void run(const Arguments& arguments)
{
  EngineSettings settings;
  settings.numberOfWalks = arguments.number(0, 1000000u);
  const int rounds = arguments.number(1, 5);
  timeAllSets(settings.numberOfWalks, rounds);
  timeSpecularPhotons(settings, rounds);
  timeLeafPhotons(settings, rounds);
}
