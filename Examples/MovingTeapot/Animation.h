// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Options.h"
#include "ProgressBar.h"
#include "TeapotScene.h"
#include "VtkErrors.h"

#include <vtkCommand.h>
#include <vtkFieldData.h>
#include <vtkIrradianceFilter.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>
#include <vtkTransform.h>

namespace movingteapot
{

/** One play of the scene, frame after frame: its light, and a report of each frame. */
class Animation
{
public:
  /** What takes how long in the progress bar. */
  static constexpr double ShootingWork = 4.0;
  static constexpr double UpdateWork = 1.0;

  /** `name` goes into the progress bar, which must outlive the animation. */
  Animation(const std::string& name, const TeapotScene& scene, const Options& options,
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
    if (options.GatherRays > 0)
    {
      this->Light->SetMethodToGatheredEverywhere();
      this->Light->SetNumberOfRays(options.GatherRays);
    }
    else
    {
      this->Light->SetMethodToSpreadWalks(); // as in the paper
    }
    this->Light->SetTraversalMode(options.TraversalMode);
    this->Light->SetCacheStaticHits(cacheStaticHits);
    this->Light->AddObserver(vtkCommand::ProgressEvent, this, &Animation::ShowProgress);
  }

  /**
   * Moves the teapot and brings the light up to date. The first frame shown, whichever it is,
   * shoots all walks; the others verify them and shoot again what has changed. Throws
   * std::runtime_error when the filter reports an error.
   */
  void Show(int frame)
  {
    const bool isFirst = this->Reports->GetNumberOfTuples() == 0;
    this->Bar.BeginStep(isFirst ? ShootingWork : UpdateWork,
      "frame " + std::to_string(frame + 1) + " of " + std::to_string(this->Frames) + this->Name);
    this->Path.SetPose(this->TimeOf(frame), this->RoomFromTeapot);
    const VtkErrors errors;
    this->Light->Update();
    errors.ThrowIfAny("the light cannot be computed");
    if (isFirst)
    {
      this->Reports->CopyStructure(this->GetScene()->GetFieldData());
    }
    this->Reports->InsertNextTuple(0, this->GetScene()->GetFieldData());
  }

  /** Of a frame, from 0 to 1. */
  double TimeOf(int frame) const { return double(frame) / (this->Frames - 1); }

  /** As it was shown last. */
  vtkMultiBlockDataSet* GetScene() { return this->Light->GetOutput(); }

  /** The field data of the lit scene, a tuple for each frame shown. */
  vtkFieldData* GetReports() { return this->Reports; }

private:
  void ShowProgress(vtkObject*, unsigned long, void* fraction)
  {
    this->Bar.SetStepFraction(*static_cast<double*>(fraction));
  }

  std::string Name;
  int Frames;
  ProgressBar& Bar;
  TeapotPath Path;
  vtkNew<vtkTransform> RoomFromTeapot;
  vtkNew<vtkIrradianceFilter> Light;
  vtkNew<vtkFieldData> Reports;
};

}
