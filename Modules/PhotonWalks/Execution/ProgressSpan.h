// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_ProgressSpan_h
#define irradiance_ProgressSpan_h

#include "Execution/Execution.h"

namespace irradiance
{

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

}

#endif
