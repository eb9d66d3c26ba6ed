// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Surfaces/SceneObjects.h"

#include <functional>
#include <string>

struct MovingScene
{
  /// Time from one frame to the next.
  static constexpr double kFrame = 1 / 60.0;

  irradiance::SceneObjects at(double time) const
  {
    irradiance::SceneObjects placed = objects;
    place(placed, time);
    return placed;
  }
  irradiance::SceneObjects inFrame(int frame) const { return at(frame * kFrame); }

  std::string name;
  irradiance::SceneObjects objects;
  /// Places the dynamic objects at a time from 0 to 1.
  std::function<void(irradiance::SceneObjects&, double time)> place;
};

/// The scene of Examples/MovingTeapot. `head`: a file in the OFF format; empty: there is none.
/// `scale`: of the teapot; a small one changes fewer walks. `isCoarse`: with large cells, and some
/// 2000 triangles of the head.
MovingScene makeMovingTeapot(const std::string& head, double scale = 1, bool isCoarse = false);
