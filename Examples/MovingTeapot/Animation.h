// SPDX-License-Identifier: BSD-3-Clause
#ifndef Animation_h
#define Animation_h

#include "ErrorListener.h"
#include "FrameReport.h"
#include "TeapotPath.h"
#include "TeapotScene.h"

#include <vtkNew.h>

#include <functional>

class vtkIrradianceFilter;
class vtkMultiBlockDataSet;
class vtkTransform;

namespace movingteapot
{

struct AnimationConfig
{
  int Walks = 1000000;
  int TraversalMode = 2;
  bool CacheStaticHits = true;
};

/** The scene, its light, and the teapot's motion: a frame is a time from 0 to 1. */
class Animation
{
public:
  Animation(const TeapotScene& scene, const AnimationConfig& config);
  ~Animation();

  /** Called with 0 to 1 while a frame is computed. */
  void SetProgressFunction(std::function<void(double)> function);

  /**
   * Moves the teapot and brings the light up to date: the first call shoots all walks, the others
   * verify them and shoot again what has changed. Throws std::runtime_error when the filter reports
   * an error.
   */
  void Update(double time);

  /** The lit scene of the last update. */
  vtkMultiBlockDataSet* GetScene();

  /** Of the last update. */
  FrameReport GetReport();

private:
  double GetFieldValue(const char* name);

  vtkNew<vtkIrradianceFilter> Light;
  vtkNew<vtkTransform> TeapotToRoom;
  TeapotPath Path;
  ErrorListener Errors;
  std::function<void(double)> Progress;
};

}

#endif
