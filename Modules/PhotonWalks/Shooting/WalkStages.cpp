// SPDX-License-Identifier: BSD-3-Clause
#include "Shooting/WalkStages.h"

#include "Shooting/FrontLoops.h"
#include "Surfaces/CellShapes.h"

#include <algorithm>
#include <cassert>
#include <stdexcept>
#include <string>

namespace irradiance
{

namespace
{

/// A walk that needs more is in a closed scene that absorbs nothing: it would never end.
constexpr std::uint32_t kMostBounces = 1u << 20;

/// Not inlined: GCC 12 with -O3 takes two conversions of a pair, to float and back, for none.
__attribute__((noinline)) Eigen::Vector3f toFloat(const Vector3& v)
{
  return v.cast<float>();
}

void setDirection(WalkFront& front, std::size_t place, const Vector3& direction)
{
  front.directionX[place] = static_cast<float>(direction[0]);
  front.directionY[place] = static_cast<float>(direction[1]);
  front.directionZ[place] = static_cast<float>(direction[2]);
}

void setOrigin(WalkFront& front, std::size_t place, const Vector3& origin)
{
  front.originX[place] = origin[0];
  front.originY[place] = origin[1];
  front.originZ[place] = origin[2];
}

/// Light of all others leaves faces diffusely.
bool startsItself(const Light& light)
{
  return !light.area() || light.distribution();
}

}

Vector3 roundedDirection(const Vector3& direction, const Vector3& normal)
{
  // Rounding turns a direction by up to 2^-24. What then points into the surface, or grazes it so
  // that the sign is a matter of rounding in double, is raised by more than that.
  constexpr double kLift = 0x1p-22, kGrazing = 0x1p-30;
  const auto rounded = [](const Vector3& v) { return Vector3(toFloat(v).cast<double>()); };
  const Vector3 nearest = rounded(direction);
  return nearest.dot(normal) > kGrazing ? nearest : rounded(direction + kLift * normal);
}

WalkStages::WalkStages(const SceneObjects& objects, const SceneTriangles& triangles,
  const LightTable& lights, const SobolSequence& samples, const DirectRounds* gathered)
  : objects_(objects)
  , triangles_(triangles)
  , lights_(lights)
  , samples_(samples)
  , gathered_(gathered)
{
  for (const Light& light : lights.lights())
  {
    triangleOfLight_.push_back(triangles.numberOf(light.triangle()));
    hasOwnStarts_ = hasOwnStarts_ || startsItself(light);
  }
}

void WalkStages::start(WalkFront& front) const
{
  if (front.size == 0)
  {
    return;
  }
  std::fill_n(front.bounce.data(), front.size, 0u);
  std::fill_n(front.parent.data(), front.size, WalkFront::kNone);
  gathered_ ? startAtCells(front) : startAtLights(front);
}

void WalkStages::startAtLights(WalkFront& front) const
{
  assert(!lights_.isEmpty());
  front.pad();
  frontLoops().start(front, samples_, lights_.cumulativeFlux(), triangleOfLight_.data());
  if (triangles_.hasGlossy())
  {
    std::fill_n(front.leaving.data(), front.size, Leaving::Diffuse);
  }
  for (std::size_t i = 0; bands() > 1 && i < front.size; ++i)
  {
    front.setPower(i, bands(), lights_.power(front.candidate[i]));
  }
  leave(front);
  if (hasOwnStarts_)
  {
    startByLights(front);
  }
}

void WalkStages::startAtCells(WalkFront& front) const
{
  for (std::size_t i = 0; i < front.size; ++i)
  {
    const WalkStarts& starts = gathered_->startsOf(front.walk[i]);
    const WalkStarts::Start& start = starts[front.walk[i]];
    const DirectSample& sample = starts.sampleOf(start);
    front.start[i] = sample.triangle;
    front.weightB[i] = sample.weightB;
    front.weightC[i] = sample.weightC;
    front.side[i] = sample.isFront != isThrough(start.leaving) ? 1 : 0;
    if (triangles_.hasGlossy())
    {
      front.leaving[i] = start.leaving;
      setOrigin(front, i, sample.from);
      if (start.leaving == Leaving::Straight)
      {
        goStraight(front, i, sample.triangle, sample.isFront);
      }
    }
    if (bands() > 1)
    {
      front.setPower(i, bands(), start.power);
    }
  }
  leave(front);
}

/// Such lights are few, and each has walls or a table of its own.
void WalkStages::startByLights(WalkFront& front) const
{
  for (std::size_t i = 0; i < front.size; ++i)
  {
    const Light& light = lights_[front.candidate[i]];
    if (startsItself(light))
    {
      const Ray ray = light.leaving(samples_.sample(front.walk[i], 0, SampleUse::Position),
        samples_.sample(front.walk[i], 0, SampleUse::Direction));
      setOrigin(front, i, ray.origin);
      setDirection(front, i,
        light.area() ? roundedDirection(ray.direction, light.surface()->areaVector().normalized())
                     : ray.direction);
    }
  }
}

void WalkStages::findSides(WalkFront& front) const
{
  front.pad();
  frontLoops().findSides(front, SceneRows(triangles_));
}

void WalkStages::absorb(WalkFront& from, WalkFront& to) const
{
  to.reserve(from.size, bands());
  to.size = 0;
  if (from.size == 0)
  {
    return;
  }
  from.pad();
  if (bands() == 1)
  {
    frontLoops().survive(from, SceneRows(triangles_), samples_);
    chooseWays(from);
  }
  else
  {
    frontLoops().draw(from, samples_);
    decideByPowers(from);
  }
  frontLoops().pack(from, to, triangles_.hasGlossy(), bands());
  checkEnds(to);
}

/// `front.candidate`: the samples.
void WalkStages::decideByPowers(WalkFront& front) const
{
  std::fill_n(front.survivors.data(), front.groups(), 0u);
  for (std::size_t i = 0; i < front.size; ++i)
  {
    if (front.hit[i] != WalkFront::kNone &&
      choose(front, i, SobolPoint::toUnit(front.candidate[i])))
    {
      front.survivors[i / WalkFront::kGroup] |= 1u << i % WalkFront::kGroup;
    }
  }
}

/// One band.
void WalkStages::chooseWays(WalkFront& front) const
{
  for (std::size_t i = 0; triangles_.hasGlossy() && i < front.size; ++i)
  {
    const std::uint32_t hit = front.hit[i], bit = 1u << i % WalkFront::kGroup;
    std::uint32_t& survivors = front.survivors[i / WalkFront::kGroup];
    front.leaving[i] = Leaving::Diffuse;
    if (hit != WalkFront::kNone && triangles_.looks()[hit].isGlossy() && (survivors & bit) != 0)
    {
      survivors &= choose(front, i, SobolPoint::toUnit(front.candidate[i])) ? ~0u : ~bit;
    }
  }
}

bool WalkStages::choose(WalkFront& front, std::size_t row, double sample) const
{
  const TriangleId id = triangles_.idOf(front.hit[row]);
  const Material& material = materialOf(id.object);
  const std::uint32_t cell = cellOf(id);
  const Power incoming = front.powerAt(row, bands() > 1 ? bands() : 0);
  const bool isPane = material.isPane(cell), isFront = front.hitSide[row] != 0;
  const double cosine = isPane ? goStraight(front, row, front.hit[row], isFront) : 1;
  const SurvivalProbabilities survival = survivalProbabilities(incoming, material, cell, cosine);
  // In one band the kernel has decided, but for panes.
  if ((bands() > 1 || isPane) && !(sample < survival.total()))
  {
    return false;
  }
  const Leaving way = survival.at(sample);
  if (way == Leaving::Straight && !isPane)
  {
    goStraight(front, row, front.hit[row], isFront);
  }
  front.leaving[row] = way;
  front.hitSide[row] = isFront != isThrough(way) ? 1 : 0;
  if (bands() > 1)
  {
    front.setPower(
      row, bands(), survivingPower(incoming, material, cell, way, survival.of(way), cosine));
  }
  return true;
}

void WalkStages::checkEnds(const WalkFront& front) const
{
  const std::uint32_t* const first = front.bounce.data();
  const std::uint32_t* const last = std::max_element(first, first + front.size);
  if (front.size > 0 && *last > kMostBounces)
  {
    throw std::runtime_error("walk " +
      std::to_string(front.walk[static_cast<std::size_t>(last - first)]) +
      " does not end: the light cannot leave a part of the scene that hardly absorbs any, as the "
      "reflectances there are too near 1");
  }
}

void WalkStages::leave(WalkFront& front) const
{
  if (front.size == 0)
  {
    return;
  }
  front.pad();
  const auto sharp = sharpDirections(front); // the loop overwrites what it reads
  frontLoops().leave(front, SceneRows(triangles_), samples_);
  for (const auto& [row, direction] : sharp)
  {
    setDirection(front, row, direction);
  }
}

SurfacePoint WalkStages::pointOf(
  const WalkFront& front, std::size_t row, std::uint32_t triangle, bool isFront) const
{
  const double b = front.weightB[row], c = front.weightC[row];
  SurfacePoint point = surfacePoint(triangleOf(triangles_, triangle), { 1 - b - c, b, c });
  point.turn(isFront);
  return point;
}

double WalkStages::goStraight(
  WalkFront& front, std::size_t row, std::uint32_t triangle, bool isFront) const
{
  const SurfacePoint point = pointOf(front, row, triangle, isFront);
  const Vector3 incoming =
    incomingDirection(point, { front.originX[row], front.originY[row], front.originZ[row] });
  setDirection(front, row, roundedDirection(incoming, -point.normal));
  return -point.normal.dot(incoming);
}

/// Each has a lobe of its own, or goes on as it came.
std::vector<std::pair<std::size_t, Vector3>> WalkStages::sharpDirections(
  const WalkFront& front) const
{
  std::vector<std::pair<std::size_t, Vector3>> directions;
  directions.reserve(triangles_.hasGlossy() ? front.size : 0);
  for (std::size_t i = 0; triangles_.hasGlossy() && i < front.size; ++i)
  {
    if (!isSharp(front.leaving[i]))
    {
      continue;
    }
    if (front.leaving[i] == Leaving::Straight)
    {
      directions.emplace_back(
        i, Vector3(front.directionX[i], front.directionY[i], front.directionZ[i]));
      continue;
    }
    const SurfacePoint point = pointOf(front, i, front.start[i], front.side[i] != 0);
    const Vector3 incoming =
      incomingDirection(point, { front.originX[i], front.originY[i], front.originZ[i] });
    const auto sample = [&](SampleUse use) {
      return samples_.sample(front.walk[i], front.bounce[i], use);
    };
    const LobeSample samples{ sample(SampleUse::Direction), sample(SampleUse::Acceptance)[0],
      sample(SampleUse::Compensation) };
    const TriangleId id = triangles_.idOf(front.start[i]);
    const PhongLobe& lobe = materialOf(id.object).lobeOf(cellOf(id));
    directions.emplace_back(
      i, roundedDirection(lobe.sample(point.normal, incoming, samples), point.normal));
  }
  return directions;
}

Leaving WalkStages::leavingOf(const TriangleId& hit, std::uint32_t walk, std::uint32_t bounce,
  const Power& incoming, double cosine) const
{
  const SurvivalProbabilities survival =
    survivalProbabilities(incoming, materialOf(hit.object), cellOf(hit), cosine);
  const auto isOther = [](double part) { return part != 0; };
  // Most cells of a shiny object may be matte: what survives there needs no sample.
  return std::any_of(survival.ways.begin() + 1, survival.ways.end(), isOther)
    ? survival.at(samples_.sample(walk, bounce, SampleUse::Survival)[0])
    : Leaving::Diffuse;
}

}
