// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SmpExecution_h
#define irradiance_SmpExecution_h

#include "Execution/Execution.h"

#include "vtkSMPTools.h"

#include <utility>

namespace irradiance
{

/// VTK's threads, and a function that reports progress and returns whether to continue.
class SmpExecution : public Execution
{
public:
  explicit SmpExecution(std::function<bool(double)> report)
    : report_(std::move(report))
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

private:
  std::function<bool(double)> report_;
};

}

#endif
