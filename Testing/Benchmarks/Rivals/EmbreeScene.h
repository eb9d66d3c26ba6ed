// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Rivals/Caster.h"
#include "Surfaces/SceneObjects.h"

#include <embree3/rtcore.h>

#include <memory>

/// The peer: the same scene in Embree, the static mesh and one instance for each dynamic object, as
/// an animation needs it.
class EmbreeScene
{
public:
  explicit EmbreeScene(const irradiance::SceneObjects& objects);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  RTCScene top() const { return top_; }

private:
  /// Not committed, so that instances may follow the mesh, which is geometry 0.
  RTCScene makeScene(const irradiance::TriangleMesh& mesh) const;

  RTCDevice device_;
  RTCScene top_;
};

/// `Packet`: RTCRayHit for one ray a call, RTCRayHit8 or RTCRayHit16. Embree is told that the rays
/// are incoherent: with the other flag, packets of photon rays are two to four times slower.
template <class Packet>
Caster makeEmbreeCaster(std::shared_ptr<const EmbreeScene> scene);
