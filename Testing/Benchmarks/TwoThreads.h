#ifndef TwoThreads_h
#define TwoThreads_h

#include "Execution/Execution.h"

#include <atomic>
#include <thread>

/// Two threads of the standard library, each of which takes the next item when it has done one.
class TwoThreads : public irradiance::Execution
{
public:
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
    std::thread second(work);
    work();
    second.join();
  }
};

#endif
