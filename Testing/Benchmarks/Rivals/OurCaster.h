#ifndef OurCaster_h
#define OurCaster_h

#include "Light/SceneObjects.h"
#include "Rivals/Caster.h"
#include "Scene/Scene.h"
#include "Simd/SimdLevel.h"

#include <string>

/// Instructions that our casts can be held to.
struct SimdChoice
{
  std::string name; ///< behind that of the rival; empty for the best that the machine has
  irradiance::SimdLevel level;
};

/// All that this machine has, the best first.
std::vector<SimdChoice> simdChoices();

std::vector<irradiance::PlacedObject> placedObjects(const irradiance::SceneObjects& objects);

/// The scene with its trees built, ready for casts.
std::shared_ptr<const irradiance::Scene> makeScene(const irradiance::SceneObjects& objects,
  irradiance::TraversalMode mode = irradiance::TraversalMode::Parallel);

/// irradiance::Scene, which casts all rays by one call.
Caster makeOurCaster(std::shared_ptr<const irradiance::Scene> scene, irradiance::SimdLevel level);

#endif
