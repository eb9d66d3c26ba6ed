// SPDX-License-Identifier: BSD-3-Clause
#ifndef Performance_h
#define Performance_h

#include "Animation.h"
#include "FrameReport.h"

#include <string>
#include <vector>

namespace movingteapot
{

class ProgressBar;

/** One play of the animation, frame after frame, with a report of each. */
class Performance
{
public:
  /** What takes how long in the progress bar. */
  static constexpr double ShootingWork = 4.0;
  static constexpr double UpdateWork = 1.0;

  /** `name` goes into the progress bar, which must outlive the performance. */
  Performance(const std::string& name, const TeapotScene& scene, const AnimationConfig& config,
    int frames, ProgressBar& bar);

  /** The first frame shown, whichever it is, is a shooting; the others are updates. */
  void Show(int frame);

  /** As it was shown last. */
  vtkMultiBlockDataSet* GetScene() { return this->Light.GetScene(); }
  const std::vector<FrameReport>& GetReports() const { return this->Reports; }

  /** Of a frame, from 0 to 1. */
  double TimeOf(int frame) const { return double(frame) / (this->Frames - 1); }

private:
  std::string Name;
  int Frames;
  ProgressBar& Bar;
  Animation Light;
  std::vector<FrameReport> Reports;
};

}

#endif
