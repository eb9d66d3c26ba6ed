// SPDX-License-Identifier: BSD-3-Clause
#ifndef Processes_h
#define Processes_h

#include "vtkMPICommunicator.h"
#include "vtkMPIController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkSmartPointer.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

/// Counts what all processes sum up. The seconds have those in which one waits for another.
class CountedReductions : public vtkMPICommunicator
{
public:
  static CountedReductions* New() { VTK_STANDARD_NEW_BODY(CountedReductions); }
  vtkTypeMacro(CountedReductions, vtkMPICommunicator);

  int AllReduceVoidArray(
    const void* own, void* sum, vtkIdType length, int type, int operation) override
  {
    const double start = vtkTimerLog::GetUniversalTime();
    const int result = this->Superclass::AllReduceVoidArray(own, sum, length, type, operation);
    this->seconds += vtkTimerLog::GetUniversalTime() - start;
    const double size = static_cast<double>(length) * sizeof(vtkTypeInt64);
    this->bytes += size;
    this->largestBytes = std::max(this->largestBytes, size);
    ++this->number;
    return result;
  }

  void reset() { number = seconds = bytes = 0; }

  double number = 0, seconds = 0, bytes = 0;
  double largestBytes = 0; ///< of one, since the start
};
/// Those that mpirun has started.
class Processes
{
public:
  Processes()
  {
    int argc = 0;
    char** argv = nullptr;
    world_->Initialize(&argc, &argv);
    reductions_->CopyFrom(vtkMPICommunicator::GetWorldCommunicator());
    all_->SetCommunicator(reductions_);
    alone_.TakeReference(world_->PartitionController(own(), 0));
  }
  /// All have to call it. After an error it is left out, and mpirun ends the others.
  void finalize()
  {
    all_ = alone_ = nullptr; // they have communicators of their own
    world_->Finalize();
  }

  int own() const { return world_->GetLocalProcessId(); }
  int count() const { return world_->GetNumberOfProcesses(); }
  bool isFirst() const { return own() == 0; }
  vtkMPIController* all() const { return all_; }
  /// Of this process.
  vtkMPIController* alone() const { return alone_; }
  CountedReductions& reductions() const { return *reductions_; }

  /// Of each process.
  std::vector<double> gather(double value) const
  {
    std::vector<double> values(static_cast<std::size_t>(count()));
    world_->AllGather(&value, values.data(), 1);
    return values;
  }
  /// Throws unless all have the same.
  void requireSame(const std::vector<double>& values) const
  {
    std::vector<double> first = values;
    world_->Broadcast(first.data(), static_cast<vtkIdType>(first.size()), 0);
    if (first != values)
    {
      throw std::runtime_error("The answers of the processes differ");
    }
  }
  /// Until the slowest has done it.
  template <class Job>
  double secondsOf(const Job& job) const
  {
    world_->Barrier();
    const double start = vtkTimerLog::GetUniversalTime();
    job();
    world_->Barrier();
    return vtkTimerLog::GetUniversalTime() - start;
  }
  /// The others sleep, as a process that waits in MPI keeps its processor busy.
  template <class Job>
  void onFirst(const Job& job) const
  {
    constexpr int kTag = 1;
    char done = 1;
    if (isFirst())
    {
      job();
      for (int other = 1; other < count(); ++other)
      {
        world_->Send(&done, 1, other, kTag);
      }
      return;
    }
    for (int isThere = 0, from = 0; isThere == 0; world_->Iprobe(0, kTag, &isThere, &from))
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    world_->Receive(&done, 1, 0, kTag);
  }

private:
  vtkNew<vtkMPIController> world_;
  vtkNew<CountedReductions> reductions_;
  vtkSmartPointer<vtkMPIController> all_ = vtkSmartPointer<vtkMPIController>::New(), alone_;
};

#endif
