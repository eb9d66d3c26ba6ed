// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_test_ThreadExecution_h
#define irradiance_test_ThreadExecution_h

#include "Execution/Execution.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace irradiance::test
{

/// Threads of the standard library that take one item after the other.
class ThreadExecution : public Execution
{
public:
  explicit ThreadExecution(unsigned threads)
    : threads_(threads)
  {
  }

  void parallelFor(
    std::size_t count, const std::function<void(std::size_t, std::size_t)>& task) override
  {
    std::atomic<std::size_t> next{ 0 };
    const auto work = [&] {
      for (std::size_t i = next++; i < count; i = next++)
      {
        task(i, i + 1);
      }
    };
    std::vector<std::thread> helpers;
    for (unsigned i = 1; i < threads_; ++i)
    {
      helpers.emplace_back(work);
    }
    work();
    for (std::thread& helper : helpers)
    {
      helper.join();
    }
  }

private:
  unsigned threads_;
};

/// Serial, but from the last item to the first, in pieces of changing length.
class BackwardExecution : public Execution
{
public:
  void parallelFor(
    std::size_t count, const std::function<void(std::size_t, std::size_t)>& task) override
  {
    std::size_t length = 1;
    for (std::size_t end = count; end > 0; length = length % 3 + 1)
    {
      const std::size_t begin = end - std::min(length, end);
      task(begin, end);
      end = begin;
    }
  }
};

/// Serial; reportProgress returns false at call number `stopAt` (0: the first). By its clock
/// each cancel point takes 7 ms.
class StoppingExecution : public Execution
{
public:
  explicit StoppingExecution(int stopAt)
    : left_(stopAt)
  {
  }
  bool reportProgress(double /*progress*/) override { return left_-- != 0; }
  double slicingSeconds() const override { return 0.007 * ++calls_; }

private:
  int left_;
  mutable int calls_ = 0;
};

/// Its clock advances by a tick at every reading: with one thread a budget ends at the same walk
/// every time.
class TickingExecution : public ThreadExecution
{
public:
  static constexpr double kTick = 1e-3; ///< s

  explicit TickingExecution(unsigned threads = 1)
    : ThreadExecution(threads)
  {
  }
  double seconds() const override { return kTick * static_cast<double>(ticks_++); }
  std::int64_t ticks() const { return ticks_; }

private:
  mutable std::atomic<std::int64_t> ticks_{ 0 };
};

}

#endif
