// SPDX-License-Identifier: BSD-3-Clause
/**
 * What a second process gains: vtkIrradianceFilter in a closed room, where a mesh of 20,000
 * triangles moves. Run by mpirun, one thread in each process, wall clock. By turns, round by round,
 * with new filters: all processes share the walks; the first process has them alone, without a
 * controller, and with a controller of one process. The others sleep meanwhile. Before any time
 * counts, all have to have the same bits.
 *
 * Arguments: [walks = 1000000] [rounds = 6]
 */
#include "../../FiltersIrradiance/TestScenes.h"
#include "Measuring/Processes.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Measuring/Rounds.h"

#include "vtkSMPTools.h"
#include "vtkTimerLog.h"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numeric>
#include <stdexcept>

using namespace TestScenes;

namespace
{

double peakMegabytes()
{
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
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

  void move() { scene_.Moving[0].Pose->Translate(0.05, 0.02, 0.01); }
  void update()
  {
    vtkSMPTools::LocalScope(
      vtkSMPTools::Config{ 1, "Sequential", false }, [this] { filter_->Update(); });
  }
  double cost(const char* name) const { return Field(filter_, name); }
  std::vector<double> answer() const
  {
    std::vector<double> values;
    for (const auto& [port, i] : { std::pair{ 0u, 0u }, { 0u, 1u }, { 1u, 0u } })
    {
      vtkDataArray* array = IrradianceOf(filter_, port, i);
      for (vtkIdType cell = 0; cell < array->GetNumberOfTuples(); ++cell)
      {
        values.push_back(array->GetTuple1(cell));
      }
    }
    return values;
  }

private:
  Scene scene_;
  vtkSmartPointer<vtkIrradianceFilter> filter_;
};

/// Two frames: the first, and one after a motion. Their seconds, round by round.
constexpr const char* kFrames[] = { "first frame", "update" };
using Series = std::array<std::vector<double>, 2>;

/// `secondsOf(job)` does the job; `look(frame)` may look at the room after each frame.
template <class SecondsOf, class Look>
void timeFrames(BallRoom& room, Series& series, const SecondsOf& secondsOf, const Look& look)
{
  for (std::size_t frame = 0; frame < series.size(); ++frame)
  {
    series[frame].push_back(secondsOf([&] { room.update(); }));
    look(frame);
    room.move();
  }
}

double secondsAlone(const std::function<void()>& job)
{
  const double start = vtkTimerLog::GetUniversalTime();
  job();
  return vtkTimerLog::GetUniversalTime() - start;
}

/// Largest over mean.
double imbalance(const std::vector<double>& values)
{
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  const double most = *std::max_element(values.begin(), values.end());
  return most * static_cast<double>(values.size()) / sum;
}

/// A frame of all processes together.
void reportShared(const Processes& processes, const BallRoom& room, std::size_t frame)
{
  const CountedReductions& reductions = processes.reductions();
  report("RanksReductions", kFrames[frame], "reductions", reductions.number);
  report("RanksReductions", kFrames[frame], "kB", reductions.bytes / 1000);
  report("RanksReductions", kFrames[frame], "ms with waiting", 1000 * reductions.seconds);
  static const std::vector<const char*> phases[] = { { "ShootSeconds" },
    { "VerifySeconds", "RepairSeconds" } };
  for (const char* phase : phases[frame])
  {
    report("RanksBalance", phase, "largest / mean", imbalance(processes.gather(room.cost(phase))));
  }
}

void reportMemory(const std::string& row, double historyBytes, double peak)
{
  report("RanksMemory", row, "history, MB", historyBytes / 1e6);
  report("RanksMemory", row, "peak of the process, MB", peak);
}

/// Sums of so many bytes of numbers, one after another.
void timeReductions(const Processes& processes, double bytes)
{
  constexpr int kTimes = 200;
  const std::vector<vtkTypeInt64> own(static_cast<std::size_t>(bytes) / sizeof(vtkTypeInt64), 1);
  std::vector<vtkTypeInt64> sums(own.size());
  const double seconds = processes.secondsOf([&] {
    for (int i = 0; i < kTimes; ++i)
    {
      processes.all()->AllReduce(
        own.data(), sums.data(), static_cast<vtkIdType>(own.size()), vtkCommunicator::SUM_OP);
    }
  });
  report("RanksLatency", std::to_string(std::lround(bytes)) + " bytes", "us a reduction",
    1e6 * seconds / kTimes);
}

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
    for (std::size_t frame = 0; frame < shared_.size() && processes_.isFirst(); ++frame)
    {
      const char* row = kFrames[frame];
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
      const auto together = [&](const auto& job) { return processes_.secondsOf(job); };
      timeFrames(room, shared_, together, [&](std::size_t frame) {
        isWarmUp ? void() : reportShared(processes_, room, frame);
        processes_.reductions().reset();
      });
      answer = room.answer();
      // The peak only grows, so it is read before one process has all walks.
      const auto histories = processes_.gather(room.cost("HistoryBytes"));
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
        timeFrames(room, isControlled ? controlled_ : alone_, secondsAlone, [](std::size_t) {});
        if (room.answer() != answer)
        {
          throw std::runtime_error("The answers differ");
        }
        isWarmUp ? reportMemory(isControlled ? "1 process with a controller" : "1 process",
                     room.cost("HistoryBytes"), peakMegabytes())
                 : void();
      }
    });
  }

  const Processes& processes_;
  vtkIdType walks_;
  Series shared_, alone_, controlled_;
};

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
  for (int round = 0; round < rounds; ++round)
  {
    timeReductions(processes, sizeof(vtkTypeInt64));
    timeReductions(processes, processes.reductions().largestBytes);
  }
  processes.finalize();
}
