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

FrameReport Animation::GetReport()
{
  FrameReport report;
  report.ShootSeconds = this->GetFieldValue("ShootSeconds");
  report.VerifySeconds = this->GetFieldValue("VerifySeconds");
  report.RepairSeconds = this->GetFieldValue("RepairSeconds");
  report.Walks = this->GetFieldValue("NumberOfWalks");
  report.InvalidWalks = this->GetFieldValue("NumberOfInvalidWalks");
  report.Segments = this->GetFieldValue("NumberOfSegments");
  report.RepairedSegments = this->GetFieldValue("NumberOfRepairedSegments");
  report.HistoryBytes = this->GetFieldValue("HistoryBytes");
  report.EmittedPower = this->GetFieldValue("EmittedPower");
  report.AbsorbedPower = this->GetFieldValue("AbsorbedPower");
  report.EscapedPower = this->GetFieldValue("EscapedPower");
  return report;
}

double Animation::GetFieldValue(const char* name)
{
  vtkDataArray* array = this->GetScene()->GetFieldData()->GetArray(name);
  if (!array)
  {
    throw std::runtime_error(std::string("the light's field data lack ") + name);
  }
  return array->GetTuple1(0);
}

}
