// SPDX-License-Identifier: BSD-3-Clause
#include "Walks/LightSurvey.h"

#include "DirectLight/DirectPilot.h"
#include "DirectLight/FirstHits.h"
#include "DirectLight/PowerClasses.h"
#include "Repair/SceneChange.h"
#include "Surfaces/Frame.h"

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <tuple>
#include <utility>

namespace irradiance
{

namespace
{

/// Of a walk: rounding them changes its power by less than .2 %.
constexpr double kFewestQuanta = 256;

/// Shares the walks of a plan among sources by flux, but the part `alike` of them evenly; those
/// that start at lights are `atLights` times as many.
void deal(
  std::vector<WalkSource>& sources, const WalkPlan& plan, double atLights = 1, double alike = 0)
{
  const std::uint32_t first = plan.walksAfter(1), replicates = plan.replicates().count();
  const std::uint32_t times = std::uint32_t{ 1 } << std::ilogb(plan.most() / first);
  const double flux = std::accumulate(sources.begin(), sources.end(), 0.0,
    [](double sum, const WalkSource& source) { return sum + source.lights.flux(); });
  std::uint32_t firstWalk = plan.replicates().firstWalk();
  double sum = 0;
  std::int64_t given = 0; // walks of each replicate
  for (WalkSource& source : sources)
  {
    LightTable& lights = source.lights;
    const double share = lights.flux() / flux * first;
    const double dealt = (1 - alike) * share + alike * first / static_cast<double>(sources.size());
    const double number = std::min(source.cells ? dealt : dealt * atLights,
      share * static_cast<double>(lights.quantaPerWalk()) / kFewestQuanta);
    sum += number / replicates; // rounded as a whole, so that none gets lost
    const auto ofReplicate = std::max<std::int64_t>(1, std::llround(sum) - given);
    given += ofReplicate;
    const std::uint32_t walks = replicates * static_cast<std::uint32_t>(ofReplicate);
    source.plan = WalkPlan(walks, walks * times, replicates, firstWalk);
    firstWalk += walks * times;
    lights.setQuantaPerWalk(std::max<std::int64_t>(
      1, std::llround(static_cast<double>(lights.quantaPerWalk()) * (share / walks))));
  }
}

std::vector<Known> knownBy(
  const WalkSource& source, const FirstHits& hits, const std::vector<bool>& areDim)
{
  const std::vector<Light>& lights = source.lights.lights();
  std::vector<Known> known(lights.size(), Known::Gathered);
  std::array<double, 3> sums{}; // W
  const auto flux = [&](Known part) -> double& { return sums[static_cast<std::size_t>(part)]; };
  for (std::size_t i = 0; i < lights.size(); ++i)
  {
    known[i] = areDim[i] ? Known::Dim : hits.nearLights()[i] ? Known::Shot : Known::Gathered;
    flux(known[i]) += lights[i].totalFlux();
  }
  // No part is to be worth less than a walk of each replicate.
  const double least =
    source.lights.flux() / source.plan.walksAfter(1) * source.plan.replicates().count();
  const auto isWeak = [&](Known part) { return flux(part) <= least; };
  const auto join = [&](Known part, Known other) {
    std::replace(known.begin(), known.end(), part, other);
    flux(other) += std::exchange(flux(part), 0);
  };
  for (const Known part : { Known::Dim, Known::Shot })
  {
    if (isWeak(part))
    {
      join(part, Known::Gathered);
    }
  }
  if (isWeak(Known::Gathered) && flux(Known::Gathered) > 0)
  {
    isWeak(Known::Shot) ? join(Known::Dim, Known::Gathered) : join(Known::Gathered, Known::Shot);
  }
  return known;
}

LightSurvey::Group groupOf(
  const SceneObjects& objects, const WalkSource& source, const FirstHits& hits, double reflected)
{
  LightSurvey::Group group;
  group.known = knownBy(source, hits, hits.dimLights(objects, source.lights, reflected));
  const LightTable gathered = group.lightsOf(source, Known::Gathered);
  if (gathered.isEmpty())
  {
    return group;
  }
  group.lamps = std::make_shared<const LampPieces>(gathered);
  const DirectPilot pilot(objects, *group.lamps);
  group.variance = pilot.variance();
  std::tie(group.walksPerSample, group.cost) = pilot.best(
    hits.arrived() / source.lights.flux(), hits.returned(), LightSurvey::powerOfStart(reflected));
  // Of walks from infinity most meet the outside of a room into which little of the sky is seen.
  const bool isAnyDistant = std::any_of(gathered.lights().begin(), gathered.lights().end(),
    [](const Light& light) { return light.distant() != nullptr; });
  group.areHardToFind = group.cost >= 1 && !isAnyDistant;
  if (group.areHardToFind)
  {
    std::replace(group.known.begin(), group.known.end(), Known::Gathered, Known::Shot);
  }
  return group;
}

/// What different sources send is not alike in its places: their product is that of their means.
double unevennessOf(const std::vector<WalkSource>& sources, const std::vector<FirstHits>& hits,
  const std::vector<LightSurvey::Group>& groups)
{
  const double area = hits.front().area();
  double power = 0, squares = 0; // W, W2/m2
  const auto add = [&](double more, double moreSquares) {
    squares += moreSquares + (area > 0 ? 2 * power * more / area : 0);
    power += more;
  };
  for (std::size_t i = 0; i < sources.size(); ++i)
  {
    add(hits[i].reflected(), hits[i].reflectedSquares());
    double emitted = 0, emittedSquares = 0;
    const std::vector<Light>& lights = sources[i].lights.lights();
    for (std::size_t light = 0; light < lights.size(); ++light)
    {
      if (groups[i].known[light] == Known::Dim && lights[light].cell.object == 0)
      {
        const double flux = lights[light].totalFlux();
        emitted += flux;
        emittedSquares += flux * flux / lights[light].surface()->area();
      }
    }
    add(emitted, emittedSquares);
  }
  return power > 0 ? std::max(1.0, squares * area / (power * power)) : 1;
}

/// Parts a source by how its lights are best known. `atLights`: see deal().
std::vector<WalkSource> partsOf(const WalkSource& source, const LightSurvey::Group& group,
  double atLights, const FewestSamples& fewestSamples)
{
  std::vector<WalkSource> parts;
  for (const Known part : { Known::Dim, Known::Shot })
  {
    WalkSource some{ group.lightsOf(source, part), source.plan };
    some.areFoundByRays = part == Known::Dim;
    some.areNear = part == Known::Shot && !group.areHardToFind;
    if (group.lamps && group.lamps->lights() == some.lights)
    {
      some.lamps = group.lamps;
    }
    if (!some.lights.isEmpty())
    {
      parts.push_back(std::move(some));
    }
  }
  if (parts.empty() || group.isGathered())
  {
    WalkSource gathered{ group.lightsOf(source, Known::Gathered), source.plan, kStaticPart };
    gathered.lamps = group.lamps;
    gathered.walksPerSample = group.walksPerSample;
    gathered.fewest = fewestSamples.atVariance(group.variance);
    const DistantLight* const distant =
      gathered.lights.isEmpty() ? nullptr : gathered.lights[0].distant();
    gathered.areFoundByRays = distant && distant->isSky(); // a source of its own
    parts.push_back(std::move(gathered));
  }
  if (parts.size() > 1 || !parts.front().cells)
  {
    deal(parts, source.plan, atLights);
  }
  return parts;
}

}

std::vector<WalkSource> sourcesOf(
  const SceneObjects& objects, const WalkPlan& plan, const LightWalls& walls)
{
  // A class is worth a few walks of each replicate, of enough quanta.
  constexpr double kFewestWalks = 4;
  const double walks = plan.walksAfter(1) / (kFewestWalks * plan.replicates().count());
  const LightTable lights(objects, plan.most(), walls);
  std::vector<WalkSource> sources;
  bool haveClasses = false;
  for (const bool isSky : { false, true })
  {
    std::vector<bool> chosen;
    for (const Light& light : lights.lights())
    {
      chosen.push_back((light.distant() && light.distant()->isSky()) == isSky);
    }
    const LightTable part = lights.only(chosen);
    if (part.isEmpty())
    {
      continue;
    }
    std::vector<LightTable> classes = powerClassesOf(
      part, objects, kFewestQuanta / (static_cast<double>(part.quantaPerWalk()) * walks));
    haveClasses = haveClasses || classes.size() > 1;
    for (LightTable& some : classes)
    {
      sources.push_back({ std::move(some), plan });
    }
  }
  if (sources.empty())
  {
    sources.push_back({ {}, plan });
  }
  if (sources.size() > 1)
  {
    constexpr double kAlike = 0.9;
    deal(sources, plan, 1, haveClasses ? kAlike : 0);
  }
  return sources;
}

LightTable LightSurvey::Group::lightsOf(const WalkSource& source, Known part) const
{
  std::vector<bool> chosen(known.size());
  std::transform(
    known.begin(), known.end(), chosen.begin(), [part](Known its) { return its == part; });
  return source.lights.only(chosen);
}

LightSurvey::LightSurvey(const SceneObjects& objects, const std::vector<WalkSource>& sources)
{
  const double reflected = meanReflectance(objects.staticObject);
  std::vector<FirstHits> hits;
  hits.reserve(sources.size());
  for (const WalkSource& source : sources)
  {
    hits.emplace_back(objects, source.lights);
  }
  for (std::size_t i = 0; i < sources.size(); ++i)
  {
    groups_.push_back(groupOf(objects, sources[i], hits[i], reflected));
  }
  unevenness_ = unevennessOf(sources, hits, groups_);
}

void FrameLights::update(const SceneObjects& objects, const WalkPlan& plan, ObjectSides& sides,
  const CancelPoint& cancelPoint)
{
  const auto mayTouchWalls = [](const WalkSource& source) { return source.lights.mayTouchWalls(); };
  // A wall that a point light touches may move.
  if (sources_.empty() || !(plan == plan_) || !areLightsUnchanged(objects, objects_) ||
    (std::any_of(sources_.begin(), sources_.end(), mayTouchWalls) &&
      hasMotion(findMoved(objects, objects_))))
  {
    sources_.clear();
    survey_.reset();
    sources_ = sourcesOf(objects, plan, lightWallsOf(objects, sides, cancelPoint));
    objects_ = objects;
    plan_ = plan;
  }
}

std::vector<WalkSource> directSourcesOf(const SceneObjects& objects,
  const std::vector<WalkSource>& sources, const LightSurvey& survey,
  const FewestSamples& fewestSamples)
{
  std::vector<WalkSource> gathered, all;
  std::uint32_t end = 0; // of the numbers of walks that start at lights
  const double reflected = meanReflectance(objects.staticObject);
  const bool isAnyGathered = std::any_of(
    survey.groups().begin(), survey.groups().end(), std::mem_fn(&LightSurvey::Group::isGathered));
  for (std::size_t i = 0; i < sources.size(); ++i)
  {
    // Walks of near lights, beside which others start at cells, have as little power as these, as
    // the noise of both is to cost alike.
    constexpr double kLeast = 0.25;
    constexpr std::uint32_t kMost = std::uint32_t{ 1 } << 28; // walks have numbers of 32 bits
    const double atLights =
      isAnyGathered && sources[i].plan.most() < kMost ? 1 / std::clamp(reflected, kLeast, 1.0) : 1;
    for (WalkSource& part : partsOf(sources[i], survey.groups()[i], atLights, fewestSamples))
    {
      if (!part.cells)
      {
        const WalkPlan& plan = part.plan;
        part.plan = WalkPlan(plan.walksAfter(1), plan.most(), plan.replicates().count(), end);
        end = part.plan.endWalk();
      }
      (part.cells ? gathered : all).push_back(std::move(part));
    }
  }
  // How many walks are born is not known yet: static cells have half of the numbers, the others
  // share the rest evenly.
  const std::vector<CellPart> parts = cellParts(objects);
  const auto groups = static_cast<std::uint32_t>(std::max<std::size_t>(1, gathered.size()));
  const auto others = static_cast<std::uint32_t>(parts.size() - 1);
  const std::uint32_t share = (std::numeric_limits<std::uint32_t>::max() - end) / groups;
  const std::uint32_t ofStatic = others > 0 ? share / 2 : share;
  for (const WalkSource& source : gathered)
  {
    for (const CellPart& part : parts)
    {
      all.push_back(source);
      all.back().cells = part;
      all.back().quantaPerStart = std::max<std::int64_t>(1,
        std::llround(LightSurvey::powerOfStart(reflected) *
          static_cast<double>(source.lights.quantaPerWalk())));
      const std::uint32_t ofSky = source.isSky() ? fewestSamples.ofSky : 0;
      all.back().fewest = ofSky > 0 ? FewestSamples{ ofSky, ofSky, ofSky }
        : part == kStaticPart       ? fewestSamples.asMany()
                                    : source.fewest;
      all.back().firstWalk = end;
      end += part == kStaticPart ? ofStatic : (share - ofStatic) / std::max(1u, others);
    }
  }
  return all;
}

void addLamps(std::vector<WalkSource>& sources)
{
  std::shared_ptr<const LampPieces> lamps;
  for (WalkSource& source : sources)
  {
    if (source.areFoundByRays && !source.cells)
    {
      continue; // nothing asks them
    }
    if (!source.isDynamic())
    {
      auto own = source.lamps ? std::make_shared<LampPieces>(*source.lamps)
                              : std::make_shared<LampPieces>(source.lights);
      own->setQuantaPerWalk(source.lights.quantaPerWalk()); // walks were dealt since
      lamps = std::move(own);
    }
    source.lamps = lamps;
  }
}

}
