#ifndef MovingTeapotScene_h
#define MovingTeapotScene_h

#include "Light/SceneObjects.h"

#include <string>

/// The scene of Examples/MovingTeapot.
class MovingTeapotScene
{
public:
  /// `head`: a file in the OFF format; empty: there is none. `scale`: of the teapot; a small one
  /// changes fewer walks. `isCoarse`: with large cells, and some 2000 triangles of the head.
  explicit MovingTeapotScene(const std::string& head, double scale = 1, bool isCoarse = false);

  /// With the teapot where the example has it at a time from 0 to 1.
  irradiance::SceneObjects objectsAt(double time) const;
  irradiance::SceneObjects objectsInFrame(int frame) const { return objectsAt(frame * kFrame); }

  /// Time from one frame to the next.
  static constexpr double kFrame = 1 / 60.0;

private:
  irradiance::SceneObjects objects_;
  double scale_;
};

#endif
