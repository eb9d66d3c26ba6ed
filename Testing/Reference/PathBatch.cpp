// SPDX-License-Identifier: BSD-3-Clause
#include "PathBatch.h"

#include "Surfaces.h"

#include <algorithm>
#include <cmath>

namespace pathtracedroom
{

using namespace irradiance;

namespace
{

PathPart partOf(const Subpath& subpath, std::size_t count)
{
  return { subpath.vertices().data(), static_cast<int>(count) };
}

/// The light subpath ends on a sensor, or the eye subpath on a lamp: nothing has to be connected.
/// `end` is the last vertex of `whole` as a subpath from there would begin.
struct EndHit
{
  PathPart part;
  Spectrum value;

  EndHit(const PathPart& whole, const PathVertex& end)
    : part(whole)
  {
    const PathVertex& last = whole.vertices[whole.count - 1];
    const PathVertex& before = whole.vertices[whole.count - 2];
    const Spectrum passedOn = end.passedOn(end.toPrevious, last.toPrevious);
    value =
      last.throughput * passedOn / end.normal.dot(last.toPrevious) * end.throughput * end.density;
    part.reverseLast = end.density;
    part.reverseBeforeLast =
      areaDensity(end.directionDensity(end.toPrevious, last.toPrevious), end, before);
  }
};

}

void PathBatch::trace(
  std::uint64_t pass, std::size_t first, std::size_t end, std::vector<Contribution>& contributions)
{
  begin(pass, first, end);
  extendAll();
  connections_.clear();
  rays_.clear();
  for (const Pair& pair : pairs_)
  {
    join(pair, contributions);
  }
  castConnections(contributions);
}

void PathBatch::begin(std::uint64_t pass, std::size_t first, std::size_t end)
{
  pairs_.resize(end - first);
  growing_.clear();
  for (std::size_t i = first; i < end; ++i)
  {
    Pair& pair = pairs_[i - first];
    pair.bin = i % tracing_.sensor.numberOfBins();
    Random eye(tracing_.seed, pass, 2 * i), light(tracing_.seed, pass, 2 * i + 1);
    const Departure fromSensor = tracing_.sensor.start(pair.bin, eye);
    pair.eye.begin(fromSensor, eye);
    const Departure fromLamp = tracing_.lamps.start(light);
    pair.light.begin(fromLamp, light);
    growing_.push_back(&pair.eye);
    growing_.push_back(&pair.light);
  }
}

void PathBatch::extendAll()
{
  const auto cannotLeave = [this](Subpath* subpath) {
    Ray ray;
    const bool leaves = subpath->leave(ray);
    if (leaves)
    {
      rays_.push_back(ray);
    }
    return !leaves;
  };
  while (!growing_.empty())
  {
    rays_.clear();
    growing_.erase(std::remove_if(growing_.begin(), growing_.end(), cannotLeave), growing_.end());
    hits_.resize(rays_.size());
    tracing_.scene.cast(rays_.data(), rays_.size(), hits_.data());
    std::size_t kept = 0;
    for (std::size_t i = 0; i < growing_.size(); ++i)
    {
      const Hit& hit = hits_[i];
      if (!hit)
      {
        continue;
      }
      SurfacePoint point = tracing_.scene.surfaceOf(hit, true);
      point.turn(rays_[i].direction.dot(point.normal) <= 0);
      if (growing_[i]->arrive(vertexOn(tracing_.objects, hit.id, point)))
      {
        growing_[kept++] = growing_[i];
      }
    }
    growing_.resize(kept);
  }
}

void PathBatch::join(const Pair& pair, std::vector<Contribution>& contributions)
{
  addLampHits(pair, contributions);
  addSensorHits(pair, contributions);
  const auto shared = static_cast<std::size_t>(tracing_.sensor.sharedEyeVertices());
  for (std::size_t t = shared + 1; t <= pair.eye.vertices().size(); ++t)
  {
    for (std::size_t s = 1; s <= pair.light.vertices().size(); ++s)
    {
      connect(pair.bin, partOf(pair.light, s), partOf(pair.eye, t));
    }
  }
}

/// Strategies (0, t).
void PathBatch::addLampHits(const Pair& pair, std::vector<Contribution>& contributions) const
{
  const std::vector<PathVertex>& eye = pair.eye.vertices();
  for (std::size_t t = 2; t <= eye.size(); ++t)
  {
    const auto count = static_cast<int>(t);
    if ((eye[t - 1].exitance > 0).any() && tracing_.strategies.samples(0, count) > 0)
    {
      const EndHit hit(partOf(pair.eye, t), tracing_.lamps.lampAt(eye[t - 1]));
      contributions.push_back(
        { pair.bin, hit.value * balanceWeight(tracing_.strategies, { nullptr, 0 }, hit.part) });
    }
  }
}

/// Strategies in which the light subpath finds the bin: (s, 0) or (s, 1).
void PathBatch::addSensorHits(const Pair& pair, std::vector<Contribution>& contributions)
{
  const std::vector<PathVertex>& light = pair.light.vertices();
  const bool isOnSensor = tracing_.sensor.sharedEyeVertices() == 0;
  for (std::size_t s = isOnSensor ? 2 : 1; s <= light.size(); ++s)
  {
    const std::optional<Sensor::Place> place = tracing_.sensor.placeOf(light[s - 1]);
    if (!place)
    {
      continue;
    }
    if (!isOnSensor)
    {
      connect(place->bin, partOf(pair.light, s), { &place->vertex, 1 });
    }
    else if (tracing_.strategies.samples(static_cast<int>(s), 0) > 0)
    {
      const EndHit hit(partOf(pair.light, s), place->vertex);
      const double weight = balanceWeight(tracing_.strategies, hit.part, { nullptr, 0 });
      contributions.push_back(
        { place->bin, hit.value * (weight / tracing_.strategies.numberOfBins) });
    }
  }
}

void PathBatch::connect(std::size_t bin, PathPart light, PathPart eye)
{
  const double samples = tracing_.strategies.samples(light.count, eye.count);
  const PathVertex& y = light.vertices[light.count - 1];
  const PathVertex& z = eye.vertices[eye.count - 1];
  const Vector3 edge = z.position - y.position;
  const double square = edge.squaredNorm();
  if (!(samples > 0 && square > 0) || (y.isPoint() && z.isPoint()))
  {
    return;
  }
  const Vector3 toEye = edge / std::sqrt(square), toLight = -toEye;
  const Spectrum value = y.throughput * y.passedOn(y.toPrevious, toEye) *
    z.passedOn(z.toPrevious, toLight) * z.throughput / (square * samples);
  if (!(value > 0).any())
  {
    return;
  }
  light.reverseLast = areaDensity(z.directionDensity(z.toPrevious, toLight), z, y);
  eye.reverseLast = areaDensity(y.directionDensity(y.toPrevious, toEye), y, z);
  light.reverseBeforeLast =
    light.count > 1 ? densityBack(y, toEye, light.vertices[light.count - 2]) : 0;
  eye.reverseBeforeLast = eye.count > 1 ? densityBack(z, toLight, eye.vertices[eye.count - 2]) : 0;
  // A ray can be aimed at a triangle alone, and starts anywhere.
  const PathVertex& from = z.isPoint() ? z : y;
  const PathVertex& to = z.isPoint() ? y : z;
  rays_.push_back({ from.clearPosition, to.position - from.clearPosition, from.id });
  connections_.push_back(
    { to.id, { bin, value * balanceWeight(tracing_.strategies, light, eye) } });
}

void PathBatch::castConnections(std::vector<Contribution>& contributions)
{
  hits_.resize(rays_.size());
  tracing_.scene.cast(rays_.data(), rays_.size(), hits_.data());
  for (std::size_t i = 0; i < connections_.size(); ++i)
  {
    if (hits_[i].id == connections_[i].target)
    {
      contributions.push_back(connections_[i].contribution);
    }
  }
}

}
