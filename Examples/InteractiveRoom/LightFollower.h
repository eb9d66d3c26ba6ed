// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Room.h"

#include <vtkIrradianceFilter.h>
#include <vtkNew.h>

#include <functional>

class vtkMultiBlockDataSet;
class vtkObject;

namespace interactiveroom
{

/**
 * The light of a room, which follows what moves in steps of a given time. A step repairs what it
 * has time for; further steps without motion end with exactly the light of a new filter.
 */
class LightFollower
{
public:
  /** `gatherRays`: from each small cell; 0: these are spread. */
  LightFollower(const Room& room, int walks, int gatherRays);

  vtkIrradianceFilter* GetFilter() { return this->Filter; }
  vtkMultiBlockDataSet* GetScene() { return this->Filter->GetOutput(); }

  /** Of a moving thing. Who changes it moves the thing. */
  vtkTransform* GetPose(int thing) { return this->Poses[thing]; }

  /** The first shooting, all walks; `report` gets the part that is done, 0 to 1, at least every 0.1 s. */
  void Shoot(const std::function<void(double)>& report);

  /** Whether something has moved since the last step. */
  bool HasMoved();
  /** Whether the light is that of a new filter: nothing has moved since, and no walk is stale. */
  bool IsExact();

  /** Brings the light up to date and shows it, in about `seconds` for both together. */
  void Step(double seconds, const std::function<void()>& show);

  /** Steps without showing until the light is exact. */
  void Settle();

private:
  void Update();
  void ReportProgress(vtkObject*, unsigned long, void* fraction);

  vtkNew<vtkIrradianceFilter> Filter;
  std::vector<vtkSmartPointer<vtkTransform>> Poses;
  std::function<void(double)> Report;
  vtkMTimeType Seen = 0; // of the filter, at the last step
  double Overhead = 0;   // s: what a step takes besides the repair
};

}
