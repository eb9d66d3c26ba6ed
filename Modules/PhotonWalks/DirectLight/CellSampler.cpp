// SPDX-License-Identifier: BSD-3-Clause
#include "DirectLight/CellSampler.h"

#include "Lights/SeenLight.h"
#include "Sampling/DirectionSampling.h"
#include "Sampling/SphericalTriangle.h"
#include "Sampling/WeightChoice.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace irradiance
{

namespace
{

/// Whether one of a pair is so large, as seen from the other, that its point is chosen by solid
/// angle.
bool isWide(double radius, double other, const Vector3& between)
{
  constexpr double kWide = 0.25; // radius / distance
  return radius >= other && radius * radius > kWide * kWide * between.squaredNorm();
}

/// The weights of a place in the plane of a triangle; none beside the triangle.
std::optional<Vector3> weightsAt(const Triangle& triangle, const Vector3& place)
{
  const Vector3 weights = weightsInPlane(triangle, place);
  return weights.minCoeff() >= 0 ? std::optional<Vector3>(weights) : std::nullopt;
}

}

CellSampler::CellSampler(const CellShapes& cells, const Frame& frame, const LampPieces& lamps,
  const DirectPlan& plan, std::uint64_t seed)
  : cells_(cells)
  , frame_(frame)
  , lamps_(lamps)
  , plan_(plan)
  , seed_(seed)
  , choice_(lamps)
{
}

void CellSampler::setCell(std::size_t cell)
{
  cell_ = cell;
  choice_.weigh(cells_[cell]);
  parts_.clear();
  areas_.clear();
  double area = 0;
  std::for_each(cells_.begin(cell), cells_.end(cell), [&](std::uint32_t number) {
    const Triangle triangle = triangleOf(frame_.triangles, number);
    parts_.push_back({ number, triangle, triangle.area(),
      lamps_.lightsAt(frame_.contacts, frame_.triangles.idOf(number)) });
    areas_.push_back(area += parts_.back().area);
  });
  // By its first sample: objects that are away have cells in a frame that follows others, but never
  // samples.
  const std::uint64_t seed = splitMix(seed_ ^ splitMix(plan_.first(cell)));
  cellKeys_ = SampleKeys(splitMix(seed));
  lightKeys_ = SampleKeys(splitMix(seed + 1));
  net_ = SobolNet(seed);
}

std::pair<CellSampler::Square, CellSampler::Square> CellSampler::squares(std::uint32_t number) const
{
  if (plan_.samplesOf(cell_) < kOneNet)
  {
    return { SobolPoint::inUnitSquare(number, cellKeys_),
      SobolPoint::inUnitSquare(number, lightKeys_) };
  }
  const SobolNet::Point point = net_.inUnitCube(number);
  return { Square{ point[0], point[1] }, Square{ point[2], point[3] } };
}

DirectSample CellSampler::sample(std::uint32_t number) const
{
  auto [onCell, onLight] = squares(number);
  const Part& part = choosePart(onCell[0]);
  DirectSample sample{};
  sample.triangle = part.number;
  // Half of the samples ask the lights that coincide, if any do, half all others.
  const double share = part.touching.empty() ? 1 : 0.5;
  const bool asksTouching = share < 1 && onLight[0] < share;
  if (share < 1)
  {
    onLight[0] = asksTouching ? 2 * onLight[0] : 2 * onLight[0] - 1;
  }
  asksTouching ? gatherTouching(part, onCell, onLight[0], sample)
               : gather(part, onCell, onLight, sample);
  const CellShape& cell = cells_[cell_];
  const bool isDark = sample.isFront ? cell.isFrontDark : cell.isBackDark;
  sample.part = isDark ? 0 : std::max(0.0, sample.part) / (share * plan_.samplesOf(cell_));
  return sample;
}

const CellSampler::Part& CellSampler::choosePart(double& u) const
{
  const double area = u * areas_.back();
  const std::size_t place = placeByWeight(areas_, area);
  const Part& part = parts_[place];
  const double before = place == 0 ? 0 : areas_[place - 1];
  // In (0, 1), as coordinates are.
  u = std::clamp((area - before) / part.area, 0x1p-53, 1 - 0x1p-53);
  return part;
}

void CellSampler::gather(
  const Part& part, Square onCell, Square onLight, DirectSample& sample) const
{
  const WeightChoice choice = choice_.choose(onLight[0]);
  onLight[0] = choice.rest;
  const LampPiece& lamp = lamps_[choice.place];
  sample.light = lamp.light;
  gatherFrom(lamp, part, onCell, onLight, sample);
  const bool isTouching =
    std::find(part.touching.begin(), part.touching.end(), lamp.light) != part.touching.end();
  sample.part = isTouching ? 0 : lamp.share * sample.part / choice.weight;
}

SurfacePoint CellSampler::cellPoint(const Part& part, const Vector3& weights, DirectSample& sample)
{
  // The walks that start there know it by these.
  sample.weightB = static_cast<float>(weights[1]);
  sample.weightC = static_cast<float>(weights[2]);
  const double b = sample.weightB, c = sample.weightC;
  return surfacePoint(part.triangle, { std::max(0.0, 1 - b - c), b, c });
}

void CellSampler::gatherFrom(const LampPiece& lamp, const Part& part, Square onCell, Square onLight,
  DirectSample& sample) const
{
  const CellShape& cell = cells_[cell_];
  const Light& light = lamps_.lights()[lamp.light];
  if (lamp.part)
  {
    gatherFromAfar(lamp, part, onCell, onLight, sample);
    return;
  }
  const Vector3 between = cell.center - lamp.center;
  LightPlace from{};
  SurfacePoint to{};
  const auto distance = [&] { return (from.position() - to.position).norm(); };
  const auto arriving = [&] {
    return std::abs(to.normal.dot(from.position() - to.position)) / distance();
  };
  if (isWide(lamp.radius, cell.radius, between))
  {
    to = cellPoint(part, sampleTriangle(onCell), sample);
    const SphericalTriangle seen(lamp.triangle, to.position);
    from = light.place(seen.sample(onLight), &lamp.triangle);
    sample.part = cell.area * arriving() * seen.solidAngle() / lamp.triangle.area();
  }
  else if (lamp.radius == 0 || isWide(cell.radius, lamp.radius, between))
  {
    from = light.place(sampleTriangle(onLight), &lamp.triangle);
    const SphericalTriangle seen(part.triangle, from.position());
    to = cellPoint(part, seen.sample(onCell), sample);
    sample.part = from.leaving(to.position) * seen.solidAngle() * cell.area / part.area;
  }
  else
  {
    to = cellPoint(part, sampleTriangle(onCell), sample);
    from = light.place(sampleTriangle(onLight), &lamp.triangle);
    sample.part = cell.area * from.leaving(to.position) * arriving() / (distance() * distance());
  }
  sample.part *= from.perSteradian(to);
  sample.from = from.origin();
  to.turn(to.normal.dot(sample.from - to.position) >= 0);
  sample.isFront = to.isFront;
  sample.to = to.clearPosition();
}

void CellSampler::gatherFromAfar(const LampPiece& lamp, const Part& part, const Square& onCell,
  const Square& onLight, DirectSample& sample) const
{
  const DistantLight& light = *lamps_.lights()[lamp.light].distant();
  const DistantLight::Sample sky = light.sample(*lamp.part, onLight);
  SurfacePoint to = cellPoint(part, sampleTriangle(onCell), sample);
  to.turn(to.normal.dot(sky.direction) >= 0);
  sample.isFront = to.isFront;
  sample.to = to.clearPosition();
  sample.from = light.entry(sample.to, sky.direction);
  sample.part = cells_[cell_].area * to.normal.dot(sky.direction) * sky.perWatt;
}

/// The point is chosen on the cell, or on the lights if these are smaller: else hardly a sample
/// would find them.
void CellSampler::gatherTouching(
  const Part& part, const Square& u, double uLight, DirectSample& sample) const
{
  const CellShape& cell = cells_[cell_];
  const auto areaOf = [&](std::uint32_t number) { return touchingTriangle(number).area(); };
  double all = 0;
  for (const std::uint32_t number : part.touching)
  {
    all += areaOf(number);
  }
  if (all < part.area)
  {
    double left = uLight * all;
    const auto chosen = std::find_if(part.touching.begin(), part.touching.end() - 1,
      [&](std::uint32_t number) { return (left -= areaOf(number)) < 0; });
    const Triangle& light = touchingTriangle(*chosen);
    const Vector3 weights = sampleTriangle(u);
    if (const std::optional<Vector3> onCell =
          weightsAt(part.triangle, surfacePoint(light, weights).position))
    {
      cross(*chosen, weights, cellPoint(part, *onCell, sample), sample);
      sample.part = cell.area / part.area * (all / light.area());
    }
    return;
  }
  const SurfacePoint point = cellPoint(part, sampleTriangle(u), sample);
  for (const std::uint32_t number : part.touching)
  {
    const Triangle& light = touchingTriangle(number);
    if (const std::optional<Vector3> weights = weightsAt(light, point.position))
    {
      cross(number, *weights, point, sample);
      sample.part = cell.area / light.area();
      return;
    }
  }
}

/// The cell touches the light: the ray has length 0, so it is given the direction of the light's
/// normal.
void CellSampler::cross(std::uint32_t light, const Vector3& weights, const SurfacePoint& onCell,
  DirectSample& sample) const
{
  const SurfacePoint start = surfacePoint(touchingTriangle(light), weights);
  sample.light = light;
  sample.from = start.clearPosition();
  sample.to = sample.from + start.normal;
  sample.isFront = onCell.normal.dot(start.normal) < 0;
}

}
