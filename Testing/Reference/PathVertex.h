// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Ray.h"
#include "Geometry/Vector.h"
#include "Meshes/SurfacePoint.h"
#include "Surfaces/PhongLobe.h"

#include <Eigen/Core>

#include <optional>

namespace pathtracedroom
{

using irradiance::TriangleId;
using irradiance::Vector3;

/// One value for each band; bands that a scene does not have are 0.
using Spectrum = Eigen::Array3d;

/**
 * A point of a path. At one end of a path is a lamp, at the other the sensor (a camera or a cell),
 * and between them are points of surfaces. Each passes on what arrives: light from lamp to sensor,
 * importance from sensor to lamp. As surfaces reflect both alike, one code does for both.
 */
struct PathVertex
{
  /// Over which directions the diffuse part spreads.
  enum class Shape
  {
    Cosine, ///< Lambert: surfaces, area lamps, cells
    Sphere, ///< evenly: point lights
    Pixel   ///< evenly over the image plane: the pinhole of a camera; `normal` is where it looks
  };

  Shape shape = Shape::Cosine;
  TriangleId id; ///< none for points off all surfaces: point lights and pinholes
  Vector3 position = Vector3::Zero();
  Vector3 clearPosition = Vector3::Zero(); ///< where rays start
  Vector3 normal = Vector3::Zero();        ///< unit vector to the side where the path is
  Spectrum exitance = Spectrum::Zero();    ///< W/m2, emitted on the side of the normal

  /// Of a surface the reflectance. Of an end what it emits, as if that were reflected: of an area
  /// lamp the exitance, of a point light the flux.
  Spectrum diffuse = Spectrum::Zero();
  /// The probability that a subpath continues this way. Of a pinhole it is a density: 1 over the
  /// area of a pixel at the distance 1.
  double diffuseChance = 0;
  // The same for specular reflection. Ends have none.
  Spectrum specular = Spectrum::Zero();
  double specularChance = 0;
  const irradiance::PhongLobe* lobe = nullptr; ///< null: no specular reflection

  // What a subpath has found out up to here.
  Vector3 toPrevious = Vector3::Zero();   ///< unit vector to the vertex before
  Spectrum throughput = Spectrum::Ones(); ///< what arrives here over the density of the subpath
  /// With which the subpath chose this point: m^-2, times the probability to get as far as the
  /// vertex before. 1 for the points off surfaces.
  double density = 1;
  /// With which a subpath from the other end would have come here through the two vertices behind.
  double reverseDensity = 0;
  /// The subpath was mirrored here. Then no connection finds its path: the next vertex follows from
  /// the one before.
  bool isMirrored = false;

  bool isPoint() const { return id == TriangleId{}; }

  /// The part of what arrives from the direction `from` that leaves in the direction `to`, per
  /// steradian, times the cosine of `to`; without what a mirror reflects. Both are unit vectors
  /// away from the surface.
  Spectrum passedOn(const Vector3& from, const Vector3& to) const;
  /// The density per steradian with which a subpath that came from `from` continues to `to`, unless
  /// it is mirrored.
  double directionDensity(const Vector3& from, const Vector3& to) const;

private:
  double spread(const Vector3& to) const;
  /// The specular BRDF times the cosine of `to`, for a reflectance of 1.
  double gloss(const Vector3& from, const Vector3& to) const;
};

/// A vertex on a surface that passes nothing on yet.
PathVertex surfaceVertex(const TriangleId& id, const irradiance::SurfacePoint& point);

/// The density, m^-2, with which a subpath that leaves `vertex` chooses the point `next`, if it has
/// `directionDensity` in that direction. 0 if the point lies off all surfaces, where no ray ends.
double areaDensity(double directionDensity, const PathVertex& vertex, const PathVertex& next);

/// The same for a subpath that comes to `vertex` from `from` and continues to the vertex before it.
inline double densityBack(const PathVertex& vertex, const Vector3& from, const PathVertex& before)
{
  return areaDensity(vertex.directionDensity(from, vertex.toPrevious), vertex, before);
}

/// The first vertex of a subpath and the unit direction in which the subpath leaves it. Without a
/// direction it is reflected as everywhere on its way.
struct Departure
{
  PathVertex vertex;
  std::optional<Vector3> direction;
};

}
