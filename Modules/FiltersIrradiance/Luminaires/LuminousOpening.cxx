// SPDX-License-Identifier: BSD-3-Clause
#include "Luminaires/LuminousOpening.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace irradiance
{

namespace
{

using Shape = LuminousOpening::Shape;

constexpr double kThin = 0.001; // m, between the faces of a flat opening

/// From the first angle to the last one next to which there is light.
std::array<double, 2> litRange(const std::vector<double>& angles, const std::vector<bool>& isLit)
{
  const auto first = std::find(isLit.begin(), isLit.end(), true) - isLit.begin();
  const auto after = isLit.rend() - std::find(isLit.rbegin(), isLit.rend(), true);
  return { *(angles.begin() + std::max<std::ptrdiff_t>(first - 1, 0)),
    *(angles.begin() +
      std::min<std::ptrdiff_t>(after, static_cast<std::ptrdiff_t>(angles.size()) - 1)) };
}

/// Directions in which the table has light: a net over all of them, edges included.
std::vector<Vector3> litDirections(const IntensityTable& table)
{
  const std::size_t rows = table.polar.size(), planes = table.azimuth.size();
  std::vector<bool> litRows(rows), litPlanes(planes);
  for (std::size_t i = 0; i < table.values.size(); ++i)
  {
    litRows[i % rows] = litRows[i % rows] || table.values[i] > 0;
    litPlanes[i / rows] = litPlanes[i / rows] || table.values[i] > 0;
  }
  const auto [fromPolar, toPolar] = litRange(table.polar, litRows);
  auto [fromAzimuth, toAzimuth] = litRange(table.azimuth, litPlanes);
  toAzimuth = planes == 1 ? fromAzimuth + 360 : toAzimuth;
  std::vector<Vector3> directions;
  constexpr int kRows = 16, kPlanes = 32;
  for (int row = 0; row <= kRows; ++row)
  {
    const double polar = fromPolar + (toPolar - fromPolar) * row / kRows;
    for (int plane = 0; plane <= kPlanes; ++plane)
    {
      const double azimuth = fromAzimuth + (toAzimuth - fromAzimuth) * plane / kPlanes;
      directions.push_back(table.direction(polar, azimuth));
    }
  }
  return directions;
}

/// A regular polygon in the plane across the axis, counter-clockwise, as large as the ellipse.
Facet ellipseRing(int axis, const Vector3& size, int corners)
{
  const double step = 2 * kPi / corners, radius = std::sqrt(step / std::sin(step)) / 2;
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  Facet ring(static_cast<std::size_t>(corners), Vector3::Zero());
  for (int i = 0; i < corners; ++i)
  {
    ring[static_cast<std::size_t>(i)][u] = radius * size[u] * std::cos((i + 0.5) * step);
    ring[static_cast<std::size_t>(i)][v] = radius * size[v] * std::sin((i + 0.5) * step);
  }
  return ring;
}

Facet rectangleRing(const Vector3& size)
{
  const double x = std::max(size[0], kThin) / 2, y = std::max(size[1], kThin) / 2;
  return { { -x, -y, 0 }, { x, -y, 0 }, { x, y, 0 }, { -x, y, 0 } };
}

/// First the face towards the axis, then the one on the other side, then the others.
std::vector<Facet> prismFacets(const Facet& ring, int axis, double height)
{
  const Vector3 up = Vector3::Unit(axis) * (height > 0 ? height : kThin) / 2;
  Facet upper, lower;
  for (const Vector3& corner : ring)
  {
    upper.push_back(corner + up);
    lower.push_back(corner - up);
  }
  std::vector<Facet> facets{ upper, { lower.rbegin(), lower.rend() } };
  for (std::size_t i = 0; height > 0 && i < ring.size(); ++i)
  {
    const std::size_t next = (i + 1) % ring.size();
    facets.push_back({ lower[i], lower[next], upper[next], upper[i] });
  }
  return facets;
}

/// A globe of 96 triangles and trapezoids. It is as large as the sphere, so in the mean over all
/// directions it looks as large.
std::vector<Facet> ellipsoidFacets(const Vector3& size)
{
  constexpr int kMeridians = 12, kBelts = 8;
  const auto corner = [](int belt, int meridian) {
    const double v = kPi * belt / kBelts, u = 2 * kPi * (meridian % kMeridians) / kMeridians;
    const double across = belt % kBelts ? std::sin(v) : 0;
    return Vector3(across * std::cos(u), across * std::sin(u), std::cos(v));
  };
  std::vector<Facet> facets;
  double area = 0;
  for (int i = 0; i < kMeridians * kBelts; ++i)
  {
    const int belt = i / kMeridians, meridian = i % kMeridians;
    Facet facet{ corner(belt, meridian), corner(belt + 1, meridian) };
    if (belt < kBelts - 1)
    {
      facet.push_back(corner(belt + 1, meridian + 1));
    }
    if (belt > 0)
    {
      facet.push_back(corner(belt, meridian + 1));
    }
    for (std::size_t k = 2; k < facet.size(); ++k)
    {
      area += (facet[k - 1] - facet[0]).cross(facet[k] - facet[0]).norm() / 2;
    }
    facets.push_back(facet);
  }
  const Vector3 scale = size * std::sqrt(4 * kPi / area) / 2;
  for (Facet& facet : facets)
  {
    for (Vector3& point : facet)
    {
      point = point.cwiseProduct(scale);
    }
  }
  return facets;
}

std::vector<Facet> facetsOf(const LuminousOpening& opening)
{
  if (opening.shape == Shape::Point || opening.shape == Shape::Ellipsoid)
  {
    return opening.shape == Shape::Point ? std::vector<Facet>{} : ellipsoidFacets(opening.size);
  }
  const double height = opening.size[opening.axis];
  return prismFacets(opening.shape == Shape::Box
      ? rectangleRing(opening.size)
      : ellipseRing(opening.axis, opening.size, height > 0 ? 16 : 32),
    opening.axis, height);
}

}

std::string LuminousOpening::name() const
{
  const bool isFlat = size[axis] == 0, isRound = size[(axis + 1) % 3] == size[(axis + 2) % 3];
  if (shape != Shape::Cylinder)
  {
    return shape == Shape::Point      ? "point"
      : shape == Shape::Box           ? (isFlat ? "rectangle" : "box")
      : isRound && size[0] == size[2] ? "sphere"
                                      : "ellipsoid";
  }
  if (isFlat)
  {
    return std::string(axis == 2 ? "" : "vertical ") + (isRound ? "disc" : "ellipse");
  }
  const std::string cylinder = isRound ? "cylinder" : "elliptical cylinder";
  return axis == 2 ? "vertical " + cylinder
                   : "horizontal " + cylinder + (axis == 0 ? " along the length" : " across");
}

std::optional<LuminousOpening> iesOpening(int year, double width, double length, double height)
{
  const auto sign = [](double value) { return value > 0 ? '+' : value < 0 ? '-' : '0'; };
  const std::string signs{ sign(width), sign(length), sign(height) };
  LuminousOpening opening{ Shape::Cylinder, 2,
    { std::abs(length), std::abs(width), std::abs(height) } };
  const bool isOld = year < 2002;
  const bool isOldEllipsoid = signs == "-0-" || signs == "-+-" || signs == "+--";
  if (signs.find('-') == std::string::npos)
  {
    opening.shape = signs == "000" ? Shape::Point : Shape::Box;
    return opening;
  }
  if (signs == "---" || (isOld && isOldEllipsoid) || (year < 1995 && signs == "-++"))
  {
    opening.shape = Shape::Ellipsoid;
  }
  else if (height < 0)
  {
    if (signs != "-0-" && signs != "0+-" && signs != "-+-" && signs != "+0-" && signs != "+--")
    {
      return std::nullopt;
    }
    opening.axis = signs[0] == '+' ? 1 : 0;
  }
  // Of what is round one diameter may be given for two.
  const int u = (opening.axis + 1) % 3, v = (opening.axis + 2) % 3;
  opening.size[u] = opening.size[u] > 0 ? opening.size[u] : opening.size[v];
  opening.size[v] = opening.size[v] > 0 ? opening.size[v] : opening.size[u];
  return opening;
}

std::vector<Facet> litFacets(const LuminousOpening& opening, const IntensityTable& table)
{
  const std::vector<Vector3> directions = litDirections(table);
  std::vector<Facet> facets = facetsOf(opening);
  const auto isDark = [&](const Facet& facet) {
    const Vector3 normal = (facet[1] - facet[0]).cross(facet[2] - facet[0]).normalized();
    return std::none_of(directions.begin(), directions.end(),
      [&](const Vector3& direction) { return normal.dot(direction) > 1e-9; });
  };
  facets.erase(std::remove_if(facets.begin(), facets.end(), isDark), facets.end());
  if (facets.size() == 1 && opening.size[opening.axis] == 0)
  {
    for (Vector3& point : facets[0])
    {
      point[opening.axis] = 0;
    }
  }
  return facets;
}

}
