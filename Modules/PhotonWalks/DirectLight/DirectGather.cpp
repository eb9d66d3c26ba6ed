// SPDX-License-Identifier: BSD-3-Clause
#include "DirectLight/DirectGather.h"

#include "DirectLight/DarkSides.h"

#include <algorithm>

namespace irradiance
{

namespace
{

constexpr std::size_t kMostDynamic = 8;

/// Of the sums of all dynamic parts together.
constexpr std::size_t kMostCells = std::size_t{ 1 } << 19;

CellShapes shapesOf(
  const Frame& frame, const LightTable& lights, CellPart part, const CancelPoint& cancelPoint)
{
  CellShapes shapes(frame, part.first, part.end, cancelPoint);
  if (!part.isStatic())
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
  std::size_t cells = 1;
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    cells += objects[i].material->numberOfCells;
  }
  const std::size_t dynamic = objects.dynamicObjects.size();
  const std::size_t parts =
    std::min({ dynamic, kMostDynamic, std::max<std::size_t>(1, kMostCells / cells) });
  std::vector<CellPart> all(1);
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
      { settings.walks, settings.density, settings.replicates,
        static_cast<double>(lamps.lights().quantaPerWalk()) /
          static_cast<double>(settings.quantaPerWalk) },
      cancelPointOf(execution, 0))
  , light_(cells_, lamps_, plan_, settings.seed, quantaPerWatt_)
  , starts_(gathered(light_, frame, execution), frame.objects, triangles_, settings.quantaPerWalk,
      settings.firstWalk, settings.seed, cancelPointOf(execution, 0))
{
}

void DirectGather::addTo(CellSums& sums, PowerBalance& balance, const DealtBlocks& dealt, int sign,
  const CancelPoint& cancelPoint) const
{
  if (settings_.part.isStatic() && dealt.contains(0))
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
  count(light_.addTo(sums, settings_.round, sign, dealt, cancelPoint), balance);
}

void DirectGather::change(const std::vector<std::uint32_t>& samples, CellSums& sums,
  PowerBalance& balance, const DealtBlocks& dealt) const
{
  for (const std::uint32_t number : samples)
  {
    const std::size_t cell = plan_.cellOf(number);
    if (dealt.contains(cell))
    {
      const TriangleId id = triangles_.idOf(light_.samples()[number].triangle);
      const int sign = light_.isVisible(number) ? 1 : -1;
      count(light_.add(number, cell, sums.cellOf(id), sign, sums, settings_.round), balance);
    }
  }
}

void DirectGather::count(const Power& power, PowerBalance& balance)
{
  balance.absorbed += power;
  balance.escaped -= power;
  balance.unmet -= power;
  balance.received += power.total();
}

}
