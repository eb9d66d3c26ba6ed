// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rivals/PlainScene.h"

#include <embree3/rtcore.h>

#include <vector>

/// The triangles of a plain scene in one tree of Embree's high quality, for one thread.
class PlainEmbree
{
public:
  explicit PlainEmbree(const PlainScene& scene);
  ~PlainEmbree();
  PlainEmbree(const PlainEmbree&) = delete;
  PlainEmbree& operator=(const PlainEmbree&) = delete;

  RTCScene scene() const { return scene_; }
  /// Whether Embree has packets of 16 rays in instructions of the machine.
  bool hasPacketsOf16() const;

private:
  RTCDevice device_;
  RTCScene scene_;
};

/**
 * Whether light may reach the back of each cell. A back from which no ray of a few hits a front is
 * taken for the inside of a closed body or the outside of a room, which a user who bakes light
 * would leave out. That is a guess; where it is wrong, answers differ from those of a tracer that
 * shoots.
 */
std::vector<char> findOpenCells(const PlainScene& scene, const PlainEmbree& embree);
