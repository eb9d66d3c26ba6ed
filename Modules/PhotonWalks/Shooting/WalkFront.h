// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_WalkFront_h
#define irradiance_WalkFront_h

#include "Geometry/Ray.h"
#include "Shooting/FrontColumn.h"
#include "Surfaces/Power.h"

#include <cstdint>
#include <utility>

namespace irradiance
{

/**
 * Walks that go on together, one segment of each, column by column. Triangles have numbers through all
 * objects, see SceneTriangles; kNone is none. Usually all walks are at the same bounce; after repairs they
 * are not, and stages are slower but give the same.
 *
 * The columns are raw memory: a stage says which it reads and which it writes.
 */
struct WalkFront
{
  static constexpr std::uint32_t kNone = TriangleId::kNone;
  /// Stages take that many walks at a time.
  static constexpr std::size_t kGroup = 32;
  /// Walks that are shot together: some four blocks.
  static constexpr std::size_t kUsualSize = 4096;

  std::size_t size = 0;

  // The ray.
  FrontColumn<double> originX, originY, originZ;
  FrontColumn<float> directionX, directionY, directionZ; ///< of unit length to float rounding
  FrontColumn<std::uint32_t> start;                      ///< the triangle that it leaves, or kNone
  FrontColumn<std::uint8_t> side;                        ///< 1 if it leaves the front, 0 the back
  // Where it ends. Before it is cast: where the walk leaves `start`, by the weights.
  FrontColumn<double> distance;
  FrontColumn<std::uint32_t> hit;       ///< the triangle, or kNone if the walk escapes
  FrontColumn<float> weightB, weightC;  ///< of the second and third corner
  FrontColumn<std::uint8_t> hitSide;    ///< 1 the front, 0 the back; only where sides matter
  FrontColumn<std::uint32_t> candidate; ///< of whoever casts
  // Whose it is.
  FrontColumn<std::uint32_t> walk, bounce;
  FrontColumn<std::uint32_t> block;        ///< that stores it
  FrontColumn<std::uint16_t> slot, parent; ///< in the block: of this segment and of the one before
  FrontColumn<std::uint8_t> isSpecular;    ///< how it leaves `start`; only where cells are glossy
  FrontColumn<std::int64_t> power[Power::kMaxBands]; ///< quanta; only with several bands
  /// A bit for each walk of a group that survives, see WalkStages::absorb().
  FrontColumn<std::uint32_t> survivors;

  std::size_t groups() const { return (size + kGroup - 1) / kGroup; }

  /// Room for that many walks. Keeps the columns; never gives room back.
  void reserve(std::size_t walks, int bands);
  /// Gives the places behind the last walk, up to a whole group, values that stages can read.
  void pad();

  Power powerAt(std::size_t place, int bands) const
  {
    Power carried;
    for (int band = 0; band < bands; ++band)
    {
      carried[band] = power[band][place];
    }
    return carried;
  }
  void setPower(std::size_t place, int bands, const Power& carried)
  {
    for (int band = 0; band < bands; ++band)
    {
      power[band][place] = carried[band];
    }
  }
};

/// The two fronts between which the stages of a thread go to and fro. Their memory is used again for as
/// long as the thread lives.
struct FrontPair
{
  WalkFront now, next;

  void swap() { std::swap(now, next); }
  static FrontPair& ofThread();
};

}

#endif
