// SPDX-License-Identifier: BSD-3-Clause
#ifndef OurCaster_h
#define OurCaster_h

#include "Rivals/Caster.h"
#include "Scene/Scene.h"
#include "Simd/SimdLevel.h"
#include "Surfaces/SceneObjects.h"

/// The scene with its trees built, ready for casts.
std::shared_ptr<const irradiance::Scene> makeScene(const irradiance::SceneObjects& objects,
  irradiance::TraversalMode mode = irradiance::TraversalMode::Parallel);

/// irradiance::Scene, which casts all rays by one call, with these instructions at best.
Caster makeOurCaster(std::shared_ptr<const irradiance::Scene> scene, irradiance::SimdLevel level);

#endif
