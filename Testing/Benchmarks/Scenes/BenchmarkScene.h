// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Surfaces/SceneObjects.h"

#include <optional>
#include <string>

/// A square that sends light down.
struct AreaLight
{
  irradiance::Vector3 center; ///< m
  double edge;                ///< m
};

/// What rays are cast at: a static and a dynamic part. Lengths in m, z up.
struct BenchmarkScene
{
  std::string name;
  irradiance::SceneObjects objects; ///< geometry and poses alone: no surfaces
  AreaLight light;
  std::size_t numberOfWallTriangles = 0; ///< the first ones of the static mesh
};

/// A room of 10 m, 19,200 wall triangles, with a bunny (3,674) that stands and a teapot (992) that
/// moves; or, `isLarge`, empty but for a dragon of 871,414 triangles that moves. Nothing when their
/// meshes are not there.
std::optional<BenchmarkScene> makeRoomScene(bool isLarge);

/// Its large scene with materials: a lamp lights the room from its place there, each quad of the
/// walls and each triangle of the dragon is a cell.
std::optional<irradiance::SceneObjects> makeDragonRoom();

/// 100,000 triangles at random with edges of 0.03 of the cube that they fill, one half static, the
/// other half one dynamic object. `isFlattened`: each dynamic triangle is on its own.
BenchmarkScene makeRandomScene(bool isFlattened = false);

/// Three teapots that stand on a floor and three that hang between them, each of 102,080 triangles;
/// those that hang are dynamic, and each of their triangles is on its own.
BenchmarkScene makeTeapotsScene();

/// Of all objects.
std::vector<irradiance::Triangle> worldTriangles(const irradiance::SceneObjects& objects);

/// The same triangles, all static.
irradiance::SceneObjects flattened(const irradiance::SceneObjects& objects);
