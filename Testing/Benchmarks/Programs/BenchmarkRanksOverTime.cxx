// SPDX-License-Identifier: BSD-3-Clause
/**
 * How processes best share a dose: walks, or whole time steps. In a closed room a ball rides once
 * across, and its dose is integrated over uniform steps. Run by mpirun, one thread in each process,
 * wall clock. By turns, round by round, with new filters: the first process alone, all by walks,
 * all by steps. Before any time counts, all have to have the same bits.
 *
 * What decides is measured as well, in the run of the first process: W0, the first shooting; W,
 * verification and repair of a step; F, all the rest of a step. On n processes T times take W0 / n
 * + T (F + W / n) by walks, and W0 + T (F + W) / n + T X by steps, where X is what it takes to
 * share the data of a time. Some cases have a filter upstream that works for some milliseconds at
 * each time, as a reader or a simulation would.
 *
 * Arguments: [rounds = 3] [walks, rows, steps, upstream ms: one case; 0: all]
 */
#include "../../FiltersIrradiance/TestScenes.h"
#include "Measuring/Processes.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Measuring/Rounds.h"

#include "vtkCallbackCommand.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkKeyFramedPose.h"
#include "vtkObjectFactory.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkRadiantExposureFilter.h"
#include "vtkSMPTools.h"

#include <cmath>
#include <stdexcept>
#include <string>

using namespace TestScenes;

namespace
{

struct Case
{
  vtkIdType walks;
  int rows; ///< of cells, on each wall
  int steps;
  double upstream; ///< ms at each time

  std::string name() const
  {
    return std::to_string(walks) + " walks, " + std::to_string(6 * rows * rows) + " cells, " +
      std::to_string(steps) + " steps, " + std::to_string(std::lround(upstream)) + " ms upstream";
  }
};

/// Passes its input on after some time of work.
class Worker : public vtkPolyDataAlgorithm
{
public:
  static Worker* New() { VTK_STANDARD_NEW_BODY(Worker); }
  vtkTypeMacro(Worker, vtkPolyDataAlgorithm);

  double Milliseconds = 0;

protected:
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* output) override
  {
    const double end = threadCpuSeconds() + Milliseconds / 1000;
    while (threadCpuSeconds() < end)
    {
    }
    vtkPolyData::GetData(output)->ShallowCopy(vtkPolyData::GetData(inputs[0]));
    return 1;
  }
};

/// A room through which a ball rides, and its dose by new filters.
class Ride
{
public:
  Ride(const Case& what, vtkMPIController* ofWalks, vtkMPIController* ofTimes)
    : irradiance_(MakeFilter(
        { { MakeRoom(4, what.rows), MakeLamp({ 2, 2, 3.8 }, 1, { 100 }) }, {} }, what.walks))
  {
    pose_->SetInputData(MakeBall(0.3, 24));
    pose_->AddPose(0, 1, 1.5, 1.5, 0, 0, 0);
    pose_->AddPose(1, 3, 1.5, 1.5, 0, 0, 0);
    worker_->Milliseconds = what.upstream;
    worker_->SetInputConnection(pose_->GetOutputPort());
    irradiance_->AddInputConnection(1, worker_->GetOutputPort());
    irradiance_->SetController(ofWalks);
    dose_->SetInputConnection(irradiance_->GetOutputPort());
    dose_->SetController(ofTimes);
    dose_->SetIntegrationModeToUniform();
    dose_->SetNumberOfTimeSteps(what.steps);
    vtkNew<vtkCallbackCommand> end;
    end->SetClientData(this);
    end->SetCallback(
      [](vtkObject*, unsigned long, void* ride, void*) { static_cast<Ride*>(ride)->addCosts(); });
    irradiance_->AddObserver(vtkCommand::EndEvent, end);
  }

  void update()
  {
    vtkSMPTools::LocalScope(
      vtkSMPTools::Config{ 1, "Sequential", false }, [this] { dose_->Update(); });
  }
  double shooting() const { return shooting_; }
  double repair() const { return repair_; }
  std::vector<double> answer()
  {
    std::vector<double> values;
    auto* output = vtkMultiBlockDataSet::SafeDownCast(dose_->GetOutputDataObject(0));
    for (const unsigned int port : { 0u, 1u })
    {
      vtkDataArray* array = OutputOf(output, port, 0)->GetCellData()->GetArray("RadiantExposure");
      for (vtkIdType cell = 0; cell < array->GetNumberOfTuples(); ++cell)
      {
        values.push_back(array->GetTuple1(cell));
      }
    }
    return values;
  }

private:
  void addCosts()
  {
    shooting_ += irradiance_->GetFigure("ShootSeconds");
    repair_ += irradiance_->GetFigure("VerifySeconds") + irradiance_->GetFigure("RepairSeconds");
  }

  vtkNew<vtkKeyFramedPose> pose_;
  vtkNew<Worker> worker_;
  vtkSmartPointer<vtkIrradianceFilter> irradiance_;
  vtkNew<vtkRadiantExposureFilter> dose_;
  double shooting_ = 0, repair_ = 0;
};

/// Seconds, round by round.
struct Series
{
  std::vector<double> alone, byWalks, bySteps;
  std::vector<double> shooting, fixed, repair, longRepair; ///< W0, F, W, and W by steps
};

void runRound(const Processes& processes, const Case& what, Series& series)
{
  const double times = what.steps + 1;
  Ride byWalks(what, processes.all(), nullptr), bySteps(what, nullptr, processes.all());
  series.byWalks.push_back(processes.secondsOf([&] { byWalks.update(); }));
  series.bySteps.push_back(processes.secondsOf([&] { bySteps.update(); }));
  series.longRepair.push_back(bySteps.repair() * processes.count() / times);
  processes.requireSame(byWalks.answer());
  processes.requireSame(bySteps.answer());
  processes.onFirst([&] {
    Ride alone(what, nullptr, nullptr);
    const double start = vtkTimerLog::GetUniversalTime();
    alone.update();
    series.alone.push_back(vtkTimerLog::GetUniversalTime() - start);
    series.shooting.push_back(alone.shooting());
    series.repair.push_back(alone.repair() / times);
    series.fixed.push_back((series.alone.back() - alone.shooting() - alone.repair()) / times);
    if (alone.answer() != byWalks.answer() || alone.answer() != bySteps.answer())
    {
      throw std::runtime_error("The answers differ");
    }
  });
}

void runCase(const Processes& processes, const Case& what, int rounds)
{
  Series series;
  runRound(processes, what, series); // to warm up
  series = {};
  for (int round = 0; round < rounds; ++round)
  {
    runRound(processes, what, series);
  }
  if (!processes.isFirst())
  {
    return;
  }
  const std::string name = what.name();
  report("RanksOverTime", name, "1 process / by walks", ratios(series.alone, series.byWalks));
  report("RanksOverTime", name, "1 process / by steps", ratios(series.alone, series.bySteps));
  report("RanksOverTimeSeconds", name, "1 process, s", series.alone);
  report("RanksOverTimeSeconds", name, "by walks, s", series.byWalks);
  report("RanksOverTimeSeconds", name, "by steps, s", series.bySteps);
  report("RanksOverTimeCosts", name, "W0, ms", 1000 * medianOf(series.shooting));
  report("RanksOverTimeCosts", name, "F, ms", 1000 * medianOf(series.fixed));
  report("RanksOverTimeCosts", name, "W, ms", 1000 * medianOf(series.repair));
  report("RanksOverTimeCosts", name, "W by steps, ms", 1000 * medianOf(series.longRepair));
}

}

void run(const Arguments& arguments)
{
  const int rounds = arguments.number(0, 3);
  const Case one{ arguments.number(1, vtkIdType{ 0 }), arguments.number(2, 20),
    arguments.number(3, 32), arguments.number(4, 0.0) };
  const std::vector<Case> all{ { 1000000, 20, 4, 0 }, { 1000000, 20, 32, 0 }, { 100000, 20, 32, 0 },
    { 100000, 120, 32, 0 }, { 1000000, 120, 32, 0 }, { 1000000, 20, 4, 20 },
    { 1000000, 20, 32, 20 }, { 100000, 20, 32, 20 } };
  Processes processes;
  for (const Case& what : one.walks > 0 ? std::vector<Case>{ one } : all)
  {
    runCase(processes, what, rounds);
  }
  processes.finalize();
}
