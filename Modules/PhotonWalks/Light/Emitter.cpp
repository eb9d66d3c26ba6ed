// SPDX-License-Identifier: BSD-3-Clause
#include "Light/Emitter.h"

#include "Sampling/DirectionSampling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace irradiance
{

namespace
{

/// Mirrors a direction at walls until it points to the open side of all; false if it never does.
bool mirrorInto(const std::vector<Vector3>& openSides, Vector3& direction)
{
  constexpr int kMostMirrors = 256; // walls at an acute angle take several
  for (int i = 0; i < kMostMirrors; ++i)
  {
    const auto wall = std::find_if(openSides.begin(), openSides.end(),
      [&](const Vector3& side) { return side.dot(direction) < 0; });
    if (wall == openSides.end())
    {
      return true;
    }
    direction -= 2 * wall->dot(direction) * *wall;
  }
  return false;
}

void checkOpen(const Vector3& position, const std::vector<Vector3>& openSides)
{
  Vector3 direction(0.48, 0.6, 0.64);
  if (!mirrorInto(openSides, direction))
  {
    std::ostringstream text;
    text << "the point light at (" << position.transpose()
         << ") lies in the planes of walls that leave it no side to shine into";
    throw std::runtime_error(text.str());
  }
}

}

bool operator==(const Emitter& a, const Emitter& b)
{
  return a.id == b.id && a.triangle == b.triangle && a.flux == b.flux;
}

bool operator==(const EmitterTable& a, const EmitterTable& b)
{
  return a.photon_ == b.photon_ && a.emitters_ == b.emitters_ && a.openSides_ == b.openSides_;
}

EmitterTable::EmitterTable(const SceneObjects& objects, std::uint64_t numberOfWalks,
  Contacts* contacts, const Checkpoint& checkpoint)
{
  constexpr std::uint64_t kMostQuanta = std::uint64_t{ 1 } << 46;
  while (2 * static_cast<std::uint64_t>(photon_) * numberOfWalks <= kMostQuanta)
  {
    photon_ *= 2;
  }
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    if (objects[object].isPresent)
    {
      addTriangles(objects, object);
      addPoints(objects, object, contacts, checkpoint);
    }
  }
  if (flux() < std::numeric_limits<double>::min())
  {
    emitters_.clear(); // too weak for a double
  }
  for (const Emitter& emitter : emitters_)
  {
    powers_.push_back(powerOf(emitter));
  }
}

void EmitterTable::addTriangles(const SceneObjects& objects, std::uint32_t object)
{
  const Material& material = *objects[object].material;
  const TriangleMesh& mesh = objects[object].body->mesh();
  for (std::uint32_t i = 0; i < mesh.size() && !material.exitance.empty(); ++i)
  {
    Emitter emitter{ { object, i }, transformed(objects[object].worldFromObject, mesh[i]) };
    emitter.cell = { object, material.cellOfTriangle[i] };
    const double area = emitter.triangle.area();
    for (int band = 0; band < material.bands; ++band)
    {
      emitter.flux[static_cast<std::size_t>(band)] = area *
        material.exitance[material.cellOfTriangle[i] * static_cast<std::size_t>(material.bands) +
          static_cast<std::size_t>(band)];
    }
    add(emitter);
  }
}

void EmitterTable::addPoints(const SceneObjects& objects, std::uint32_t number, Contacts* contacts,
  const Checkpoint& checkpoint)
{
  const SceneObject& object = objects[number];
  for (const PointLight& light : object.material->pointLights)
  {
    Vector3 position = object.worldFromObject(light.position);
    std::vector<Vector3> openSides;
    if (contacts)
    {
      for (const Contacts::Wall& wall : contacts->wallsAt(objects, position, checkpoint))
      {
        position += std::max(0.0, wall.clearance - wall.distance) * wall.normal;
        openSides.push_back(wall.normal);
      }
      checkOpen(position, openSides);
    }
    Emitter emitter{ {}, { position, position, position } };
    std::copy(light.flux.begin(), light.flux.end(), emitter.flux.begin());
    emitter.cell = { number, light.cell };
    if (emitter.totalFlux() > 0 && !openSides.empty())
    {
      openSides_[emitters_.size()] = openSides;
    }
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

Power EmitterTable::powerOf(const Emitter& emitter) const
{
  Power power;
  for (int band = 0; band < Power::kMaxBands; ++band)
  {
    const double share = emitter.flux[static_cast<std::size_t>(band)] / emitter.totalFlux();
    power[band] = nearestQuanta(static_cast<double>(photon_) * share);
  }
  return power;
}

std::array<double, Power::kMaxBands> EmitterTable::largestStart() const
{
  std::array<double, Power::kMaxBands> largest{};
  for (const Power& power : powers_)
  {
    for (std::size_t band = 0; band < largest.size(); ++band)
    {
      largest[band] = std::max(largest[band], static_cast<double>(power.quanta[band]));
    }
  }
  return largest;
}

std::size_t EmitterTable::choose(double sample) const
{
  const double flux = sample * cumulative_.back();
  // By bisection without branches, as which half it is cannot be predicted. The last one is chosen
  // if no other is.
  std::size_t first = 0;
  for (std::size_t count = cumulative_.size(); count > 1;)
  {
    const std::size_t half = count / 2;
    first += static_cast<std::size_t>(cumulative_[first + half - 1] <= flux) * half;
    count -= half;
  }
  return first;
}

Ray EmitterTable::pointRay(std::size_t emitter, const std::array<double, 2>& u) const
{
  Vector3 shining = sampleSphere(u);
  if (const auto sides = openSides_.find(emitter); sides != openSides_.end())
  {
    mirrorInto(sides->second, shining);
  }
  return { emitters_[emitter].triangle.a, shining, emitters_[emitter].id };
}

}
