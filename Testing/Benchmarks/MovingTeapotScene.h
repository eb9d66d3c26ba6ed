#ifndef MovingTeapotScene_h
#define MovingTeapotScene_h

#include "Light/SceneObjects.h"

#include <string>

namespace movingteapot
{
struct TeapotScene;
}

/// The scene of Examples/MovingTeapot, as the filter hands it to the engine.
class MovingTeapotScene
{
public:
  /// `head`: a file in the OFF format. `scale`: of the teapot; a small one changes fewer walks.
  explicit MovingTeapotScene(const std::string& head, double scale = 1);
  /// With other meshes in the same places.
  explicit MovingTeapotScene(const movingteapot::TeapotScene& parts, double scale = 1);

  /// With the teapot where the example has it at a time from 0 to 1.
  irradiance::SceneObjects objectsAt(double time) const;

  /// The teapot's number in the scene.
  static constexpr std::uint32_t kTeapot = 1;
  /// Time from one frame to the next.
  static constexpr double kFrame = 1 / 60.0;

private:
  irradiance::SceneObjects objects_;
  double scale_;
};

#endif
