#include "Emitter.h"

#include "DirectionSampling.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace irradiance
{

bool operator==(const Emitter& a, const Emitter& b)
{
  return a.id == b.id && a.triangle == b.triangle && a.flux == b.flux;
}

bool operator==(const EmitterTable& a, const EmitterTable& b)
{
  return a.numberOfWalks_ == b.numberOfWalks_ && a.emitters_ == b.emitters_;
}

EmitterTable::EmitterTable(const SceneObjects& objects, std::uint64_t numberOfWalks)
  : numberOfWalks_(numberOfWalks)
{
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    addTriangles(objects, object);
    addPoints(objects[object]);
  }
  if (!emitters_.empty())
  {
    int exponent;
    std::frexp(cumulative_.back(), &exponent);
    const int smallest = std::numeric_limits<double>::min_exponent; // below lie subnormals, then 0
    quantum_ = std::ldexp(1.0, std::max(exponent - 46, smallest));
    totalQuanta_ = static_cast<std::uint64_t>(std::llround(cumulative_.back() / quantum_));
  }
  if (totalQuanta_ == 0)
  {
    emitters_.clear(); // too weak for a double
  }
}

void EmitterTable::addTriangles(const SceneObjects& objects, std::uint32_t object)
{
  const Surface& surface = *objects[object].surface;
  const TriangleMesh& mesh = objects[object].body->mesh();
  for (std::uint32_t i = 0; i < mesh.size() && !surface.exitance.empty(); ++i)
  {
    Emitter emitter{ { object, i }, transformed(objects[object].worldFromObject, mesh[i]) };
    const double area = 0.5 * emitter.triangle.areaVector().norm();
    for (int band = 0; band < surface.bands; ++band)
    {
      emitter.flux[static_cast<std::size_t>(band)] = area *
        surface.exitance[surface.cellOfTriangle[i] * static_cast<std::size_t>(surface.bands) +
          static_cast<std::size_t>(band)];
    }
    add(emitter);
  }
}

void EmitterTable::addPoints(const SceneObject& object)
{
  for (const PointLight& light : object.surface->pointLights)
  {
    const Vector3 position = object.worldFromObject(light.position);
    Emitter emitter{ {}, { position, position, position } };
    std::copy(light.flux.begin(), light.flux.end(), emitter.flux.begin());
    add(emitter);
    pointBounds_.add(position);
  }
}

void EmitterTable::add(const Emitter& emitter)
{
  if (emitter.totalFlux() > 0)
  {
    cumulative_.push_back((cumulative_.empty() ? 0.0 : cumulative_.back()) + emitter.totalFlux());
    emitters_.push_back(emitter);
  }
}

Power EmitterTable::powerOf(std::uint32_t walk, const Emitter& emitter) const
{
  // floor(walks * total / number), with the whole part taken out so that nothing overflows.
  const std::uint64_t whole = totalQuanta_ / numberOfWalks_, rest = totalQuanta_ % numberOfWalks_;
  const auto upTo = [&](std::uint64_t walks) {
    return static_cast<std::int64_t>(walks * whole + walks * rest / numberOfWalks_);
  };
  const auto total = static_cast<double>(upTo(std::uint64_t{ walk } + 1) - upTo(walk));
  Power power;
  for (int band = 0; band < Power::kMaxBands; ++band)
  {
    const double share = emitter.flux[static_cast<std::size_t>(band)] / emitter.totalFlux();
    power[band] = nearestQuanta(total * share);
  }
  return power;
}

std::array<double, Power::kMaxBands> EmitterTable::largestStart() const
{
  std::array<double, Power::kMaxBands> largest{};
  const double walk =
    std::ceil(static_cast<double>(totalQuanta_) / static_cast<double>(numberOfWalks_));
  for (const Emitter& emitter : emitters_)
  {
    for (std::size_t band = 0; band < largest.size(); ++band)
    {
      largest[band] = std::max(largest[band], walk * (emitter.flux[band] / emitter.totalFlux()));
    }
  }
  return largest;
}

WalkStart EmitterTable::start(std::uint32_t walk, const SobolSequence& samples) const
{
  const double chosen = samples.sample(walk, 0, SampleUse::Emitter)[0] * cumulative_.back();
  const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, chosen);
  const Emitter& emitter = emitters_[static_cast<std::size_t>(found - cumulative_.begin())];

  const auto direction = samples.sample(walk, 0, SampleUse::Direction);
  const Power power = powerOf(walk, emitter);
  if (emitter.isPoint())
  {
    return { { emitter.triangle.a, sampleSphere(direction), emitter.id }, power };
  }
  const SurfacePoint point =
    surfacePoint(emitter.triangle, sampleTriangle(samples.sample(walk, 0, SampleUse::Position)));
  return { { point.clearPosition(), sampleCosineHemisphere(point.normal, direction), emitter.id },
    power };
}

}
