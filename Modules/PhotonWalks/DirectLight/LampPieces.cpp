// SPDX-License-Identifier: BSD-3-Clause
#include "DirectLight/LampPieces.h"

#include "DirectLight/LitPoint.h"

#include <algorithm>
#include <utility>

namespace irradiance
{

namespace
{

/// Squared longest edge / area up to which a triangle is not cut; that of half a square is 4.
constexpr double kLong = 12;
constexpr int kMostCuts = 8; ///< of a triangle, and of what they leave of it
/// Edges are not cut that are shorter than this part of the diagonal of all lamps: what is near the
/// one end is near the other.
constexpr double kShort = 0.02;

/// The corners from the end of the longest edge on.
Triangle turnedToLongest(const Triangle& t)
{
  const double ab = (t.b - t.a).squaredNorm(), bc = (t.c - t.b).squaredNorm(),
               ca = (t.a - t.c).squaredNorm();
  return ab >= bc && ab >= ca ? t
    : bc >= ca                ? Triangle{ t.b, t.c, t.a }
                              : Triangle{ t.c, t.a, t.b };
}

/// The sizes of a piece from its triangle.
LampPiece measured(LampPiece piece)
{
  const Triangle& triangle = piece.triangle;
  piece.center = (triangle.a + triangle.b + triangle.c) / 3;
  piece.radius = 0;
  for (const Vector3& corner : { triangle.a, triangle.b, triangle.c })
  {
    piece.radius = std::max(piece.radius, (corner - piece.center).norm());
  }
  return piece;
}

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
    const Light& light = lights_[i];
    LampPiece piece{ i, 1, light.totalFlux(), {}, light.bounds().center() };
    if (const auto* const area = std::get_if<AreaLight>(&light.kind))
    {
      piece.triangle = area->triangle;
      piece.normal = area->triangle.areaVector().normalized();
      areas_.push_back(i);
      cut(piece, 0, shortest);
    }
    else
    {
      pieces_.push_back(piece);
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

void LampPieces::cut(const LampPiece& piece, int times, double shortest)
{
  const Triangle turned = turnedToLongest(piece.triangle);
  const double squared = (turned.b - turned.a).squaredNorm();
  if (times == kMostCuts || squared <= std::max(kLong * turned.area(), shortest * shortest))
  {
    pieces_.push_back(measured(piece));
    return;
  }
  const Vector3 middle = 0.5 * (turned.a + turned.b);
  LampPiece half = piece;
  half.share /= 2;
  half.flux /= 2;
  for (const Triangle& triangle :
    { Triangle{ turned.a, middle, turned.c }, Triangle{ middle, turned.b, turned.c } })
  {
    half.triangle = triangle;
    cut(half, times + 1, shortest);
  }
}

}
