#ifndef OurCaster_h
#define OurCaster_h

#include "Caster.h"
#include "Light/SceneObjects.h"
#include "Scene/Scene.h"
#include "Simd/SimdLevel.h"

/// Instructions that our casts can be held to.
struct SimdChoice
{
  std::string name; ///< behind that of the rival; empty for the best that the machine has
  irradiance::SimdLevel level;
};

/// All that this machine has, the best first.
std::vector<SimdChoice> simdChoices();

/// irradiance::Scene, which casts all rays by one call.
class OurCaster : public Caster
{
public:
  OurCaster(
    std::string name, std::shared_ptr<const irradiance::Scene> scene, const SimdChoice& choice);

  void setRays(const std::vector<irradiance::Ray>& rays) override { rays_ = rays; }
  void cast(std::vector<irradiance::Hit>& hits) override;

private:
  std::shared_ptr<const irradiance::Scene> scene_;
  SimdChoice choice_;
  std::vector<irradiance::Ray> rays_;
};

/// The scene with its trees built, ready for casts.
std::shared_ptr<const irradiance::Scene> makeScene(const irradiance::SceneObjects& objects,
  irradiance::TraversalMode mode = irradiance::TraversalMode::Parallel);

#endif
