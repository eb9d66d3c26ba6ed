// SPDX-License-Identifier: BSD-3-Clause
#include "DirectLight/PointLampChoice.h"

#include "DirectLight/WeightChoice.h"
#include "Geometry/Pi.h"

namespace irradiance
{

namespace
{

/// The area with which a point is weighed, m2: so small that no light seems to give it all of its
/// flux.
constexpr double kNoArea = 0x1p-200;

CellShape asCell(const LitPoint& point)
{
  CellShape shape;
  shape.center = point.position;
  shape.normal = point.normal;
  shape.area = kNoArea;
  return shape;
}

}

PointLampChoice::PointLampChoice(const LampPieces& lamps, const LitPoint& point, SeenLamp::By by,
  std::uint32_t samples, std::size_t most)
  : lamps_(lamps)
  , point_(point)
  , by_(by)
  , isRough_(lamps.size() > samples)
  , rough_(lamps, most)
{
  if (isRough_)
  {
    rough_.weigh(asCell(point));
    return;
  }
  targets_.reserve(2 * lamps.size());
  cumulative_.reserve(2 * lamps.size());
  std::vector<SeenLamp> parts;
  const auto add = [&](const Target& target) {
    targets_.push_back(target);
    sum_ += weightOf(target);
    cumulative_.push_back(sum_);
  };
  for (std::uint32_t piece = 0; piece < lamps.size(); ++piece)
  {
    if (isInAir(piece))
    {
      add({ piece, {} });
      continue;
    }
    parts.clear();
    SeenLamp::addParts(lamps[piece].triangle, point, by, parts);
    for (const SeenLamp& seen : parts)
    {
      add({ piece, seen });
    }
  }
}

bool PointLampChoice::isInAir(std::uint32_t piece) const
{
  return std::holds_alternative<PointLight>(lamps_.lights()[lamps_[piece].light].kind);
}

std::vector<SeenLamp> PointLampChoice::partsOf(std::uint32_t piece) const
{
  std::vector<SeenLamp> parts;
  SeenLamp::addParts(lamps_[piece].triangle, point_, by_, parts);
  return parts;
}

double PointLampChoice::weightOf(const Target& target) const
{
  const LampPiece& lamp = lamps_[target.piece];
  if (!target.seen)
  {
    const auto& inAir = std::get<PointLight>(lamps_.lights()[lamp.light].kind);
    const Vector3 along = point_.position - inAir.position();
    return lamp.flux * perWatt(inAir, along, point_.partOf(along));
  }
  const bool isInFront = lamp.normal.dot(point_.position - lamp.center) > 0;
  return isInFront ? lamp.flux * target.seen->taken() / (kPi * lamp.triangle.area()) : 0;
}

PointLampChoice::Choice PointLampChoice::choose(double sample) const
{
  if (isRough_)
  {
    return chooseRoughly(sample);
  }
  const WeightChoice found = chooseByWeight(cumulative_, sample);
  const Target& target = targets_[found.place];
  return { target.piece, found.weight / sum_, found.rest, target.seen };
}

/// A piece; then one of its parts.
PointLampChoice::Choice PointLampChoice::chooseRoughly(double sample) const
{
  const LampChoice::Choice chosen = rough_.choose(sample);
  Choice choice{ chosen.piece, chosen.probability, chosen.rest, {} };
  if (isInAir(chosen.piece))
  {
    return choice;
  }
  double sum = 0;
  const std::vector<SeenLamp> parts = partsOf(chosen.piece);
  std::vector<double> cumulative;
  cumulative.reserve(parts.size());
  for (const SeenLamp& part : parts)
  {
    cumulative.push_back(sum += part.taken());
  }
  if (parts.size() == 1)
  {
    choice.seen = parts.front();
  }
  else if (sum > 0)
  {
    const WeightChoice found = chooseByWeight(cumulative, chosen.rest);
    choice = { chosen.piece, chosen.probability * found.weight / sum, found.rest,
      parts[found.place] };
  }
  return choice;
}

double PointLampChoice::densityOf(std::uint32_t piece) const
{
  if (isEmpty())
  {
    return 0;
  }
  const double before = isRough_ || piece == 0 ? 0 : cumulative_[piece - 1];
  const double probability =
    isRough_ ? rough_.probabilityOf(piece) : (cumulative_[piece] - before) / sum_;
  return probability > 0 ? probability / partsOf(piece).front().solidAngle() : 0;
}

}
