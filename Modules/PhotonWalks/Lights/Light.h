// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Light_h
#define irradiance_Light_h

#include "Lights/AreaLight.h"
#include "Lights/PointLight.h"
#include "Surfaces/Power.h"
#include "Surfaces/SceneCell.h"

#include <array>
#include <variant>

namespace irradiance
{

/**
 * A light of a frame, in world space: what it emits, and a kind that knows its shape. A new kind is
 * one more type in the variant. It has bounds(); light leaves it from a triangle, or by a ray of
 * its own, leaving().
 */
struct Light
{
  std::array<double, Power::kMaxBands> flux{}; ///< W, by band
  SceneCell cell;                              ///< to which it belongs
  std::variant<AreaLight, PointLight> kind;

  double totalFlux() const { return flux[0] + flux[1] + flux[2]; }
  /// The triangle that it lies on; none for a light in the air.
  TriangleId triangle() const
  {
    const auto* const area = std::get_if<AreaLight>(&kind);
    return area ? area->id : TriangleId{};
  }
  Box bounds() const
  {
    return std::visit([](const auto& shape) { return shape.bounds(); }, kind);
  }
  /// The ray that leaves a light in the air in the direction that a point of the unit square
  /// chooses.
  Ray leaving(const std::array<double, 2>& u) const
  {
    return std::get<PointLight>(kind).leaving(u);
  }

  /// Whether walks leave both alike.
  friend bool operator==(const Light& a, const Light& b)
  {
    return a.flux == b.flux && a.kind == b.kind;
  }
};

}

#endif
