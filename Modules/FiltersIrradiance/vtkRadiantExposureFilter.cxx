// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadiantExposureFilter.h"

#include "Data/NamedArray.h"
#include "Output/EmptyPiece.h"
#include "Pipeline/ControllerRanks.h"
#include "Pipeline/FilterRun.h"
#include "Pipeline/UpstreamRequest.h"
#include "Progress/InputError.h"
#include "Surfaces/SceneHash.h"
#include "Time/ExposureIntegral.h"
#include "Time/TimeKeys.h"

#include "vtkAlgorithmOutput.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

using namespace irradiance;

vtkStandardNewMacro(vtkRadiantExposureFilter);

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

/// What the result depends on, except what happens upstream.
struct Settings
{
  int Mode, NumberOfTimeSteps, MaximumNumberOfTimeSteps, NumberOfSpreadPhotons;
  double RelativeTolerance;
  TimeSpan Span;
  std::array<int, 3> Piece; ///< number, of how many, ghost levels

  /// All that ranks have to agree on.
  auto Shared() const
  {
    return std::tie(Mode, NumberOfTimeSteps, MaximumNumberOfTimeSteps, NumberOfSpreadPhotons,
      RelativeTolerance, Span.start, Span.end);
  }
  bool operator==(const Settings& other) const
  {
    return Shared() == other.Shared() && Piece == other.Piece;
  }
};

bool IsErrorControlled(int mode)
{
  return mode == vtkRadiantExposureFilter::ErrorControlled ||
    mode == vtkRadiantExposureFilter::Automatic;
}

Settings CheckedSettings(vtkRadiantExposureFilter* filter, vtkInformation* input)
{
  Settings settings{ filter->GetIntegrationMode(), filter->GetNumberOfTimeSteps(),
    filter->GetMaximumNumberOfTimeSteps(), filter->GetNumberOfSpreadPhotons(),
    filter->GetRelativeTolerance(), timeSpan(input, filter->GetStartTime(), filter->GetEndTime()),
    { input->Get(Pipeline::UPDATE_PIECE_NUMBER()), input->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()),
      input->Get(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS()) } };
  constexpr vtkIdType most = 1000000;
  checked("NumberOfTimeSteps", settings.NumberOfTimeSteps, 1, most);
  checked("NumberOfSpreadPhotons", settings.NumberOfSpreadPhotons, 0, most);
  const bool isControlled = IsErrorControlled(settings.Mode);
  throwIf(
    isControlled && !(settings.RelativeTolerance > 0 && std::isfinite(settings.RelativeTolerance)),
    "RelativeTolerance is ", settings.RelativeTolerance, "; it has to be positive");
  throwIf(isControlled && settings.MaximumNumberOfTimeSteps < settings.NumberOfTimeSteps,
    "MaximumNumberOfTimeSteps is ", settings.MaximumNumberOfTimeSteps, ", but NumberOfTimeSteps, ",
    settings.NumberOfTimeSteps, ", is the least for error control");
  return settings;
}

std::unique_ptr<ExposureIntegral> MakeIntegral(const Settings& settings, vtkInformation* input)
{
  if (IsErrorControlled(settings.Mode))
  {
    return errorControlledIntegral(
      firstTimes(stepsOf(input), settings.Span, settings.NumberOfTimeSteps),
      settings.RelativeTolerance, settings.MaximumNumberOfTimeSteps);
  }
  return integralOver(settings.Mode == vtkRadiantExposureFilter::TimeSteps
      ? stepTimes(input, settings.Span)
      : uniformTimes(settings.Span, settings.NumberOfTimeSteps));
}

void AddTimes(const ExposureIntegral& integral, vtkFieldData* fields)
{
  const std::vector<double>& times = integral.times();
  const auto count = static_cast<vtkIdType>(times.size());
  const auto addNumber = [fields](const char* name, double number) {
    addTuple<vtkDoubleArray>(fields, name, { number });
  };
  addNumber("StartTime", times.front());
  addNumber("EndTime", times.back());
  addTuple<vtkIdTypeArray>(fields, "NumberOfTimeSteps", { count - 1 });
  addColumn(fields, "IntegrationTimes", times);
  if (!std::isnan(integral.relativeError()))
  {
    addNumber("TimeIntegrationError", integral.relativeError());
    addNumber("TimeIntegrationNoise", integral.relativeNoise());
  }
}

}

/**
 * VTK has a way to execute a filter once for each time, CONTINUE_EXECUTING, which
 * vtkTemporalStatistics takes. If upstream fails at a later time, the executive of VTK 9.1 and its
 * like then asks for ever. So a run asks for the first time as that does, in RequestUpdateExtent,
 * and updates the producer for the others, in RequestData.
 *
 * Ranks visit as many times at once as there are ranks, one time each. Then each rank takes the
 * data of all of these, in the order of time: the sums are those of one rank alone.
 */
class vtkRadiantExposureFilter::vtkInternals
{
public:
  explicit vtkInternals(vtkRadiantExposureFilter* filter)
    : Filter(filter)
  {
  }

  /// Continues what an abort left, if that is still what is asked for, and asks for the next time.
  void Prepare()
  {
    const ControllerRanks ranks = this->GetRanks();
    vtkInformation* input = this->Input();
    if (ranks.areSeveral())
    {
      requestWhole(input);
      this->Forget(); // after an abort not all may have come as far
    }
    request(input, UpstreamRequest::Alone, ranks.areSeveral());
    request(input, UpstreamRequest::Replicates);
    if (!this->IsUpToDate())
    {
      this->Begin();
    }
    // With more ranks than times, some have no time of their own. They ask for the last one, as VTK
    // updates what is upstream in any case; its result is not used.
    const double last = this->NextTimes(ranks).back();
    input->Set(Pipeline::UPDATE_TIME_STEP(), this->OwnTime(ranks).value_or(last));
  }

  void Run(ControllerRanks& ranks, vtkDataObject* output)
  {
    SmpExecution execution = executionOf(this->Filter);
    this->Agree(ranks);
    this->Take(ranks);
    while (!this->Integral->isDone())
    {
      if (!execution.reportProgress(this->Integral->progress()))
      {
        throw Interrupted();
      }
      if (this->HasChanged(ranks))
      {
        this->Producer->UpdateInformation();
        this->Begin();
        this->Agree(ranks);
      }
      this->UpdateProducer(ranks);
      this->Take(ranks);
    }
    if (this->Of.NumberOfSpreadPhotons > 0)
    {
      ProgressSpan end(execution, 1, 1);
      this->Integral->sums().spread(this->Of.NumberOfSpreadPhotons, end);
    }
    this->Write(output);
    if (ranks.areSeveral() && isEmptyPieceRequested(this->Filter->GetOutputInformation(0)))
    {
      removeElements(output);
    }
  }

  /// Asks for nothing more: others need not pay for it.
  void End() const
  {
    request(this->Input(), UpstreamRequest::Replicates, false);
    request(this->Input(), UpstreamRequest::Alone, false);
  }

  void Forget() { this->Integral = nullptr; }
  ControllerRanks GetRanks() const { return ControllerRanks(this->Filter->GetController()); }

  std::string Error; ///< found before the data were asked for

private:
  vtkInformation* Input() const { return this->Filter->GetInputInformation(0, 0); }

  bool IsUpToDate() const
  {
    return this->Integral && !this->Integral->isDone() &&
      this->Producer == this->Filter->GetInputExecutive(0, 0) &&
      this->Upstream == upstreamTime(this->Filter, 0, 0) &&
      this->Of == CheckedSettings(this->Filter, this->Input());
  }

  void Begin()
  {
    vtkInformation* input = this->Input();
    this->Forget();
    this->Of = CheckedSettings(this->Filter, input);
    this->Integral = MakeIntegral(this->Of, input);
    this->MayBeAtSteps = this->Of.Mode == Automatic;
    this->Probe = this->MayBeAtSteps ? timeBetweenSteps(input, this->Of.Span) : std::nullopt;
    this->Producer = this->Filter->GetInputExecutive(0, 0);
    this->Upstream = upstreamTime(this->Filter, 0, 0);
  }

  /// Whether an observer has changed something. Throws RankFailed if only some have.
  bool HasChanged(Ranks& ranks) const
  {
    const bool hasChanged = !this->IsUpToDate();
    ranks.expectSame(hasChanged ? 1 : 0, "something was changed meanwhile, or not,");
    return hasChanged;
  }

  void Agree(Ranks& ranks) const
  {
    if (ranks.areSeveral())
    {
      Hash hash;
      std::apply([&](const auto&... all) { hash.add(all...); }, this->Of.Shared());
      hash.add(stepsOf(this->Input()));
      ranks.expectSame(hash.value(), "other settings or times than on the first process");
    }
  }

  /// Those that the ranks visit together, one each.
  std::vector<double> NextTimes(const Ranks& ranks) const
  {
    return this->Probe ? std::vector<double>(ranks.count(), *this->Probe)
                       : this->Integral->nextTimes(ranks.count());
  }

  /// None if there are fewer than ranks.
  std::optional<double> OwnTime(const Ranks& ranks) const
  {
    const std::vector<double> times = this->NextTimes(ranks);
    return ranks.rank() < times.size() ? std::optional<double>(times[ranks.rank()]) : std::nullopt;
  }

  void UpdateProducer(const Ranks& ranks) const
  {
    if (const std::optional<double> time = this->OwnTime(ranks))
    {
      this->Input()->Set(Pipeline::UPDATE_TIME_STEP(), *time);
      throwIf(!this->Producer->Update(this->Filter->GetInputConnection(0, 0)->GetIndex()),
        "the input could not be computed at time ", *time, ", see its own error");
    }
  }

  void Take(ControllerRanks& ranks)
  {
    const std::optional<double> time = this->OwnTime(ranks);
    vtkDataObject* data = this->Filter->GetInputDataObject(0, 0);
    if (data->GetNumberOfElements(vtkDataObject::CELL) == 0 && forgetAborted(this->Producer))
    {
      // SetAbortExecute() is a modification for VTK.
      this->Upstream = upstreamTime(this->Filter, 0, 0);
      throw Interrupted();
    }
    const bool isProbe = this->Probe.has_value();
    this->Probe.reset();
    const bool isAtSteps = time && this->MayBeAtSteps &&
      comesAtStepsOnly(
        this->Producer, this->Filter->GetInputConnection(0, 0)->GetIndex(), this->Of.Span);
    std::int64_t ranksAtSteps = isAtSteps ? 1 : 0;
    ranks.sum(&ranksAtSteps, 1);
    if (ranksAtSteps > 0)
    {
      this->Integral = integralOver(stepTimes(this->Input(), this->Of.Span));
      this->MayBeAtSteps = false;
    }
    else if (!isProbe)
    {
      if (time)
      {
        checkTime(this->Input(), *time, this->Of.Span);
      }
      for (const auto& next : ranks.dataOfAll(time ? data : nullptr))
      {
        if (this->Of.NumberOfSpreadPhotons > 0)
        {
          ExposureSums::expectReplicates(next);
        }
        this->Integral->take(next);
      }
    }
    // Upstream may modify itself as it executes. If something changed a vtkIrradianceFilter
    // meanwhile, its time rises until it executes again.
    this->Upstream = upstreamTime(this->Filter, 0, 0);
  }

  void Write(vtkDataObject* output) const
  {
    throwIf(!this->Integral->sums().haveCells() && !isEmptyPieceRequested(this->Input()),
      "the input has no cells at any of the times that were visited");
    this->Integral->sums().write(this->Integral->last(), output);
    AddTimes(*this->Integral, output->GetFieldData());
    if (!this->Integral->shortfall().empty())
    {
      vtkWarningWithObjectMacro(this->Filter, << this->Integral->shortfall());
    }
  }

  vtkRadiantExposureFilter* Filter;
  /// Null, except in a run and after an abort.
  std::unique_ptr<ExposureIntegral> Integral;
  Settings Of{};               ///< the integral's
  bool MayBeAtSteps = false;   ///< Automatic, and no time yet came as the time of a step
  std::optional<double> Probe; ///< Automatic: the first time asked for, which is between steps
  vtkWeakPointer<vtkExecutive> Producer; ///< of what the integral took
  vtkMTimeType Upstream = 0;             ///< upstreamTime() of that
};

vtkRadiantExposureFilter::vtkRadiantExposureFilter()
  : StartTime(std::numeric_limits<double>::quiet_NaN())
  , EndTime(std::numeric_limits<double>::quiet_NaN())
  , Internals(new vtkInternals(this))
{
}

vtkRadiantExposureFilter::~vtkRadiantExposureFilter() = default;

vtkExecutive* vtkRadiantExposureFilter::CreateDefaultExecutive()
{
  return newRanksPipeline([this] {
    this->Internals->End();
    this->Internals->Forget();
    this->Internals->GetRanks().withdraw();
  });
}

vtkCxxSetSmartPointerMacro(vtkRadiantExposureFilter, Controller, vtkMultiProcessController);

vtkMultiProcessController* vtkRadiantExposureFilter::GetController()
{
  return this->Controller;
}

int vtkRadiantExposureFilter::FillInputPortInformation(int, vtkInformation* info)
{
  return setInputTypes(info, "vtkDataObjectTree", "vtkDataSet");
}

int vtkRadiantExposureFilter::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkInformation* info = outputs->GetInformationObject(0);
  info->Remove(Pipeline::TIME_STEPS());
  info->Remove(Pipeline::TIME_RANGE());
  return 1;
}

int vtkRadiantExposureFilter::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*)
{
  this->Internals->Error.clear();
  try
  {
    this->Internals->Prepare();
  }
  catch (const std::exception& error)
  {
    this->Internals->Forget();
    this->Internals->Error = error.what();
  }
  return 1;
}

int vtkRadiantExposureFilter::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkDataObject* output = vtkDataObject::GetData(outputs);
  ControllerRanks ranks = this->Internals->GetRanks();
  bool isAborted = true;
  const auto compute = [&] {
    throwIf(!this->Internals->Error.empty(), this->Internals->Error);
    this->Internals->Run(ranks, output);
    isAborted = false;
  };
  const int result = runFilter(this, output, compute, &ranks);
  if (result == 0 || !isAborted)
  {
    this->Internals->Forget();
  }
  this->Internals->End();
  return result;
}

void vtkRadiantExposureFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "StartTime: " << this->StartTime << "\n"
     << indent << "EndTime: " << this->EndTime << "\n"
     << indent << "IntegrationMode: " << this->IntegrationMode << "\n"
     << indent << "NumberOfTimeSteps: " << this->NumberOfTimeSteps << "\n"
     << indent << "RelativeTolerance: " << this->RelativeTolerance << "\n"
     << indent << "MaximumNumberOfTimeSteps: " << this->MaximumNumberOfTimeSteps << "\n"
     << indent << "NumberOfSpreadPhotons: " << this->NumberOfSpreadPhotons << "\n"
     << indent << "Controller: " << this->GetController() << "\n";
}
