// SPDX-License-Identifier: BSD-3-Clause
#include "Animation.h"

#include <vtkCallbackCommand.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIrradianceFilter.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>
#include <vtkTransform.h>

#include <stdexcept>
#include <string>

namespace movingteapot
{
namespace
{

void ForwardProgress(vtkObject*, unsigned long, void* function, void* fraction)
{
  const auto& progress = *static_cast<std::function<void(double)>*>(function);
  if (progress)
  {
    progress(*static_cast<double*>(fraction));
  }
}

}

Animation::Animation(const TeapotScene& scene, const AnimationConfig& config)
  : Errors(Light)
{
  for (vtkPolyData* still :
    { scene.Room.Get(), scene.Lamp.Get(), scene.Plinth.Get(), scene.Head.Get() })
  {
    if (still)
    {
      this->Light->AddInputDataObject(0, still);
    }
  }
  this->Light->AddInputDataObject(1, scene.Teapot);
  this->Light->SetDynamicTransform(0, this->TeapotToRoom);
  this->Light->SetNumberOfWalks(config.Walks);
  this->Light->SetTraversalMode(config.TraversalMode);
  this->Light->SetCacheStaticHits(config.CacheStaticHits);

  vtkNew<vtkCallbackCommand> forward;
  forward->SetClientData(&this->Progress);
  forward->SetCallback(ForwardProgress);
  this->Light->AddObserver(vtkCommand::ProgressEvent, forward);
}

Animation::~Animation() = default;

void Animation::SetProgressFunction(std::function<void(double)> function)
{
  this->Progress = std::move(function);
}

void Animation::Update(double time)
{
  this->Path.SetPose(time, this->TeapotToRoom);
  this->Light->Update();
  this->Errors.ThrowIfAny("the light cannot be computed");
}

vtkMultiBlockDataSet* Animation::GetScene()
{
  return vtkMultiBlockDataSet::SafeDownCast(this->Light->GetOutputDataObject(0));
}

FrameTiming Animation::GetTiming()
{
  FrameTiming timing;
  timing.ShootSeconds = this->Report("ShootSeconds");
  timing.VerifySeconds = this->Report("VerifySeconds");
  timing.RepairSeconds = this->Report("RepairSeconds");
  timing.Segments = this->Report("NumberOfSegments");
  timing.RepairedSegments = this->Report("NumberOfRepairedSegments");
  timing.EmittedPower = this->Report("EmittedPower");
  timing.AbsorbedPower = this->Report("AbsorbedPower");
  timing.EscapedPower = this->Report("EscapedPower");
  return timing;
}

double Animation::Report(const char* name)
{
  vtkDataArray* report = this->GetScene()->GetFieldData()->GetArray(name);
  if (!report)
  {
    throw std::runtime_error(std::string("the light's field data lack ") + name);
  }
  return report->GetTuple1(0);
}

}
