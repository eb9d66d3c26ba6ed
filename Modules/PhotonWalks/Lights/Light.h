// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Vector.h"
#include "Lights/DistantLight.h"
#include "Lights/IntensityDistribution.h"
#include "Lights/PointLight.h"
#include "Meshes/SurfacePoint.h"
#include "Sampling/DirectionSampling.h"
#include "Surfaces/Power.h"
#include "Surfaces/SceneCells.h"

#include <array>
#include <memory>
#include <utility>
#include <variant>

namespace irradiance
{

/// A triangle of a cell with exitance, in world space. Light leaves its front as it would after
/// diffuse reflection, or as a luminaire has it.
struct AreaLight
{
  TriangleId id;
  Triangle triangle;
  std::shared_ptr<const IntensityDistribution> ofLuminaire{}; ///< null: diffuse
  IntensityDistribution::Face face{};                         ///< of that, of which it is a part

  /// What the cosine to the normal is times, for the intensity of each W, 1/sr.
  static constexpr double kPerSteradian = 1 / kPi;
  /// m2 sr: the flux over this is the radiance, W/m2/sr, in all directions.
  static double etendue(const Triangle& triangle) { return kPi * triangle.area(); }

  Box bounds() const { return triangle.bounds(); }
  /// What the radiance in a direction is, over that of a diffuse light of the same flux.
  double relativeRadiance(const Vector3& direction) const
  {
    return ofLuminaire
      ? ofLuminaire->radiance(direction) * etendue(triangle) / face.shareOf(triangle.area())
      : 1;
  }
  Ray leaving(const std::array<double, 2>& place, const std::array<double, 2>& direction) const
  {
    const SurfacePoint start = surfacePoint(triangle, sampleTriangle(place));
    return { start.clearPosition(),
      ofLuminaire ? ofLuminaire->sample(direction, start.normal, face)
                  : sampleHemisphere(start.normal, direction),
      id };
  }

  friend bool operator==(const AreaLight& a, const AreaLight& b)
  {
    return a.id == b.id && a.triangle == b.triangle && isSame(a.ofLuminaire, b.ofLuminaire);
  }
};

/// A place from which a light shines: a point of its surface, or the light itself in the air.
struct LightPlace
{
  SurfacePoint point; ///< in the air only the position
  const PointLight* inAir = nullptr;
  const AreaLight* onSurface = nullptr;

  const Vector3& position() const { return point.position; }
  /// Where rays start.
  Vector3 origin() const { return inAir ? point.position : point.clearPosition(); }
  /// The intensity towards another place for each W that leaves here, over perSteradian(); negative
  /// behind a surface.
  double leaving(const Vector3& to) const
  {
    const Vector3 along = to - point.position;
    return inAir ? inAir->density(along.normalized()) : point.normal.dot(along) / along.norm();
  }
  /// 1/sr. 0 if a point of a surface and this one lie nearly in the plane of one of them: closer,
  /// rounding would tell the side; what lies in the plane of a light gets nothing of it.
  double perSteradian(const SurfacePoint& to) const
  {
    const bool isClear = inAir ||
      (isInFront(to.position) &&
        std::abs(to.normal.dot(to.position - point.position)) > 4 * to.clearance);
    return inAir ? 1 : isClear ? AreaLight::kPerSteradian * relativeRadiance(to.position) : 0;
  }
  /// See AreaLight; towards a place.
  double relativeRadiance(const Vector3& to) const
  {
    return onSurface && onSurface->ofLuminaire
      ? onSurface->relativeRadiance((to - point.position).normalized())
      : 1;
  }
  /// Whether light may leave towards a place, which rounding does not tell.
  bool isInFront(const Vector3& to) const
  {
    return inAir || point.normal.dot(to - point.position) > 4 * point.clearance;
  }
};

/**
 * A light of a frame, in world space: what it emits, from where and into which directions. Only
 * this room knows of which kind it is. What is seen of it from afar is a LampPiece, from a point a
 * SeenLight.
 */
class Light
{
public:
  using Kind = std::variant<AreaLight, PointLight, DistantLight>;

  Light(const SceneCell& itsCell, Kind kind)
    : cell(itsCell)
    , kind_(std::move(kind))
  {
  }

  Bands flux{};   ///< W, by band
  SceneCell cell; ///< to which it belongs

  double totalFlux() const { return flux[0] + flux[1] + flux[2]; }
  /// The triangle on which rays meet it, and from which they leave it; none for a light in the air.
  TriangleId triangle() const { return area() ? area()->id : TriangleId{}; }
  /// Null for a light in the air.
  const AreaLight* area() const { return std::get_if<AreaLight>(&kind_); }
  /// Null unless it shines from infinity.
  const DistantLight* distant() const { return std::get_if<DistantLight>(&kind_); }
  /// That triangle; null for a light in the air.
  const Triangle* surface() const { return area() ? &area()->triangle : nullptr; }
  /// Null: light leaves as after diffuse reflection, or in the air to all sides alike.
  const IntensityDistribution* distribution() const
  {
    return std::visit([](const auto& kind) { return kind.ofLuminaire.get(); }, kind_);
  }
  /// Of where rays leave it.
  Box bounds() const
  {
    return std::visit([](const auto& kind) { return kind.bounds(); }, kind_);
  }
  /// Of where it stands: empty, if it is infinitely far away.
  Box stand() const { return distant() ? Box() : bounds(); }
  /// The ray that leaves it from the place and in the direction that points of the unit square
  /// choose. In the air there is one place.
  Ray leaving(const std::array<double, 2>& place, const std::array<double, 2>& direction) const
  {
    return std::visit([&](const auto& kind) { return kind.leaving(place, direction); }, kind_);
  }
  /// Of a light that is not distant: on its triangle, or on a piece of that, by barycentric weights;
  /// in the air there is one place.
  LightPlace place(const Vector3& weights, const Triangle* piece = nullptr) const
  {
    if (const auto* const inAir = std::get_if<PointLight>(&kind_))
    {
      return { { inAir->position(), Vector3::Zero(), 0, true }, inAir };
    }
    return { surfacePoint(piece ? *piece : *surface(), weights), nullptr, area() };
  }

  /// Whether walks leave both alike.
  friend bool operator==(const Light& a, const Light& b)
  {
    return a.flux == b.flux && a.kind_ == b.kind_;
  }

private:
  Kind kind_;
};

}
