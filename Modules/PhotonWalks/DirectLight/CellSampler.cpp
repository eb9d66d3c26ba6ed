// SPDX-License-Identifier: BSD-3-Clause
#include "DirectLight/CellSampler.h"

#include "DirectLight/LitPoint.h"
#include "Geometry/Pi.h"
#include "Sampling/DirectionSampling.h"
#include "Sampling/SphericalTriangle.h"
#include "Sampling/SplitMix.h"

#include <algorithm>
#include <cmath>
#include <iterator>
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

CellSampler::CellSampler(const CellShapes& cells, const GatherSpace& space, const LampPieces& lamps,
  const DirectPlan& plan, std::uint64_t seed)
  : cells_(cells)
  , space_(space)
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
  double area = 0;
  std::for_each(cells_.begin(cell), cells_.end(cell), [&](std::uint32_t number) {
    const Triangle triangle = triangleOf(space_.triangles, number);
    parts_.push_back({ number, triangle, triangle.area(), area, lightsAt(number) });
    area += parts_.back().area;
  });
  // By its first sample: objects that are away have cells in a frame that follows others, but never
  // samples.
  const std::uint64_t seed = splitMix(seed_ ^ splitMix(plan_.first(cell)));
  cellKeys_ = SampleKeys(splitMix(seed));
  lightKeys_ = SampleKeys(splitMix(seed + 1));
  net_ = SobolNet(seed);
}

/// Of the table; lights of other groups may coincide as well.
std::vector<std::uint32_t> CellSampler::lightsAt(std::uint32_t triangle) const
{
  std::vector<std::uint32_t> lights;
  space_.contacts.forEachLampAt(space_.triangles.idOf(triangle), [&](const TriangleId& id) {
    if (const std::optional<std::uint32_t> light = lamps_.lightOn(id))
    {
      lights.push_back(*light);
    }
  });
  return lights;
}

CellSampler::Squares CellSampler::squares(std::uint32_t number) const
{
  if (plan_.samplesOf(cell_) < kOneNet)
  {
    return { SobolPoint::inUnitSquare(number, cellKeys_),
      SobolPoint::inUnitSquare(number, lightKeys_) };
  }
  const SobolNet::Point point = net_.inUnitCube(number);
  return { { point[0], point[1] }, { point[2], point[3] } };
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
  const double area = u * (parts_.back().areaBefore + parts_.back().area);
  const auto after = std::upper_bound(parts_.begin() + 1, parts_.end(), area,
    [](double value, const Part& part) { return value < part.areaBefore; });
  const Part& part = *std::prev(after);
  // In (0, 1), as coordinates are.
  u = std::clamp((area - part.areaBefore) / part.area, 0x1p-53, 1 - 0x1p-53);
  return part;
}

void CellSampler::gather(
  const Part& part, Square onCell, Square onLight, DirectSample& sample) const
{
  const LampChoice::Choice choice = choice_.choose(onLight[0]);
  onLight[0] = choice.rest;
  const LampPiece& lamp = lamps_[choice.piece];
  sample.light = lamp.light;
  const auto* const point = std::get_if<PointLight>(&lamps_.lights()[lamp.light].kind);
  point ? gatherFrom(*point, part, onCell, sample)
        : gatherFrom(lamp, part, onCell, onLight, sample);
  const bool isTouching =
    std::find(part.touching.begin(), part.touching.end(), lamp.light) != part.touching.end();
  sample.part = isTouching ? 0 : lamp.share * sample.part / choice.probability;
}

SurfacePoint CellSampler::cellPoint(const Part& part, const Vector3& weights, DirectSample& sample)
{
  // The walks that start there know it by these.
  sample.weightB = static_cast<float>(weights[1]);
  sample.weightC = static_cast<float>(weights[2]);
  const double b = sample.weightB, c = sample.weightC;
  return surfacePoint(part.triangle, { std::max(0.0, 1 - b - c), b, c });
}

double CellSampler::Ends::leaving() const
{
  return light.normal.dot(cell.position - light.position) / distance();
}

/// Closer to a plane, rounding would tell the side; what lies in the plane of a light gets nothing
/// of it.
bool CellSampler::Ends::areClear() const
{
  const Vector3 between = cell.position - light.position;
  return light.normal.dot(between) > 4 * light.clearance &&
    std::abs(cell.normal.dot(between)) > 4 * cell.clearance;
}

double CellSampler::Ends::arriving() const
{
  return std::abs(cell.normal.dot(light.position - cell.position)) / distance();
}

void CellSampler::gatherFrom(const LampPiece& lamp, const Part& part, Square onCell, Square onLight,
  DirectSample& sample) const
{
  const CellShape& cell = cells_[cell_];
  const Vector3 between = cell.center - lamp.center;
  Ends ends{};
  if (isWide(lamp.radius, cell.radius, between))
  {
    ends.cell = cellPoint(part, sampleTriangle(onCell), sample);
    const SphericalTriangle seen(lamp.triangle, ends.cell.position);
    ends.light = surfacePoint(lamp.triangle, seen.sample(onLight));
    sample.part = cell.area * ends.arriving() * seen.solidAngle() / lamp.triangle.area();
  }
  else if (isWide(cell.radius, lamp.radius, between))
  {
    ends.light = surfacePoint(lamp.triangle, sampleTriangle(onLight));
    const SphericalTriangle seen(part.triangle, ends.light.position);
    ends.cell = cellPoint(part, seen.sample(onCell), sample);
    sample.part = ends.leaving() * seen.solidAngle() * cell.area / part.area;
  }
  else
  {
    ends.cell = cellPoint(part, sampleTriangle(onCell), sample);
    ends.light = surfacePoint(lamp.triangle, sampleTriangle(onLight));
    const double distance = ends.distance();
    sample.part = cell.area * ends.leaving() * ends.arriving() / (distance * distance);
  }
  sample.part *= ends.areClear() ? 1 / kPi : 0;
  sample.from = ends.light.clearPosition();
  arrive(ends.cell, sample);
}

void CellSampler::gatherFrom(
  const PointLight& light, const Part& part, Square onCell, DirectSample& sample) const
{
  sample.from = light.position();
  const SphericalTriangle seen(part.triangle, light.position());
  const SurfacePoint point = cellPoint(part, seen.sample(onCell), sample);
  const Vector3 towards = (point.position - light.position()).normalized();
  sample.part = light.density(towards) * seen.solidAngle() * cells_[cell_].area / part.area;
  arrive(point, sample);
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

const Triangle& CellSampler::touchingTriangle(std::uint32_t light) const
{
  return std::get<AreaLight>(lamps_.lights()[light].kind).triangle;
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

void CellSampler::arrive(SurfacePoint point, DirectSample& sample)
{
  point.turn(point.normal.dot(sample.from - point.position) >= 0);
  sample.isFront = point.isFront;
  sample.to = point.clearPosition();
}

}
