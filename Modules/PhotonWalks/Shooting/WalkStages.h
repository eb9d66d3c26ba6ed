// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_WalkStages_h
#define irradiance_WalkStages_h

#include "DirectLight/DirectRounds.h"
#include "Sampling/SampleGroup.h"
#include "Shooting/FrontTally.h"
#include "Shooting/WalkFront.h"
#include "Shooting/WalkSampler.h"
#include "Surfaces/SceneTriangles.h"

#include <cstdint>
#include <vector>

namespace irradiance
{

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
  WalkStages(const WalkSampler& sampler, const SceneTriangles& triangles, const LightTable& lights,
    const SobolSequence& samples, const DirectRounds* gathered = nullptr);

  /// Walks leave their lights, areas or points in the air. Reads walk, for which any numbers of the
  /// plan will do; writes bounce, parent, the ray with side, the weights of its place on `start`,
  /// candidate, isSpecular where cells are glossy, and powers with several bands.
  void start(WalkFront& front) const;

  /// Finds which sides the rays hit. Reads direction and hit; writes hitSide.
  void findSides(WalkFront& front) const;

  /**
   * Walks end at their hits, or survive with probability = reflectance. Those that do go to the
   * other front, in order, where they stand at the next bounce on the triangle `start`, which they
   * are to leave: leave() makes their rays. Their slot becomes `parent`. Reads walk, bounce, block,
   * slot, the ray, hit, weights and hitSide; with several bands uses up the powers of `from`.
   * Throws std::runtime_error for a walk that does not end.
   */
  void absorb(WalkFront& from, WalkFront& to) const;

  /**
   * Walks leave the points of `start` that the weights name. Reads walk, bounce, start, weights and
   * side. Writes the ray. Of a stored segment the hit and the side that was hit are `start`,
   * weights and side of the segment after it, which has one bounce more. Where cells are glossy it
   * also reads isSpecular, and for walks for which it is set the origin of the ray that came and
   * its direction.
   */
  void leave(WalkFront& front) const;

private:
  /// Several bands: whether a walk survives depends on its powers, which change.
  void decideByPowers(WalkFront& front) const;
  void chooseReflections(WalkFront& front) const;
  void startAtLights(WalkFront& front) const;
  void startAtCells(WalkFront& front) const;
  void startInAir(WalkFront& front) const;
  void setPowers(WalkFront& front) const;
  /// A walk that leaves specularly: its row, whence the light came, and the point that it leaves.
  struct Specular
  {
    std::size_t row;
    Vector3 from, weights;
  };
  std::vector<Specular> specularOf(const WalkFront& front) const;
  void leaveSpecularly(WalkFront& front, const std::vector<Specular>& specular) const;
  void checkEnds(const WalkFront& front) const;

  const WalkSampler& sampler_;
  const SceneTriangles& triangles_;
  const LightTable& lights_;
  const SobolSequence& samples_;
  const DirectRounds* gathered_;
  BounceKeys lightKeys_, positionKeys_, survivalKeys_, directionKeys_;
  std::vector<std::uint32_t> triangleOfLight_;
  bool hasLightsInAir_ = false;
};

/// A direction rounded to float that still points to the side of the unit normal.
Vector3 roundedDirection(const Vector3& direction, const Vector3& normal);

}

#endif
