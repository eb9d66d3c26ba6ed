// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "DirectLight/DirectGather.h"
#include "Lights/LightTable.h"
#include "Meshes/SurfacePoint.h"
#include "Sampling/SobolSequence.h"
#include "Shooting/FrontTally.h"
#include "Shooting/WalkFront.h"
#include "Surfaces/Absorption.h"
#include "Surfaces/SceneTriangles.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace irradiance
{

/// The unit direction in which light that comes `from` a point hits a surface, against its normal.
inline Vector3 incomingDirection(const SurfacePoint& point, const Vector3& from)
{
  const Vector3 incoming = (point.position - from).normalized();
  // Points that touch are too close to tell.
  return incoming.dot(point.normal) < 0 ? incoming : Vector3(-point.normal);
}

/// A direction rounded to float that still points to the side of the unit normal.
Vector3 roundedDirection(const Vector3& direction, const Vector3& normal);

/**
 * The stages of a bounce, each for a whole front:
 *
 *   start -> (cast) -> findSides -> FrontTally::receive -> absorb -> leave
 *               ^-------------------------------------------------------'
 *
 * Walks that a history knows enter at leave(), or, with a known hit, after the cast. What a walk
 * does is a function of the scene, the samples and its number, whatever else is in its front. So
 * rays need not be stored: start() and leave() find them again, bit for bit, for any walks in any
 * order and at any bounces.
 */
class WalkStages
{
public:
  /// The arguments must outlive the stages. `gathered`: walks start there instead of at the lights;
  /// or null.
  WalkStages(const SceneObjects& objects, const SceneTriangles& triangles, const LightTable& lights,
    const SobolSequence& samples, const DirectRounds* gathered = nullptr);

  /// Walks leave their lights, areas or points in the air. Reads walk, for which any numbers of the
  /// plan will do; writes bounce, parent, the ray with side, the weights of its place on `start`,
  /// candidate, leaving where cells are glossy, and powers with several bands.
  void start(WalkFront& front) const;

  /// Finds which sides the rays hit. Reads direction and hit; writes hitSide.
  void findSides(WalkFront& front) const;

  /**
   * Walks end at their hits, or survive with probability = reflectance, or transmittance. Those that
   * do go to the other front, in order, where they stand at the next bounce on the triangle `start`,
   * which they are to leave from a side: leave() makes their rays. Their slot becomes `parent`.
   * Reads walk, bounce, block, slot, the ray, hit, weights and hitSide; uses up hitSide, and with
   * several bands the powers, of `from`.
   * Throws std::runtime_error for a walk that does not end.
   */
  void absorb(WalkFront& from, WalkFront& to) const;

  /**
   * Walks leave the points of `start` that the weights name. Reads walk, bounce, start, weights and
   * side. Writes the ray. Of a stored segment the hit and the side that was left are `start`,
   * weights and side of the segment after it, which has one bounce more. Where cells are glossy it
   * also reads leaving, for walks that leave along a lobe the origin of the ray that came, and for
   * those that go straight on the direction, see goStraight().
   */
  void leave(WalkFront& front) const;

  // What a single walk does.
  int bands() const { return objects_.staticObject.material->bands; }
  /// The power with which a walk starts; its light decides.
  Power powerOf(std::uint32_t walk) const { return lights_.power(numberOfLight(walk)); }
  /// The light from which a walk starts.
  const Light& lightOf(std::uint32_t walk) const { return lights_[numberOfLight(walk)]; }
  /// The power of every walk, if there is one band.
  Power powerPerWalk() const { return { { lights_.quantaPerWalk() } }; }
  const Material& materialOf(std::uint32_t object) const { return *objects_[object].material; }
  std::uint32_t cellOf(const TriangleId& id) const
  {
    return materialOf(id.object).cellOfTriangle[id.triangle];
  }
  /// How a walk leaves the hit of its segment before `bounce`, given that it survives there.
  /// `incoming`: the power of that segment; matters only if there are several bands. `cosine`: of
  /// incidence; matters for panes.
  Leaving leavingOf(const TriangleId& hit, std::uint32_t walk, std::uint32_t bounce,
    const Power& incoming, double cosine) const;
  /// Gives a row of a front the direction in which it hits `triangle` on a side, at the place that
  /// the weights name. Reads the origin of the ray that came. Returns the cosine of incidence.
  double goStraight(WalkFront& front, std::size_t row, std::uint32_t triangle, bool isFront) const;

private:
  /// Where a row is on a triangle, on one of its sides.
  SurfacePoint pointOf(
    const WalkFront& front, std::size_t row, std::uint32_t triangle, bool isFront) const;
  /// How a row leaves its hit, from which side, and with which power. False if it does not.
  bool choose(WalkFront& front, std::size_t row, double sample) const;
  std::size_t numberOfLight(std::uint32_t walk) const
  {
    return lights_.choose(samples_.sample(walk, 0, SampleUse::Light)[0]);
  }
  /// Several bands: whether a walk survives depends on its powers, which change.
  void decideByPowers(WalkFront& front) const;
  void chooseWays(WalkFront& front) const;
  void startAtLights(WalkFront& front) const;
  void startAtCells(WalkFront& front) const;
  void startByLights(WalkFront& front) const;
  /// Of the few walks that leave sharply, by row. They follow from where the segments before
  /// began, and from the points that are left, as both follow from what is stored.
  std::vector<std::pair<std::size_t, Vector3>> sharpDirections(const WalkFront& front) const;
  void checkEnds(const WalkFront& front) const;

  const SceneObjects& objects_;
  const SceneTriangles& triangles_;
  const LightTable& lights_;
  const SobolSequence& samples_;
  const DirectRounds* gathered_;
  std::vector<std::uint32_t> triangleOfLight_;
  bool hasOwnStarts_ = false; ///< of lights that are no diffuse faces
};

}
