// SPDX-License-Identifier: BSD-3-Clause
#include "DirectLight/DirectGather.h"

#include "DirectLight/DarkSides.h"

#include <algorithm>

namespace irradiance
{

namespace
{

CellShapes shapesOf(
  const Frame& frame, const LightTable& lights, CellPart part, const CancelPoint& cancelPoint)
{
  CellShapes shapes(frame, part.first, part.second, cancelPoint);
  if (part != kStaticPart)
  {
    markDarkSides(shapes, frame, lights);
  }
  return shapes;
}

DirectLight& gathered(DirectLight& light, const Frame& frame, Execution& execution)
{
  light.gather(frame, execution);
  return light;
}

}

std::vector<CellPart> cellParts(const SceneObjects& objects)
{
  constexpr std::size_t kMostDynamic = 8;
  constexpr std::size_t kMostCells = std::size_t{ 1 } << 19; // of the sums of all dynamic parts
  std::size_t cells = 1;
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    cells += objects[i].material->numberOfCells;
  }
  const std::size_t dynamic = objects.dynamicObjects.size();
  const std::size_t parts =
    std::min({ dynamic, kMostDynamic, std::max<std::size_t>(1, kMostCells / cells) });
  std::vector<CellPart> all{ kStaticPart };
  for (std::size_t i = 0; i < parts; ++i)
  {
    all.push_back({ static_cast<std::uint32_t>(1 + i * dynamic / parts),
      static_cast<std::uint32_t>(1 + (i + 1) * dynamic / parts) });
  }
  return all;
}

DirectGather::DirectGather(
  const Frame& frame, const LampPieces& lamps, const Settings& settings, Execution& execution)
  : settings_(settings)
  , triangles_(frame.triangles)
  , lamps_(lamps)
  , quantaPerWatt_(
      static_cast<double>(lamps.lights().quantaPerWalk()) * settings.walks / lamps.lights().flux())
  , cells_(shapesOf(frame, lamps.lights(), settings.part, cancelPointOf(execution, 0)))
  , plan_(cells_, lamps_,
      { settings.walks, settings.walksPerSample, settings.fewest, settings.replicates,
        static_cast<double>(lamps.lights().quantaPerWalk()) /
          static_cast<double>(settings.quantaPerWalk) },
      cancelPointOf(execution, 0))
  , light_(cells_, lamps_, plan_, settings.seed, quantaPerWatt_)
  , starts_(gathered(light_, frame, execution), frame.objects, triangles_, settings.quantaPerWalk,
      settings.firstWalk, settings.seed, cancelPointOf(execution, 0))
{
}

void DirectGather::addTo(const Totals& totals, int sign, const CancelPoint& cancelPoint) const
{
  PowerBalance& balance = totals.balance;
  if (settings_.part == kStaticPart && totals.dealt.contains(0))
  {
    for (const Light& light : lamps_.lights().lights())
    {
      for (std::size_t band = 0; band < light.flux.size(); ++band)
      {
        const std::int64_t quanta = sign * nearestQuanta(light.flux[band] * quantaPerWatt_);
        balance.emitted.quanta[band] += quanta;
        balance.escaped.quanta[band] += quanta;
        balance.unmet.quanta[band] += quanta;
      }
    }
  }
  count(light_.addTo(totals.sums, settings_.round, sign, totals.dealt, cancelPoint), balance);
}

std::vector<std::uint32_t> DirectGather::follow(
  const Frame& frame, const Totals& totals, Execution& execution)
{
  const std::vector<DirectLight::Change> changes = light_.follow(frame, execution);
  for (const auto& [number, passed] : changes)
  {
    const std::size_t cell = plan_.cellOf(number);
    if (totals.dealt.contains(cell))
    {
      const TriangleId id = triangles_.idOf(light_.samples()[number].triangle);
      for (const auto& [part, sign] :
        { std::pair(passed, -1), std::pair(light_.passedTo(number), 1) })
      {
        if (part > 0)
        {
          count(light_.add(
                  number, part, cell, totals.sums.cellOf(id), sign, totals.sums, settings_.round),
            totals.balance);
        }
      }
    }
  }
  return starts_.walksOf(changes);
}

void DirectGather::count(const Power& power, PowerBalance& balance)
{
  balance.absorbed += power;
  balance.escaped -= power;
  balance.unmet -= power;
  balance.received += power.total();
}

void DirectRounds::append(
  const Frame& frame, const LampPieces& lamps, std::uint32_t walks, Execution& execution)
{
  DirectGather::Settings its = settings_;
  its.walks = walks;
  its.round = rounds_.size();
  its.firstWalk = plan_.endWalk();
  its.seed = its.round == 0 ? settings_.seed : splitMix(settings_.seed + its.round);
  rounds_.push_back(std::make_unique<DirectGather>(frame, lamps, its, execution));
  plan_.addRound(rounds_.back()->starts().size());
}

void DirectRounds::drop(
  std::size_t kept, const DirectGather::Totals& totals, const CancelPoint& cancelPoint)
{
  while (rounds_.size() > kept)
  {
    rounds_.back()->addTo(totals, -1, cancelPoint);
    rounds_.pop_back();
  }
  plan_.dropRounds(kept);
}

std::vector<std::uint32_t> DirectRounds::follow(
  const Frame& frame, const DirectGather::Totals& totals, Execution& execution)
{
  std::vector<std::uint32_t> walks;
  for (const std::unique_ptr<DirectGather>& light : rounds_)
  {
    const std::vector<std::uint32_t> some = light->follow(frame, totals, execution);
    walks.insert(walks.end(), some.begin(), some.end());
  }
  return walks;
}

}
