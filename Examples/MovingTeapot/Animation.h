// SPDX-License-Identifier: BSD-3-Clause
#ifndef Animation_h
#define Animation_h

#include "Options.h"
#include "TeapotScene.h"

#include <vtkNew.h>

#include <string>

class vtkFieldData;
class vtkIrradianceFilter;
class vtkMultiBlockDataSet;
class vtkObject;
class vtkTransform;

namespace movingteapot
{

class ProgressBar;

/** One play of the scene, frame after frame: its light, and a report of each frame. */
class Animation
{
public:
  /** What takes how long in the progress bar. */
  static constexpr double ShootingWork = 4.0;
  static constexpr double UpdateWork = 1.0;

  /** `name` goes into the progress bar, which must outlive the animation. */
  Animation(const std::string& name, const TeapotScene& scene, const Options& options,
    bool cacheStaticHits, ProgressBar& bar);
  ~Animation();

  /**
   * Moves the teapot and brings the light up to date. The first frame shown, whichever it is, shoots
   * all walks; the others verify them and shoot again what has changed. Throws std::runtime_error
   * when the filter reports an error.
   */
  void Show(int frame);

  /** Of a frame, from 0 to 1. */
  double TimeOf(int frame) const { return double(frame) / (this->Frames - 1); }

  /** As it was shown last. */
  vtkMultiBlockDataSet* GetScene();

  /** The field data of the lit scene, a tuple for each frame shown. */
  vtkFieldData* GetReports() { return this->Reports; }

private:
  void ShowProgress(vtkObject*, unsigned long, void* fraction);

  std::string Name;
  int Frames;
  ProgressBar& Bar;
  TeapotPath Path;
  vtkNew<vtkTransform> RoomFromTeapot;
  vtkNew<vtkIrradianceFilter> Light;
  vtkNew<vtkFieldData> Reports;
};

}

#endif
