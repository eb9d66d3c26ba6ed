// SPDX-License-Identifier: BSD-3-Clause
#include "Animation.h"

#include "ProgressBar.h"
#include "VtkErrors.h"

#include <vtkCommand.h>
#include <vtkFieldData.h>
#include <vtkIrradianceFilter.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>
#include <vtkTransform.h>

namespace movingteapot
{

Animation::Animation(const std::string& name, const TeapotScene& scene, const Options& options,
  bool cacheStaticHits, ProgressBar& bar)
  : Name(name)
  , Frames(options.Frames)
  , Bar(bar)
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
  this->Light->SetDynamicTransform(0, this->RoomFromTeapot);
  this->Light->SetNumberOfWalks(options.Walks);
  this->Light->SetTraversalMode(options.TraversalMode);
  this->Light->SetCacheStaticHits(cacheStaticHits);
  this->Light->AddObserver(vtkCommand::ProgressEvent, this, &Animation::ShowProgress);
}

Animation::~Animation() = default;

void Animation::Show(int frame)
{
  const bool isFirst = this->Reports->GetNumberOfTuples() == 0;
  this->Bar.BeginStep(isFirst ? ShootingWork : UpdateWork,
    "frame " + std::to_string(frame + 1) + " of " + std::to_string(this->Frames) + this->Name);
  this->Path.SetPose(this->TimeOf(frame), this->RoomFromTeapot);
  const VtkErrors errors;
  this->Light->Update();
  errors.ThrowIfAny("the light cannot be computed");

  vtkFieldData* report = this->GetScene()->GetFieldData();
  if (isFirst)
  {
    this->Reports->DeepCopy(report);
  }
  else
  {
    this->Reports->InsertNextTuple(0, report);
  }
}

vtkMultiBlockDataSet* Animation::GetScene()
{
  return this->Light->GetOutput();
}

void Animation::ShowProgress(vtkObject*, unsigned long, void* fraction)
{
  this->Bar.SetStepFraction(*static_cast<double*>(fraction));
}

}
