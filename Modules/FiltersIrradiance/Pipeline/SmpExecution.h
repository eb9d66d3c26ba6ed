// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SmpExecution_h
#define irradiance_SmpExecution_h

#include "Execution/Execution.h"

#include "vtkSMPTools.h"

#include <utility>

namespace irradiance
{

/// VTK's threads, a function that reports progress and returns whether to continue, and ranks.
class SmpExecution : public Execution
{
public:
  /// `ranks` must outlive it; null: alone.
  explicit SmpExecution(std::function<bool(double)> report, Ranks* ranks = nullptr)
    : report_(std::move(report))
    , ranks_(ranks)
  {
  }

  void parallelFor(
    std::size_t count, const std::function<void(std::size_t, std::size_t)>& task) override
  {
    auto range = [&task](vtkIdType begin, vtkIdType end) {
      task(static_cast<std::size_t>(begin), static_cast<std::size_t>(end));
    };
    vtkSMPTools::For(0, static_cast<vtkIdType>(count), 1, range);
  }

  bool reportProgress(double progress) override { return report_(progress); }

  Ranks& ranks() override { return ranks_ ? *ranks_ : Execution::ranks(); }

private:
  std::function<bool(double)> report_;
  Ranks* ranks_;
};

}

#endif
