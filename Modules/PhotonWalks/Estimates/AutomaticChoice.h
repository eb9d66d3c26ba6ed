// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_AutomaticChoice_h
#define irradiance_AutomaticChoice_h

#include "Estimates/CellEstimate.h"
#include "Progress/CancelPoint.h"
#include "Surfaces/SceneCells.h"

namespace irradiance
{

/// Which settings a user leaves to the scene.
struct LeftToScene
{
  bool directLight = false;
  bool cellEstimate = false;
};

/**
 * Chooses what is left to the scene of a frame: to gather wherever that pays.
 *
 * The cell estimate is Gathered unless one of these forbids it, and else Sums:
 * - direct light is to be shot;
 * - the rays of all cells are more than kMostForWalk for each walk: fine meshes with few walks;
 * - a point light is unseen, see unseenLight();
 * - less than kLeastRead of the area is of cells that rays can read: paths would go on for long.
 *
 * Direct light is gathered if the estimate is Gathered, or if the fewest samples of all cells are at most kMostForWalk
 * for each walk.
 *
 * It follows from the settings and the frame alone, never from what was shot: so an update chooses as a fresh start
 * does. Rigid motion changes none of it.
 */
class AutomaticChoice
{
public:
  /// Rays, or samples, for each walk. One costs about as much as a segment of a walk.
  static constexpr double kMostForWalk = 4;
  static constexpr double kLeastRead = 0.5;

  /// Sets what is left in `walks` and `estimate`. There `gathersDirectLight` tells whether direct light may be gathered,
  /// or has to be.
  void make(const LeftToScene& left, const SceneObjects& objects, WalkSettings& walks,
    EstimateSettings& estimate, const CancelPoint& cancelPoint = {});

private:
  bool isToBeRead(const SceneObjects& objects, const WalkSettings& walks,
    const EstimateSettings& estimate, const CancelPoint& cancelPoint);

  SceneCells cells_; ///< of the last frame in which areas mattered
};

}

#endif
