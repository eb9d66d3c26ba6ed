// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Execution/Execution.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <string>
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

/// Ranks that are threads of one process, each with an engine of its own.
class ThreadRanks
{
public:
  /// An execution for one of the ranks.
  class Rank
    : public Execution
    , public Ranks
  {
  public:
    Rank(ThreadRanks& all, std::uint32_t rank)
      : all_(all)
      , rank_(rank)
    {
    }
    std::uint32_t rank() const override { return rank_; }
    std::uint32_t count() const override { return all_.count_; }
    Ranks& ranks() override { return *this; }

  private:
    void allReduce(std::int64_t* numbers, std::size_t size) override
    {
      all_.allReduce(numbers, size);
    }

    ThreadRanks& all_;
    std::uint32_t rank_;
  };

  explicit ThreadRanks(std::uint32_t count)
    : count_(count)
  {
  }

  /// Calls work(rank) on each rank, and returns what it threw: empty, if nothing.
  template <class Work>
  std::vector<std::string> run(const Work& work)
  {
    std::vector<std::string> errors(count_);
    std::vector<std::thread> threads;
    for (std::uint32_t i = 0; i < count_; ++i)
    {
      threads.emplace_back([this, i, &work, &errors] {
        Rank rank(*this, i);
        try
        {
          rank.together([&] { work(rank); });
        }
        catch (const std::exception& error)
        {
          errors[i] = error.what();
        }
      });
    }
    for (std::thread& thread : threads)
    {
      thread.join();
    }
    return errors;
  }

private:
  void allReduce(std::int64_t* numbers, std::size_t size)
  {
    std::unique_lock<std::mutex> lock(mutex_);
    const std::size_t mine = turn_;
    sum_.resize(arrived_ == 0 ? 0 : sum_.size());
    sum_.resize(size);
    for (std::size_t i = 0; i < size; ++i)
    {
      sum_[i] += static_cast<std::uint64_t>(numbers[i]);
    }
    if (++arrived_ == count_)
    {
      done_ = sum_;
      sum_.clear();
      arrived_ = 0;
      ++turn_;
      changed_.notify_all();
    }
    changed_.wait(lock, [&] { return turn_ != mine; });
    for (std::size_t i = 0; i < size; ++i)
    {
      numbers[i] = static_cast<std::int64_t>(done_[i]);
    }
  }

  std::uint32_t count_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::uint32_t arrived_ = 0;
  std::size_t turn_ = 0;
  std::vector<std::uint64_t> sum_, done_;
};

}
