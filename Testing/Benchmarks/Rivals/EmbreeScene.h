// SPDX-License-Identifier: BSD-3-Clause
#ifndef EmbreeScene_h
#define EmbreeScene_h

#include "Geometry/Ray.h"
#include "Surfaces/SceneObjects.h"

#include <embree3/rtcore.h>

#ifdef __SSE2__
#include <pmmintrin.h>
#endif

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
  /// Rays that leave a surface begin here, a float's rounding away from their origins.
  float nearest() const { return near_; }

private:
  /// Not committed, so that instances may follow the mesh, which is geometry 0.
  RTCScene makeScene(const irradiance::TriangleMesh& mesh) const;

  RTCDevice device_;
  RTCScene top_;
  float near_;
};

/// Tells the processor to take denormal numbers for zero in this thread, as Embree's manual
/// advises.
inline void flushDenormals()
{
#ifdef __SSE2__
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
  _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
#endif
}

#endif
