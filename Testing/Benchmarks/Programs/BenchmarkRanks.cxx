// SPDX-License-Identifier: BSD-3-Clause
/**
 * What a second process gains: vtkIrradianceFilter in a closed room, where a mesh of 20,000
 * triangles moves. Run by mpirun, one thread in each process, wall clock. By turns, round by round,
 * with new filters: all processes share the walks; the first process has them alone, without a
 * controller, and with a controller of one process. The others sleep meanwhile. Before any time
 * counts, all have to have the same bits.
 *
 * RanksOverTime: how processes best share a dose, by walks or by whole time steps. A ball rides
 * once across a room, and its dose is integrated over uniform steps. Some cases have a filter
 * upstream that works for some milliseconds at each time, as a reader or a simulation would.
 *
 * Arguments: [walks = 1000000] [rounds = 6]
 */
#include "../../FiltersIrradiance/TestScenes.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Measuring/Rounds.h"

#include "vtkKeyFramedPose.h"
#include "vtkMPIController.h"
#include "vtkObjectFactory.h"
#include "vtkProgrammableFilter.h"
#include "vtkRadiantExposureFilter.h"
#include "vtkSMPTools.h"
#include "vtkTimerLog.h"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <stdexcept>
#include <thread>

using namespace TestScenes;

namespace
{

/// Those that mpirun has started.
class Processes
{
public:
  Processes()
  {
    int argc = 0;
    char** argv = nullptr;
    all_->Initialize(&argc, &argv);
    alone_.TakeReference(all_->PartitionController(all_->GetLocalProcessId(), 0));
  }
  /// All have to call it. After an error it is left out, and mpirun ends the others.
  void finalize()
  {
    alone_ = nullptr; // it has a communicator of its own
    all_->Finalize();
  }

  int count() const { return all_->GetNumberOfProcesses(); }
  bool isFirst() const { return all_->GetLocalProcessId() == 0; }
  vtkMPIController* all() const { return all_; }
  /// Of this process.
  vtkMPIController* alone() const { return alone_; }

  /// Of each process.
  std::vector<double> gather(double value) const
  {
    std::vector<double> values(static_cast<std::size_t>(count()));
    all_->AllGather(&value, values.data(), 1);
    return values;
  }
  /// Throws unless all have the same.
  void requireSame(const std::vector<double>& values) const
  {
    std::vector<double> first = values;
    all_->Broadcast(first.data(), static_cast<vtkIdType>(first.size()), 0);
    require(first == values);
  }
  static void require(bool isSame)
  {
    if (!isSame)
    {
      throw std::runtime_error("The answers of the processes differ");
    }
  }
  /// Until the slowest has done it.
  double secondsOf(const std::function<void()>& job) const
  {
    all_->Barrier();
    const double start = vtkTimerLog::GetUniversalTime();
    job();
    all_->Barrier();
    return vtkTimerLog::GetUniversalTime() - start;
  }
  /// The others sleep, as a process that waits in MPI keeps its processor busy.
  void onFirst(const std::function<void()>& job) const
  {
    constexpr int kTag = 1;
    char done = 1;
    if (isFirst())
    {
      job();
      for (int other = 1; other < count(); ++other)
      {
        all_->Send(&done, 1, other, kTag);
      }
      return;
    }
    for (int isThere = 0, from = 0; isThere == 0; all_->Iprobe(0, kTag, &isThere, &from))
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    all_->Receive(&done, 1, 0, kTag);
  }

private:
  vtkNew<vtkMPIController> all_;
  vtkSmartPointer<vtkMPIController> alone_;
};

double secondsAlone(const std::function<void()>& job)
{
  const double start = vtkTimerLog::GetUniversalTime();
  job();
  return vtkTimerLog::GetUniversalTime() - start;
}

void updateOnOneThread(vtkAlgorithm* algorithm)
{
  vtkSMPTools::LocalScope(
    vtkSMPTools::Config{ 1, "Sequential", false }, [algorithm] { algorithm->Update(); });
}

void append(vtkDataArray* array, std::vector<double>& values)
{
  for (vtkIdType cell = 0; cell < array->GetNumberOfTuples(); ++cell)
  {
    values.push_back(array->GetTuple1(cell));
  }
}

double peakMegabytes()
{
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

void reportMemory(const std::string& row, double historyBytes, double peak)
{
  report("RanksMemory", row, "history, MB", historyBytes / 1e6);
  report("RanksMemory", row, "peak of the process, MB", peak);
}

/// A room in which a ball moves, and a new filter for it.
class BallRoom
{
public:
  BallRoom(vtkIdType walks, vtkMPIController* controller)
    : scene_{ { MakeRoom(4, 20), MakeLamp({ 2, 2, 3.8 }, 1, { 100 }) },
      { MakeMoving(MakeBall(0.5, 100), { 1.5, 2, 1.5 }) } }
    , filter_(MakeFilter(scene_, walks))
  {
    filter_->SetController(controller);
  }

  /// Two frames: the first, and one after a motion. Adds their seconds. `secondsOf(job)` does the
  /// job.
  template <class SecondsOf>
  void timeFrames(std::array<std::vector<double>, 2>& series, const SecondsOf& secondsOf)
  {
    for (std::vector<double>& seconds : series)
    {
      seconds.push_back(secondsOf([&] { updateOnOneThread(filter_); }));
      scene_.Moving[0].Pose->Translate(0.05, 0.02, 0.01);
    }
  }
  double historyBytes() const { return Field(filter_, "HistoryBytes"); }
  std::vector<double> answer() const
  {
    std::vector<double> values;
    for (const auto& [port, i] : { std::pair{ 0u, 0u }, { 0u, 1u }, { 1u, 0u } })
    {
      append(IrradianceOf(filter_, port, i), values);
    }
    return values;
  }

private:
  Scene scene_;
  vtkSmartPointer<vtkIrradianceFilter> filter_;
};

class Contest
{
public:
  Contest(const Processes& processes, vtkIdType walks)
    : processes_(processes)
    , walks_(walks)
  {
  }

  void run(int rounds)
  {
    runRound(-1);
    shared_ = alone_ = controlled_ = {};
    for (int round = 0; round < rounds; ++round)
    {
      runRound(round);
    }
    const std::string number = std::to_string(processes_.count());
    static constexpr Goal goals[] = { { 1.7, 1.95 }, { 1.6, 1.9 } }; // of two processes
    static constexpr const char* rows[] = { "first frame", "update" };
    for (std::size_t frame = 0; frame < shared_.size() && processes_.isFirst(); ++frame)
    {
      const char* row = rows[frame];
      report("Ranks", row, "1 process / " + number, ratios(alone_[frame], shared_[frame]),
        processes_.count() == 2 ? goals[frame] : Goal{});
      report("Ranks", row, "controller of 1 process / none",
        ratios(controlled_[frame], alone_[frame]), { 1.02, 1.00 });
      report("RanksSeconds", row, "1 process, s", alone_[frame]);
      report("RanksSeconds", row, number + " processes, s", shared_[frame]);
    }
  }

private:
  /// Round -1 warms up.
  void runRound(int round)
  {
    const bool isWarmUp = round < 0;
    std::vector<double> answer;
    {
      BallRoom room(walks_, processes_.all());
      room.timeFrames(shared_, [&](const auto& job) { return processes_.secondsOf(job); });
      answer = room.answer();
      // The peak only grows, so it is read before one process has all walks.
      const auto histories = processes_.gather(room.historyBytes());
      const auto peaks = processes_.gather(peakMegabytes());
      for (std::size_t i = 0; i < peaks.size() && isWarmUp; ++i)
      {
        const std::string row =
          "process " + std::to_string(i) + " of " + std::to_string(peaks.size());
        reportMemory(row, histories[i], peaks[i]);
      }
    }
    processes_.requireSame(answer);
    processes_.onFirst([&] {
      for (const bool isControlled : { round % 2 == 0, round % 2 != 0 }) // the first one is slower
      {
        BallRoom room(walks_, isControlled ? processes_.alone() : nullptr);
        room.timeFrames(isControlled ? controlled_ : alone_, secondsAlone);
        Processes::require(room.answer() == answer);
        if (isWarmUp)
        {
          reportMemory(isControlled ? "1 process with a controller" : "1 process",
            room.historyBytes(), peakMegabytes());
        }
      }
    });
  }

  const Processes& processes_;
  vtkIdType walks_;
  std::array<std::vector<double>, 2> shared_, alone_, controlled_; ///< [frame][round]
};

struct DoseCase
{
  vtkIdType walks;
  int rows;        ///< of cells, on each wall
  double upstream; ///< ms at each time
};

constexpr int kSteps = 32;

/// A room through which a ball rides, and its dose by new filters.
class Ride
{
public:
  Ride(const DoseCase& what, vtkMPIController* ofWalks, vtkMPIController* ofTimes)
    : what_(what)
    , irradiance_(MakeFilter(
        { { MakeRoom(4, what.rows), MakeLamp({ 2, 2, 3.8 }, 1, { 100 }) }, {} }, what.walks))
  {
    pose_->SetInputData(MakeBall(0.3, 24));
    pose_->AddPose(0, 1, 1.5, 1.5, 0, 0, 0);
    pose_->AddPose(1, 3, 1.5, 1.5, 0, 0, 0);
    worker_->SetInputConnection(pose_->GetOutputPort());
    worker_->SetExecuteMethod([](void* ride) { static_cast<Ride*>(ride)->work(); }, this);
    irradiance_->AddInputConnection(1, worker_->GetOutputPort());
    irradiance_->SetController(ofWalks);
    dose_->SetInputConnection(irradiance_->GetOutputPort());
    dose_->SetController(ofTimes);
    dose_->SetIntegrationModeToUniform();
    dose_->SetNumberOfTimeSteps(kSteps);
  }
  Ride(const Ride&) = delete;
  Ride& operator=(const Ride&) = delete;

  void update() { updateOnOneThread(dose_); }
  std::vector<double> answer()
  {
    std::vector<double> values;
    auto* output = vtkMultiBlockDataSet::SafeDownCast(dose_->GetOutputDataObject(0));
    for (const unsigned int port : { 0u, 1u })
    {
      append(OutputOf(output, port, 0)->GetCellData()->GetArray("RadiantExposure"), values);
    }
    return values;
  }

private:
  /// Passes the input on after some time.
  void work()
  {
    const double end = threadCpuSeconds() + what_.upstream / 1000;
    while (threadCpuSeconds() < end)
    {
    }
    worker_->GetPolyDataOutput()->ShallowCopy(worker_->GetPolyDataInput());
  }

  DoseCase what_;
  vtkNew<vtkKeyFramedPose> pose_;
  vtkNew<vtkProgrammableFilter> worker_;
  vtkSmartPointer<vtkIrradianceFilter> irradiance_;
  vtkNew<vtkRadiantExposureFilter> dose_;
};

/// A round more than these warms up.
void compareDoses(const Processes& processes, const DoseCase& what, int rounds)
{
  std::vector<double> alone, byWalks, byTimes;
  for (int round = -1; round < rounds; ++round)
  {
    Ride walks(what, processes.all(), nullptr), times(what, nullptr, processes.all());
    const double ofWalks = processes.secondsOf([&] { walks.update(); }),
                 ofTimes = processes.secondsOf([&] { times.update(); });
    processes.requireSame(walks.answer());
    processes.requireSame(times.answer());
    processes.onFirst([&] {
      Ride one(what, nullptr, nullptr);
      const double ofOne = secondsAlone([&] { one.update(); });
      Processes::require(one.answer() == walks.answer() && one.answer() == times.answer());
      if (round >= 0)
      {
        alone.push_back(ofOne);
        byWalks.push_back(ofWalks);
        byTimes.push_back(ofTimes);
      }
    });
  }
  const std::string row = std::to_string(what.walks) + " walks, " +
    std::to_string(6 * what.rows * what.rows) + " cells, " + std::to_string(kSteps + 1) +
    " times, " + std::to_string(std::lround(what.upstream)) + " ms upstream";
  report("RanksOverTime", row, "1 process / by walks", ratios(alone, byWalks));
  report("RanksOverTime", row, "1 process / by times", ratios(alone, byTimes));
}

}

void run(const Arguments& arguments)
{
  const auto walks = arguments.number(0, vtkIdType{ 1000000 });
  const int rounds = arguments.number(1, 6);
  Processes processes;
  if (!processes.isFirst() && !std::freopen("/dev/null", "w", stdout))
  {
    throw std::runtime_error("Only the first process may write");
  }
  Contest(processes, walks).run(rounds);
  for (const DoseCase& what : { DoseCase{ walks, 20, 0 }, { walks / 10, 20, 0 },
         { walks / 10, 120, 0 }, { walks, 20, 20 }, { walks / 10, 20, 20 } })
  {
    compareDoses(processes, what, std::max(1, rounds / 3));
  }
  processes.finalize();
}
