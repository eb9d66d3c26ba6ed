// SPDX-License-Identifier: BSD-3-Clause
/**
 * What it costs to keep photons. One thread, CPU time.
 *
 * PhotonSets: photons come to sets at random and leave them, beside the standard library's hash table and
 * a vector that is searched from end to end. SpecularPhotons: those of a room with specular cells, made
 * from its walks, and updated with what changes in a frame. In every round all have to hold the right
 * photons.
 *
 * Arguments: [walks = 1000000] [rounds = 5]
 */
#include "../../PhotonWalks/HistoryChanges.h"
#include "Measuring/EngineTiming.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Photons/SpecularPhotons.h"
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

/// Prefetches what the later steps will need, as SpecularPhotons does.
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
    bags[i].forEach([&](const PhotonReference& photon) { found.push_back(photon); });
    std::sort(expected.begin(), expected.end());
    std::sort(found.begin(), found.end());
    require(found == expected, std::string(Bag::kName) + " holds other photons");
  }
}

/// After as many changes as there are photons, so that nothing is as new. `size`: photons in a set.
template <class Bag>
void timeSets(std::size_t photons, std::size_t size, int rounds)
{
  const auto insert = [](Bag& bag, const PhotonReference& photon) { bag.insert(photon); };
  const auto remove = [](Bag& bag, const PhotonReference& photon) { bag.remove(photon); };
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
  const SpecularPhotons& sets, const SceneObjects& objects)
{
  std::vector<PhotonTraffic::Photons> contents;
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    for (std::size_t cell = 0; cell < objects[object].material->numberOfCells; ++cell)
    {
      contents.push_back(sets.sorted(object, cell));
    }
  }
  return contents;
}

SpecularPhotons specularPhotonsOf(const SceneObjects& objects, const IrradianceEngine& engine)
{
  CpuTime serial;
  SpecularPhotons sets(objects);
  sets.add({ engine.plan(), engine.history() }, 0, engine.history().size(), serial);
  return sets;
}

void timeSpecularPhotons(const EngineSettings& settings, int rounds)
{
  const std::string table = "SpecularPhotons", row = "20 % of the cells";
  const MovingScene scene = makeGlossyRoom(0.2);
  IrradianceEngine engine;
  CpuTime serial;
  const double shooting = timeUpdate(engine, scene.at(0), settings).whole;
  SpecularPhotons sets = specularPhotonsOf(scene.at(0), engine);
  std::vector<Photon> photons = test::photonsOf(engine);
  for (int round = 0; round < rounds; ++round)
  {
    const double building = threadCpuSecondsOf([&] { specularPhotonsOf(scene.at(0), engine); });
    report(table, row, "built, ms", 1e3 * building);
    report(table, row, "built / first shooting", building / shooting);
  }
  for (int frame = 1; frame <= 2 * rounds; ++frame)
  {
    const SceneObjects objects = scene.inFrame(frame);
    const double update = timeUpdate(engine, objects, settings).whole;
    const std::vector<Photon> now = test::photonsOf(engine);
    const PhotonChanges changes = test::changesBetween(photons, now);
    photons = now;
    const double applying = threadCpuSecondsOf([&] { sets.apply(changes, serial); });
    require(contentsOf(sets, objects) == contentsOf(specularPhotonsOf(objects, engine), objects),
      "Updated photons differ from new ones");
    report(table, row, "updated, ms", 1e3 * applying);
    report(table, row, "updated / frame", applying / update);
    report(table, row, "changed walks, %",
      100.0 * static_cast<double>(engine.statistics().invalidWalks) / settings.numberOfWalks);
  }
  std::size_t count = 0;
  for (const PhotonTraffic::Photons& cell : contentsOf(sets, scene.at(0)))
  {
    count += cell.size();
  }
  report(table, row, "photons, millions", 1e-6 * static_cast<double>(count));
  report(
    table, row, "bytes a photon", static_cast<double>(sets.bytes()) / static_cast<double>(count));
}

}

void run(const Arguments& arguments)
{
  EngineSettings settings;
  settings.numberOfWalks = arguments.number(0, 1000000u);
  const int rounds = arguments.number(1, 5);
  timeAllSets(settings.numberOfWalks, rounds);
  timeSpecularPhotons(settings, rounds);
}
