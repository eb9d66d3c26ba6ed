// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Execution/Execution.h"

#include "vtkObject.h"
#include "vtkSMPTools.h"

#include <functional>
#include <set>
#include <string>
#include <utility>

class vtkAlgorithm;
class vtkDataObject;
class vtkExecutive;
class vtkInformation;

namespace irradiance
{

/// Names of a filter's public face that work for one more release. Each filter warns once of each
/// name that is used.
class OldNames
{
public:
  /// `what` to do instead: "set Method".
  void warn(vtkObject* filter, const std::string& name, const std::string& what)
  {
    if (warned_.insert(name).second)
    {
      vtkWarningWithObjectMacro(filter, << name << " will go: " << what);
    }
  }

private:
  std::set<std::string> warned_;
};

/// Has an input port take data of these types. Composite ones come first: else the executive would
/// call the filter for each block separately. vtkDataObject: the filter refuses other data itself,
/// once and in words that help. Returns 1, as FillInputPortInformation() does.
int setInputTypes(vtkInformation* port, const char* composite, const char* other);

/// The value of a property. Throws InputError unless `low` <= value <= `high`.
std::uint32_t checked(const char* name, vtkIdType value, vtkIdType low, vtkIdType high);

/// Throws InputError unless `low` <= value <= `high`; VTK_DOUBLE_MAX: whatever is finite.
void checkWithin(const char* name, double value, double low, double high);

/// The latest change of anything upstream of an input. Other than the times of data it does not
/// change with the time that is asked for.
vtkMTimeType upstreamTime(vtkAlgorithm* filter, int port, int connection);

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

/// VTK's threads, and the filter's progress and abort.
SmpExecution executionOf(vtkAlgorithm* filter, Ranks* ranks = nullptr);

/// Forgets an abort of an earlier run, as the executive does before RequestData. For long work
/// elsewhere.
void forgetAbort(vtkAlgorithm* filter);

/// The executive of a filter that works with other processes. If something upstream fails, VTK does
/// not call the filter, and the others would wait for it: so `upstreamFailed` is called in place of
/// RequestData().
vtkExecutive* newRanksPipeline(std::function<void()> upstreamFailed);

/// What RequestData does: lets `compute` fill the output, which is empty at first. After an abort
/// or an exception it is empty again. Returns 0 after an exception, which becomes one error of the
/// filter, else 1. If an input is what another filter failed to compute, the output is empty
/// without a word: that filter has said why, and an empty input would only give errors, or light,
/// that mislead. All `ranks` have to run it; if one fails, all do.
int runFilter(vtkAlgorithm* filter, vtkDataObject* output, const std::function<void()>& compute,
  Ranks* ranks = nullptr);

}
