// SPDX-License-Identifier: BSD-3-Clause
#include "Gathering/PointLampChoice.h"

#include "Geometry/Pi.h"

#include <algorithm>

namespace irradiance
{

namespace
{

/// The area with which a point is weighed, m2: so small that no light seems to give it all of its flux.
constexpr double kNoArea = 0x1p-200;

CellShape asCell(const LitPoint& point)
{
  CellShape shape;
  shape.center = point.position;
  shape.normal = point.normal;
  shape.area = kNoArea;
  return shape;
}

/// LitPoint::partOf() over a lamp, on average, roughly. What is below the horizon counts as 0; it is 0 if all corners are.
double meanPart(const LitPoint& point, const LampPiece& lamp)
{
  const auto part = [&](const Vector3& place) {
    return std::max(0.0, point.partOf(point.position - place));
  };
  const Triangle& triangle = lamp.triangle;
  return (part(triangle.a) + part(triangle.b) + part(triangle.c) + 3 * part(lamp.center)) / 6;
}

}

PointLampChoice::PointLampChoice(
  const LampPieces& lamps, const LitPoint& point, std::uint32_t samples, std::size_t most)
  : lamps_(lamps)
  , point_(point)
  , isRough_(lamps.size() > samples)
  , rough_(lamps, most)
{
  if (isRough_)
  {
    rough_.weigh(asCell(point));
    return;
  }
  seen_.reserve(lamps.size());
  cumulative_.reserve(lamps.size());
  for (std::size_t piece = 0; piece < lamps.size(); ++piece)
  {
    seen_.emplace_back(lamps[piece].triangle, point.position);
    sum_ += weightOf(lamps[piece]);
    cumulative_.push_back(sum_);
  }
}

double PointLampChoice::weightOf(const LampPiece& lamp) const
{
  if (const auto* const inAir = std::get_if<PointLight>(&lamps_.lights()[lamp.light].kind))
  {
    const Vector3 along = point_.position - inAir->position();
    return lamp.flux * perWatt(*inAir, along, point_.partOf(along));
  }
  const bool isInFront = lamp.normal.dot(point_.position - lamp.center) > 0;
  return isInFront
    ? lamp.flux * meanPart(point_, lamp) * seen_.back().solidAngle() / (kPi * lamp.triangle.area())
    : 0;
}

LampChoice::Choice PointLampChoice::choose(double sample) const
{
  if (isRough_)
  {
    return rough_.choose(sample);
  }
  const double place = sample * sum_;
  const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, place);
  const double before = found == cumulative_.begin() ? 0 : *(found - 1);
  const double own = *found - before;
  return { static_cast<std::uint32_t>(found - cumulative_.begin()), own / sum_,
    std::clamp((place - before) / own, 0.0, 1 - 0x1p-53) };
}

double PointLampChoice::probabilityOf(std::uint32_t piece) const
{
  if (isRough_)
  {
    return rough_.probabilityOf(piece);
  }
  const double before = piece == 0 ? 0 : cumulative_[piece - 1];
  return isEmpty() ? 0 : (cumulative_[piece] - before) / sum_;
}

SphericalTriangle PointLampChoice::seen(std::uint32_t piece) const
{
  return isRough_ ? SphericalTriangle(lamps_[piece].triangle, point_.position) : seen_[piece];
}

}
