// SPDX-License-Identifier: BSD-3-Clause
#include "DirectLight/PointLampChoice.h"

#include "Sampling/WeightChoice.h"

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

PointLampChoice::PointLampChoice(const LampPieces& lamps, const LitPoint& point, SeenLight::By by,
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
  for (std::uint32_t piece = 0; piece < lamps.size(); ++piece)
  {
    addParts(piece, targets_);
  }
  for (const SeenLight& target : targets_)
  {
    cumulative_.push_back(sum_ += target.irradiance(point));
  }
}

void PointLampChoice::addParts(std::uint32_t piece, std::vector<SeenLight>& parts) const
{
  const LampPiece& lamp = lamps_[piece];
  SeenLight::addParts(lamps_.lights()[lamp.light], lamp, point_, by_, parts);
}

PointLampChoice::Choice PointLampChoice::choose(double sample) const
{
  if (isRough_)
  {
    return chooseRoughly(sample);
  }
  const WeightChoice found = chooseByWeight(cumulative_, sample);
  const SeenLight& target = targets_[found.place];
  return { target.piece().light, found.weight / sum_, found.rest, target };
}

/// A piece; then one of its parts.
PointLampChoice::Choice PointLampChoice::chooseRoughly(double sample) const
{
  const LampChoice::Choice chosen = rough_.choose(sample);
  Choice choice{ lamps_[chosen.piece].light, chosen.probability, chosen.rest, {} };
  double sum = 0;
  std::vector<SeenLight> parts;
  addParts(chosen.piece, parts);
  std::vector<double> cumulative;
  cumulative.reserve(parts.size());
  for (const SeenLight& part : parts)
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
    choice = { choice.light, chosen.probability * found.weight / sum, found.rest,
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
  if (!(probability > 0))
  {
    return 0;
  }
  std::vector<SeenLight> parts;
  addParts(piece, parts);
  return probability / parts.front().solidAngle();
}

}
