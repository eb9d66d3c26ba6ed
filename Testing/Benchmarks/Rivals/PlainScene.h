// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace irradiance
{
struct SceneObjects;
}

/**
 * A grey scene as one writes it down for a plain tracer: all triangles in the world, in floats.
 * Names nothing of Eigen or the engine, because the tracer is compiled for the machine at hand, and
 * inline functions that it shared with them would come out in two forms.
 */
struct PlainScene
{
  using Vector = std::array<float, 3>;

  struct Triangle
  {
    Vector a, b, c; ///< m
  };
  struct Surface
  {
    float reflectance;  ///< both sides
    std::uint32_t cell; ///< counted through all objects
  };
  /// A triangle that emits from its front.
  struct Light
  {
    std::uint32_t triangle; ///< which of all
    double flux;            ///< W
  };
  struct PointLight
  {
    Vector position; ///< m
    double flux;     ///< W
  };

  /// W
  double totalFlux() const
  {
    double sum = 0;
    for (const Light& light : lights)
    {
      sum += light.flux;
    }
    for (const PointLight& light : pointLights)
    {
      sum += light.flux;
    }
    return sum;
  }
  /// m, from a surface to the origin of a ray that leaves it, to not hit it again
  float offset() const { return 1e-5f * extent; }

  std::vector<Triangle> triangles;
  std::vector<Surface> surfaces; ///< of each triangle
  std::vector<Light> lights;
  std::vector<PointLight> pointLights;
  /// W/m2/sr from a direction of unit length, for the gatherer; null: none. Else there is no other
  /// light.
  float (*sky)(const Vector& direction) = nullptr;
  std::size_t numberOfCells = 0;
  float extent = 0; ///< m, the longest edge of the bounding box
};

/// Throws std::invalid_argument for what a plain tracer does not know: colours.
PlainScene makePlainScene(const irradiance::SceneObjects& objects);

/// A triangle to draw points from: origin + s u + t v for 0 <= t <= s <= 1.
struct PlainPatch
{
  PlainScene::Vector origin; ///< the first corner
  PlainScene::Vector u, v;   ///< from the first corner to the second, from there to the third
  PlainScene::Vector normal; ///< to the front, of unit length
};

/// `offset`: m, that the patch is to lie off the triangle, on its front.
PlainPatch makePatch(const PlainScene::Triangle& triangle, float offset);

/// m2
double areaOf(const PlainPatch& patch);

/// Where light starts, a little off the surface. A point light is a patch without extent or normal.
struct PlainSource : PlainPatch
{
  float density; ///< 1/m2, of points drawn by flux from all lights; 0 of a point light
};

/// In the order of the lights, then of the point lights.
std::vector<PlainSource> makeSources(const PlainScene& scene);

/// In the same order, W. Throws std::invalid_argument if there is no light.
std::vector<double> fluxesOf(const PlainScene& scene);
