// SPDX-License-Identifier: BSD-3-Clause
#include "LightFollower.h"

#include "VtkErrors.h"

#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace interactiveroom
{
namespace
{

using Clock = std::chrono::steady_clock;

// Also where all else takes too long already, the repair goes on.
constexpr double LeastBudget = 0.004; // s
constexpr double SettleBudget = 0.05; // s

constexpr int SpreadPhotons = 100;

// Few replicates know the error of a cell crudely, but the mean error of all cells well enough, and
// each of them costs time in every step.
constexpr int Replicates = 4;

// Whether small cells may look for their light by themselves. Where many cells move no step would
// be short; and rays do not know how shiny cells reflect the light of points.
bool MayGather(const Room& room)
{
  constexpr vtkIdType most = 20000;
  vtkIdType cells = 0;
  bool hasPoints = false;
  const auto look = [&](vtkPolyData* mesh) {
    hasPoints = hasPoints || mesh->GetCellData()->HasArray("RadiantFlux");
  };
  for (const StillThing& still : room.Still)
  {
    look(still.Mesh);
  }
  for (const MovingThing& moving : room.Moving)
  {
    look(moving.Mesh);
    cells += moving.Mesh->GetNumberOfCells();
  }
  return cells <= most && !hasPoints;
}

}

LightFollower::LightFollower(const Room& room, int walks, int gatherRays)
{
  for (const StillThing& still : room.Still)
  {
    this->Filter->AddInputDataObject(0, still.Mesh);
  }
  for (const MovingThing& moving : room.Moving)
  {
    const int thing = int(this->Poses.size());
    this->Poses.push_back(vtkSmartPointer<vtkTransform>::New());
    this->Poses.back()->SetMatrix(moving.WorldFromMesh->GetMatrix());
    this->Filter->AddInputDataObject(1, moving.Mesh);
    this->Filter->SetDynamicTransform(thing, this->Poses.back());
  }
  this->Filter->SetNumberOfWalks(walks);
  this->Filter->SetRepairTimeBudget(SettleBudget);
  // What moves has small cells, which few walks hit.
  if (gatherRays > 0 && MayGather(room))
  {
    this->Filter->SetMethodToGathered();
    this->Filter->SetNumberOfRays(gatherRays);
  }
  else
  {
    this->Filter->SetMethodToSpreadWalks();
    this->Filter->SetNumberOfSpreadPhotons(SpreadPhotons);
  }
  this->Filter->ComputeStandardErrorOn();
  this->Filter->SetNumberOfReplicates(Replicates);
  this->Filter->AddObserver(vtkCommand::ProgressEvent, this, &LightFollower::ReportProgress);
}

void LightFollower::ReportProgress(vtkObject*, unsigned long, void* fraction)
{
  if (this->Report)
  {
    this->Report(*static_cast<double*>(fraction));
  }
}

void LightFollower::Update()
{
  this->Seen = this->Filter->GetMTime();
  const movingteapot::VtkErrors errors;
  this->Filter->Update();
  errors.ThrowIfAny("the light cannot be computed");
}

void LightFollower::Shoot(const std::function<void(double)>& report)
{
  this->Report = report;
  this->Update();
  this->Report = nullptr;
}

bool LightFollower::HasMoved()
{
  return this->Filter->GetMTime() > this->Seen;
}

bool LightFollower::IsExact()
{
  return !this->HasMoved() && this->Filter->GetFigure("StalePower") == 0;
}

void LightFollower::Step(double seconds, const std::function<void()>& show)
{
  const auto begin = Clock::now();
  this->Filter->SetRepairTimeBudget(std::max(LeastBudget, seconds - this->Overhead));
  this->Filter->Modified(); // stale walks are repaired where nothing has moved, too
  this->Update();
  show();
  const std::chrono::duration<double> taken = Clock::now() - begin;
  const double overhead = taken.count() - this->Filter->GetFigure("RepairSeconds");
  // What took longer once may do so again.
  this->Overhead = std::max(overhead, 0.8 * this->Overhead + 0.2 * overhead);
}

void LightFollower::Settle()
{
  while (!this->IsExact())
  {
    this->Filter->SetRepairTimeBudget(SettleBudget);
    this->Filter->Modified();
    this->Update();
  }
}

}
