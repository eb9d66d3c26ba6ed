// SPDX-License-Identifier: BSD-3-Clause
#include "DirectLight/LampPieces.h"

#include "Lights/LitPoint.h"

#include <algorithm>
#include <utility>

namespace irradiance
{

namespace
{

/// Edges are not cut that are shorter than this part of the diagonal of all lamps: what is near the
/// one end is near the other.
constexpr double kShort = 0.02;

}

LampPieces::LampPieces(LightTable lights)
  : lights_(std::move(lights))
{
  Box bounds;
  for (const Light& light : lights_.lights())
  {
    bounds.add(light.bounds());
  }
  const double shortest = kShort * bounds.extent().norm();
  for (std::uint32_t i = 0; i < lights_.lights().size(); ++i)
  {
    addPieces(lights_[i], i, shortest, pieces_);
    if (lights_[i].surface())
    {
      areas_.push_back(i);
    }
  }
  tree_ = LampTree(pieces_);
  for (const LampPiece& piece : pieces_)
  {
    centers_.add(piece.center);
  }
}

std::optional<std::uint32_t> LampPieces::lightOn(const TriangleId& triangle) const
{
  const auto key = [](const TriangleId& id) { return std::pair(id.object, id.triangle); };
  const auto found = std::lower_bound(
    areas_.begin(), areas_.end(), triangle, [&](std::uint32_t light, const TriangleId& id) {
      return key(lights_[light].triangle()) < key(id);
    });
  return found != areas_.end() && lights_[*found].triangle() == triangle
    ? std::optional<std::uint32_t>(*found)
    : std::nullopt;
}

std::vector<std::uint32_t> LampPieces::lightsAt(
  const Contacts& contacts, const TriangleId& triangle) const
{
  std::vector<std::uint32_t> lights;
  contacts.forEachLampAt(triangle, [&](const TriangleId& id) {
    if (const std::optional<std::uint32_t> light = lightOn(id))
    {
      lights.push_back(*light);
    }
  });
  return lights;
}

/// Rounding may leave the place beside all of them: then the nearest, roughly.
std::uint32_t LampPieces::pieceAt(std::uint32_t light, const Vector3& place) const
{
  const auto first = std::lower_bound(pieces_.begin(), pieces_.end(), light,
    [](const LampPiece& piece, std::uint32_t value) { return piece.light < value; });
  const auto end = std::upper_bound(first, pieces_.end(), light,
    [](std::uint32_t value, const LampPiece& piece) { return value < piece.light; });
  const auto inside = [&](const LampPiece& piece) {
    return weightsInPlane(piece.triangle, place).minCoeff();
  };
  const auto found = std::max_element(
    first, end, [&](const LampPiece& a, const LampPiece& b) { return inside(a) < inside(b); });
  return static_cast<std::uint32_t>(found - pieces_.begin());
}

}
