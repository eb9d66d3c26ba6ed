// SPDX-License-Identifier: BSD-3-Clause
#include "Performance.h"

#include "ProgressBar.h"

namespace movingteapot
{

Performance::Performance(const std::string& name, const TeapotScene& scene,
  const AnimationConfig& config, int frames, ProgressBar& bar)
  : Name(name)
  , Frames(frames)
  , Bar(bar)
  , Light(scene, config)
{
  this->Light.SetProgressFunction([&bar](double fraction) { bar.SetStepFraction(fraction); });
}

void Performance::Show(int frame)
{
  this->Bar.BeginStep(this->Reports.empty() ? ShootingWork : UpdateWork,
    "frame " + std::to_string(frame + 1) + " of " + std::to_string(this->Frames) + this->Name);
  this->Light.Update(this->TimeOf(frame));
  this->Reports.push_back(this->Light.GetReport());
  this->Bar.EndStep();
}

}
