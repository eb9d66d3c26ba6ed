// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_test_ThreadRanks_h
#define irradiance_test_ThreadRanks_h

#include "Execution/Execution.h"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace irradiance::test
{

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

#endif
