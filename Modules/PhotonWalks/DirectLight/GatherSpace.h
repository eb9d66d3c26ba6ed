// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_GatherSpace_h
#define irradiance_GatherSpace_h

#include "Scene/Scene.h"
#include "Surfaces/Contacts.h"
#include "Surfaces/ObjectSides.h"
#include "Surfaces/SceneTriangles.h"

namespace irradiance
{

/// The geometry of a frame in which cells gather light.
struct GatherSpace
{
  const Scene& scene;
  const SceneTriangles& triangles;
  const Contacts& contacts;
  const ObjectSides& sides; ///< of dynamic objects
};

}

#endif
