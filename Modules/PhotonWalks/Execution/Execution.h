// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Execution/Ranks.h"
#include "Progress/CancelPoint.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace irradiance
{

/// The monotonic clock of this machine.
inline double steadySeconds()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Gives the engine its threads and ranks, and takes its reports of progress. This one is serial,
/// alone and silent.
class Execution
{
public:
  virtual ~Execution() = default;

  /// Calls `task(begin, end)` for ranges that make up [0, count), in any order and possibly at the
  /// same time. `task` does not throw.
  virtual void parallelFor(
    std::size_t count, const std::function<void(std::size_t, std::size_t)>& task)
  {
    task(0, count);
  }

  /// Is called every few hundredths of a second, on the thread that called the engine. `progress`
  /// is 0..1. Returning false stops the engine.
  virtual bool reportProgress(double /*progress*/) { return true; }

  /// The monotonic clock, in seconds, by which a time budget is kept. Many threads call it.
  virtual double seconds() const { return steadySeconds(); }

  /// The one by which work is cut into slices, between which it reports progress.
  virtual double slicingSeconds() const { return steadySeconds(); }

  /// With whom the work is shared.
  virtual Ranks& ranks() { return alone_; }

private:
  Ranks alone_;
};

/// Execution::reportProgress() returned false.
class Interrupted : public std::exception
{
public:
  const char* what() const noexcept override { return "interrupted"; }
};

/// A cancel point that may be called often. At most every 20 ms it reports `progress`, and throws
/// Interrupted if the report returns false. `execution` must outlive it.
inline CancelPoint cancelPointOf(Execution& execution, double progress)
{
  return [&execution, progress, last = execution.slicingSeconds()]() mutable {
    const double now = execution.slicingSeconds();
    if (now - last < 0.02)
    {
      return;
    }
    last = now;
    if (!execution.reportProgress(progress))
    {
      throw Interrupted();
    }
  };
}

/// A part of the work: its progress 0..1 counts as `from`..`to` of the whole.
class ProgressSpan : public Execution
{
public:
  /// `whole` must outlive the part.
  ProgressSpan(Execution& whole, double from, double to)
    : whole_(whole)
    , from_(from)
    , to_(to)
  {
  }

  void parallelFor(
    std::size_t count, const std::function<void(std::size_t, std::size_t)>& task) override
  {
    whole_.parallelFor(count, task);
  }

  bool reportProgress(double progress) override
  {
    return whole_.reportProgress(progress == 1 ? to_ : from_ + progress * (to_ - from_));
  }

  double seconds() const override { return whole_.seconds(); }
  double slicingSeconds() const override { return whole_.slicingSeconds(); }

  Ranks& ranks() override { return whole_.ranks(); }

private:
  Execution& whole_;
  double from_, to_;
};

/// Calls work(i, execution) for i in [0, parts), each with an equal part of the progress.
template <class Work>
void inParts(std::size_t parts, Execution& execution, const Work& work)
{
  const auto count = static_cast<double>(parts);
  for (std::size_t i = 0; i < parts; ++i)
  {
    const auto number = static_cast<double>(i);
    ProgressSpan span(execution, number / count, (number + 1) / count);
    work(i, span);
  }
}

/// Time that several threads may spend on items whose cost is only learnt by doing them.
class TimeBudget
{
public:
  /// Begins now. `seconds` may be infinite.
  TimeBudget(const Execution& execution, double seconds)
    : execution_(execution)
    , begin_(execution.seconds())
    , end_(begin_ + seconds)
  {
  }

  double now() const { return execution_.seconds(); }
  double elapsed() const { return now() - begin_; }
  /// How many items, at most `most`, a thread should begin together: by the mean cost so far they
  /// take half of the time that is left. 0 if that does not suffice for one.
  std::size_t itemsToBegin(std::size_t most) const
  {
    constexpr std::size_t kToLearn = 16; // while no cost is known
    const double left = end_ - now();
    if (!(left > 0))
    {
      return 0;
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    if (items_ == 0)
    {
      return std::min(kToLearn, most);
    }
    const double affordable = 0.5 * left * items_;
    return affordable < static_cast<double>(most) * spent_
      ? static_cast<std::size_t>(affordable / spent_)
      : most;
  }
  /// Records what items have cost the thread that did them.
  void spend(double seconds, std::size_t items)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    spent_ += seconds;
    items_ += static_cast<double>(items);
  }

private:
  const Execution& execution_;
  double begin_, end_;
  mutable std::mutex mutex_;
  double spent_ = 0;
  double items_ = 0;
};

/// Works on units with the threads of an execution, in slices of 30 ms, between which it reports
/// progress from 0 to 1. The result does not depend on the cuts. `work` returns whether a unit is
/// done, or its slice was over before. Throws Interrupted, and what `work` throws.
inline void runSliced(std::size_t units, Execution& execution,
  const std::function<bool(std::size_t unit, const std::function<bool()>& hasToStop)>& work)
{
  std::vector<char> isDone(units, 0);
  std::size_t first = 0; // unit that is not done yet
  while (first < units)
  {
    const std::function<bool()> hasToStop = [&, end = execution.slicingSeconds() + 0.03] {
      return execution.slicingSeconds() >= end;
    };
    std::mutex mutex;
    std::exception_ptr error;
    execution.parallelFor(units - first, [&](std::size_t begin, std::size_t end) {
      try
      {
        for (std::size_t i = first + begin; i < first + end && !hasToStop(); ++i)
        {
          isDone[i] = isDone[i] != 0 || work(i, hasToStop) ? 1 : 0;
        }
      }
      catch (...)
      {
        const std::lock_guard<std::mutex> lock(mutex);
        error = std::current_exception();
      }
    });
    if (error)
    {
      std::rethrow_exception(error);
    }
    first = static_cast<std::size_t>(
      std::find(isDone.begin() + static_cast<std::ptrdiff_t>(first), isDone.end(), 0) -
      isDone.begin());
    const auto done = static_cast<double>(std::count(isDone.begin(), isDone.end(), 1));
    if (!execution.reportProgress(done / static_cast<double>(units)))
    {
      throw Interrupted();
    }
  }
}

/// The same for small units, each done at once: work(unit).
template <class Work>
void forEachSliced(std::size_t units, Execution& execution, const Work& work)
{
  runSliced(units, execution, [&](std::size_t unit, const auto&) {
    work(unit);
    return true;
  });
}

/// Things that own much memory, to be used again by any thread: one at a time for each.
template <class Thing>
class Pool
{
public:
  /// As it was given back, or new.
  std::unique_ptr<Thing> take()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (things_.empty())
    {
      return std::make_unique<Thing>();
    }
    std::unique_ptr<Thing> thing = std::move(things_.back());
    things_.pop_back();
    return thing;
  }
  void giveBack(std::unique_ptr<Thing> thing)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    things_.push_back(std::move(thing));
  }

private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Thing>> things_;
};

}
