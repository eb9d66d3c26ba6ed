// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Checkpoint_h
#define irradiance_Checkpoint_h

#include <cstddef>
#include <functional>

namespace irradiance
{

/// Long work calls it from time to time; it throws to stop the work. May be empty.
using Checkpoint = std::function<void()>;

/// Calls a checkpoint once every few thousand steps of a loop.
class CheckpointPace
{
public:
  /// `checkpoint` must outlive the pace.
  explicit CheckpointPace(const Checkpoint& checkpoint)
    : checkpoint_(checkpoint)
  {
  }

  void step(std::size_t steps = 1)
  {
    constexpr std::size_t kStepsBetween = 4096;
    steps_ += steps;
    if (steps_ >= kStepsBetween && checkpoint_)
    {
      steps_ = 0;
      checkpoint_();
    }
  }

private:
  const Checkpoint& checkpoint_;
  std::size_t steps_ = 0;
};

}

#endif
