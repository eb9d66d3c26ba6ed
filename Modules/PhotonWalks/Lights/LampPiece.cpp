// SPDX-License-Identifier: BSD-3-Clause
#include "Lights/LampPiece.h"

namespace irradiance
{

namespace
{

/// Squared longest edge / area up to which a triangle is not cut; that of half a square is 4.
constexpr double kLong = 12;
constexpr int kMostCuts = 8; ///< of a triangle, and of what they leave of it

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
  for (const Vector3& corner : { triangle.a, triangle.b, triangle.c })
  {
    piece.radius = std::max(piece.radius, (corner - piece.center).norm());
  }
  return piece;
}

void cut(const LampPiece& piece, int times, double shortest, std::vector<LampPiece>& pieces)
{
  const Triangle turned = turnedToLongest(piece.triangle);
  const double squared = (turned.b - turned.a).squaredNorm();
  if (times == kMostCuts || squared <= std::max(kLong * turned.area(), shortest * shortest))
  {
    pieces.push_back(measured(piece));
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
    cut(half, times + 1, shortest, pieces);
  }
}

/// Their places only tell their directions and how far these spread.
void addParts(const Light& light, const DistantLight& distant, std::uint32_t number,
  std::vector<LampPiece>& pieces)
{
  constexpr double kFar = 0x1p10; // diagonals of the box
  const Box& lit = distant.bounds();
  for (const DistantLight::Part& part : distant.parts())
  {
    const double distance = kFar * lit.extent().norm();
    const Vector3 center = lit.center() + distance * part.middle;
    LampPiece piece{ number, 1, part.flux * light.totalFlux(), { center, center, center }, center,
      -part.middle, std::min(1.0, part.radius) * distance, { 1, 0 } };
    piece.part = &part;
    piece.crossSection = distant.crossSection(part.middle);
    pieces.push_back(piece);
  }
}

}

void addPieces(
  const Light& light, std::uint32_t number, double shortest, std::vector<LampPiece>& pieces)
{
  if (const DistantLight* const distant = light.distant())
  {
    addParts(light, *distant, number, pieces);
    return;
  }
  const Vector3 center = light.bounds().center();
  LampPiece piece{ number, 1, light.totalFlux(), { center, center, center }, center };
  piece.distribution = light.distribution();
  if (const Triangle* const surface = light.surface())
  {
    piece.triangle = *surface;
    piece.normal = surface->areaVector().normalized();
    piece.cone = { 1, 0 };
    piece.face = light.area()->face;
    cut(piece, 0, shortest, pieces);
  }
  else
  {
    pieces.push_back(piece);
  }
}

}
