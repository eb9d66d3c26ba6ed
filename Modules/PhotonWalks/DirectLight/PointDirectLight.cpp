// SPDX-License-Identifier: BSD-3-Clause
#include "DirectLight/PointDirectLight.h"

#include "Sampling/SobolPoint.h"
#include "Sampling/WeightChoice.h"

#include <algorithm>
#include <optional>
#include <utility>

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

/**
 * Which lamp a sample of a point asks, and what it sees of that. If there are no more lamps than
 * samples, the weights are what each brings if nothing stands between: exactly, for a point that
 * receives from all directions or for lights in the air, else but for how the cosine varies over
 * the lamp. Of more lamps LampChoice tells roughly which bring how much.
 */
class PointLampChoice
{
public:
  /// The lamps must outlive it. `by`: see SeenLight. `most`: weights, see LampChoice.
  PointLampChoice(const LampPieces& lamps, const LitPoint& point, SeenLight::By by,
    std::uint32_t samples, std::size_t most);

  /// Whether no light can come.
  bool isEmpty() const { return !isRough_ && !(sum_ > 0); }
  struct Choice
  {
    std::uint32_t light;
    double probability;
    double rest;                   ///< in [0, 1): what the choice left of the sample
    std::optional<SeenLight> seen; ///< none if all of the piece is below the horizon
  };
  /// `sample`: in (0, 1). Not if it is empty.
  Choice choose(double sample) const;
  /// By solid angle, the probability of a piece over its solid angle, 1/sr; 0 if it is empty.
  double densityOf(std::uint32_t piece) const;

private:
  /// What the point sees of a piece.
  void addParts(std::uint32_t piece, std::vector<SeenLight>& parts) const;
  Choice chooseRoughly(double sample) const;

  const LampPieces& lamps_;
  LitPoint point_;
  SeenLight::By by_;
  bool isRough_;
  LampChoice rough_;
  std::vector<SeenLight> targets_;
  std::vector<double> cumulative_; ///< weights up to and including each target
  double sum_ = 0;
};

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
  const WeightChoice chosen = rough_.choose(sample);
  Choice choice{ lamps_[chosen.place].light, chosen.weight, chosen.rest, {} };
  double sum = 0;
  std::vector<SeenLight> parts;
  addParts(static_cast<std::uint32_t>(chosen.place), parts);
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
    choice = { choice.light, chosen.weight * found.weight / sum, found.rest, parts[found.place] };
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

PointDirectLight::PointDirectLight(const Frame& frame, std::shared_ptr<const LampPieces> lamps,
  std::uint64_t seed, std::uint32_t samples, std::size_t mostWeights)
  : frame_(frame)
  , lamps_(std::move(lamps))
  , seed_(seed)
  , samples_(samples)
  , mostWeights_(mostWeights)
{
}

Bands PointDirectLight::irradiance(
  const LitPoint& point, std::uint64_t number, std::vector<ShadowRay>* rays) const
{
  return arriving(point, arrivalsAt(point, number, 1), true, rays);
}

std::vector<PointDirectLight::Arrival> PointDirectLight::arrivalsAt(
  const LitPoint& point, std::uint64_t number, std::size_t replicates) const
{
  std::vector<Arrival> arrivals;
  const std::vector<std::uint32_t> touching = lightsAt(point);
  addTouching(point, touching, replicates, arrivals);
  const Part cosine = [&](const Vector3& along, double) { return point.partOf(along); };
  addSamples(point, SeenLight::By::Cosine, cosine, number, 0, touching, replicates, arrivals);
  return arrivals;
}

std::int64_t PointDirectLight::update(const LitPoint& point, std::uint64_t number,
  const MayChange& mayChange, std::vector<ShadowRay>& rays, std::vector<Bands>& replicates) const
{
  const std::vector<Arrival> arrivals = arrivalsAt(point, number, replicates.size());
  const bool isFirst = rays.empty();
  rays.resize(arrivals.size());
  std::vector<std::size_t> changed;
  std::vector<Arrival> anew;
  for (std::size_t i = 0; i < arrivals.size(); ++i)
  {
    if (isFirst || mayChange(rays[i]))
    {
      changed.push_back(i);
      anew.push_back(arrivals[i]);
    }
  }
  const std::vector<ClearSheets::Way> ways = cast(point, anew, true);
  for (std::size_t i = 0; i < anew.size(); ++i)
  {
    rays[changed[i]] = shadowRayOf(anew[i], point, ways[i]);
  }
  for (std::size_t i = 0; i < arrivals.size(); ++i)
  {
    if (rays[i].passed > 0)
    {
      replicates[arrivals[i].replicate] += 0x1p-24 * rays[i].passed * broughtBy(arrivals[i]);
    }
  }
  return static_cast<std::int64_t>(anew.size());
}

Bands PointDirectLight::taken(
  const LitPoint& point, const Part& part, std::uint64_t number, std::uint32_t share) const
{
  std::vector<Arrival> arrivals;
  addSamples(point, SeenLight::By::SolidAngle, part, number, share, lightsAt(point), 1, arrivals);
  return arriving(point, arrivals, false);
}

double PointDirectLight::density(
  const LitPoint& point, const TriangleId& lamp, const Vector3& place) const
{
  const std::optional<std::uint32_t> light = lamps_->lightOn(lamp);
  const std::vector<std::uint32_t> touching = lightsAt(point);
  if (!light || std::find(touching.begin(), touching.end(), *light) != touching.end())
  {
    return 0;
  }
  const PointLampChoice choice(*lamps_, point, SeenLight::By::SolidAngle, samples_, mostWeights_);
  return samples_ * choice.densityOf(lamps_->pieceAt(*light, place));
}

Bands PointDirectLight::arriving(const LitPoint& point, const std::vector<Arrival>& arrivals,
  bool mayPass, std::vector<ShadowRay>* rays) const
{
  Bands sum{};
  const std::vector<ClearSheets::Way> ways = cast(point, arrivals, mayPass);
  for (std::size_t i = 0; i < arrivals.size(); ++i)
  {
    if (const double part = arrivingBy(ways[i], point); part > 0)
    {
      sum += part * broughtBy(arrivals[i]);
    }
    if (rays)
    {
      rays->push_back(shadowRayOf(arrivals[i], point, ways[i]));
    }
  }
  return sum;
}

std::vector<ClearSheets::Way> PointDirectLight::cast(
  const LitPoint& point, const std::vector<Arrival>& arrivals, bool mayPass) const
{
  std::vector<Ray> rays(arrivals.size());
  std::transform(arrivals.begin(), arrivals.end(), rays.begin(),
    [](const Arrival& arrival) { return arrival.ray; });
  return ClearSheets{ frame_.objects, frame_.scene, &frame_.contacts,
    mayPass && frame_.triangles.hasGlossy() }
    .cast(rays.data(), rays.size(), [&](std::size_t) { return point.on; });
}

/// `hit`: what it meets; on a face with contacts it has to be that face.
double PointDirectLight::arrivingBy(const ClearSheets::Way& way, const LitPoint& point) const
{
  const bool arrives = (way.hit && way.hit.id == point.on) ||
    (way.hit.distance >= 1 && !frame_.contacts.has(point.on));
  return arrives ? way.passed : 0;
}

ShadowRay PointDirectLight::shadowRayOf(
  const Arrival& arrival, const LitPoint& point, const ClearSheets::Way& way) const
{
  const Hit& hit = way.hit;
  const double part = arrivingBy(way, point);
  const bool isStopped = !(part > 0);
  const Vector3& from = arrival.ray.origin;
  const Vector3 to =
    isStopped && hit ? from + hit.distance * arrival.ray.direction : point.position;
  const Contacts& contacts = frame_.contacts;
  const bool touches = contacts.has(arrival.ray.start) || contacts.has(point.on);
  return { inFloats(from), inFloats(to),
    isStopped && hit ? frame_.triangles.numberOf(hit.id) : SceneTriangles::kNone,
    static_cast<std::uint32_t>(0x1p24 * part),
    way.meetsMovers || contacts.hasDynamic(arrival.ray.start) || contacts.hasDynamic(point.on) ||
      contacts.hasDynamic(hit.id) || (touches && isStopped && hit.id.isDynamic()) };
}

/// The point touches the lights: rays have length 0, so they are given the directions of the
/// lights' normals.
void PointDirectLight::addTouching(const LitPoint& point,
  const std::vector<std::uint32_t>& touching, std::size_t replicates,
  std::vector<Arrival>& arrivals) const
{
  for (const std::uint32_t light : touching)
  {
    const Triangle& surface = *lights()[light].surface();
    const Vector3 weights = weightsInPlane(surface, point.position);
    const SurfacePoint start = surfacePoint(surface, weights.cwiseMax(0));
    const bool isOn = weights.minCoeff() >= 0 && point.normal.dot(start.normal) < 0;
    for (std::size_t replicate = 0; isOn && replicate < replicates; ++replicate)
    {
      arrivals.push_back({ { start.clearPosition(), start.normal, lights()[light].triangle() },
        light, 1 / (surface.area() * static_cast<double>(replicates)), replicate });
    }
  }
}

void PointDirectLight::addSamples(const LitPoint& point, SeenLight::By by, const Part& part,
  std::uint64_t number, std::uint32_t share, const std::vector<std::uint32_t>& touching,
  std::size_t replicates, std::vector<Arrival>& arrivals) const
{
  const PointLampChoice choice(*lamps_, point, by, samples_, mostWeights_);
  const SampleKeys keys(splitMix(seed_ ^ splitMix(number)));
  for (std::uint32_t i = 0; i < samples_ && !choice.isEmpty(); ++i)
  {
    const std::array<double, 2> u = SobolPoint::inUnitSquare(share * samples_ + i, keys);
    const PointLampChoice::Choice chosen = choice.choose(u[0]);
    if (!chosen.seen || std::find(touching.begin(), touching.end(), chosen.light) != touching.end())
    {
      continue;
    }
    const double samples = chosen.probability * samples_;
    const SeenLight::Sample seen = chosen.seen->sample({ chosen.rest, u[1] }, point);
    const double perWatt =
      seen.isLit() ? seen.perWatt(part(seen.along, samples / seen.solidAngle)) / samples : 0;
    if (perWatt > 0)
    {
      arrivals.push_back({ seen.ray, chosen.light, perWatt, i * replicates / samples_ });
    }
  }
}

}
