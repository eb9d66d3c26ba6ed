// SPDX-License-Identifier: BSD-3-Clause
#ifndef PlainScene_h
#define PlainScene_h

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
  std::size_t numberOfCells = 0;
  float extent = 0; ///< m, the longest edge of the bounding box
};

/// Throws std::invalid_argument for what a plain tracer does not know: colours.
PlainScene makePlainScene(const irradiance::SceneObjects& objects);

#endif
