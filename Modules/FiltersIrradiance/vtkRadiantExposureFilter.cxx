// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadiantExposureFilter.h"

#include "Data/NamedArray.h"
#include "Pipeline/FilterRun.h"
#include "Pipeline/PieceRequest.h"
#include "Pipeline/ReplicateRequest.h"
#include "Progress/InputError.h"
#include "Time/ErrorControlledIntegral.h"
#include "Time/ExposureTimes.h"
#include "Time/InputTimes.h"
#include "Time/TimeKeys.h"

#include "vtkAlgorithmOutput.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

vtkStandardNewMacro(vtkRadiantExposureFilter);

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

/// What the result depends on, except what happens upstream.
struct Settings
{
  int Mode, NumberOfTimeSteps, MaximumNumberOfTimeSteps;
  double RelativeTolerance;
  irradiance::TimeSpan Span;
  std::array<int, 3> Piece; ///< number, of how many, ghost levels

  auto All() const
  {
    return std::tie(Mode, NumberOfTimeSteps, MaximumNumberOfTimeSteps, RelativeTolerance,
      Span.start, Span.end, Piece);
  }
  bool operator==(const Settings& other) const { return All() == other.All(); }
};

bool IsErrorControlled(int mode)
{
  return mode == vtkRadiantExposureFilter::ErrorControlled ||
    mode == vtkRadiantExposureFilter::Automatic;
}

Settings CheckedSettings(vtkRadiantExposureFilter* filter, vtkInformation* input)
{
  Settings settings{ filter->GetIntegrationMode(), filter->GetNumberOfTimeSteps(),
    filter->GetMaximumNumberOfTimeSteps(), filter->GetRelativeTolerance(),
    irradiance::timeSpan(input, filter->GetStartTime(), filter->GetEndTime()),
    { input->Get(Pipeline::UPDATE_PIECE_NUMBER()), input->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()),
      input->Get(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS()) } };
  constexpr int mostSteps = 1000000;
  if (settings.NumberOfTimeSteps < 1 || settings.NumberOfTimeSteps > mostSteps)
  {
    throw irradiance::InputError("NumberOfTimeSteps is " +
      std::to_string(settings.NumberOfTimeSteps) + "; 1 to " + std::to_string(mostSteps) +
      " are possible");
  }
  if (!IsErrorControlled(settings.Mode))
  {
    return settings;
  }
  if (!(settings.RelativeTolerance > 0 && std::isfinite(settings.RelativeTolerance)))
  {
    throw irradiance::InputError("RelativeTolerance is " +
      irradiance::text(settings.RelativeTolerance) + "; it has to be positive");
  }
  if (settings.MaximumNumberOfTimeSteps < settings.NumberOfTimeSteps)
  {
    throw irradiance::InputError("MaximumNumberOfTimeSteps is " +
      std::to_string(settings.MaximumNumberOfTimeSteps) + ", but NumberOfTimeSteps, " +
      std::to_string(settings.NumberOfTimeSteps) + ", is the least for error control");
  }
  return settings;
}

std::unique_ptr<irradiance::ExposureIntegral> MakeIntegral(
  const Settings& settings, vtkInformation* input)
{
  if (IsErrorControlled(settings.Mode))
  {
    return std::make_unique<irradiance::ErrorControlledIntegral>(
      irradiance::firstTimes(irradiance::stepsOf(input), settings.Span, settings.NumberOfTimeSteps),
      settings.RelativeTolerance, settings.MaximumNumberOfTimeSteps);
  }
  return std::make_unique<irradiance::GivenTimesIntegral>(
    settings.Mode == vtkRadiantExposureFilter::TimeSteps
      ? irradiance::stepTimes(input, settings.Span)
      : irradiance::uniformTimes(settings.Span, settings.NumberOfTimeSteps));
}

void AddTimes(const irradiance::ExposureIntegral& integral, vtkFieldData* fields)
{
  const std::vector<double>& times = integral.times();
  const auto count = static_cast<vtkIdType>(times.size());
  const auto addNumber = [fields](const char* name, double number) {
    irradiance::addTuple<vtkDoubleArray>(fields, name, { number });
  };
  addNumber("StartTime", times.front());
  addNumber("EndTime", times.back());
  irradiance::addTuple<vtkIdTypeArray>(fields, "NumberOfTimeSteps", { count - 1 });
  const auto all = irradiance::addArray<vtkDoubleArray>(fields, "IntegrationTimes", 1, count);
  std::copy(times.begin(), times.end(), all->GetPointer(0));
  if (!std::isnan(integral.relativeError()))
  {
    addNumber("TimeIntegrationError", integral.relativeError());
    addNumber("TimeIntegrationNoise", integral.relativeNoise());
  }
}

}

/**
 * VTK has a way to execute a filter once for each time, CONTINUE_EXECUTING, which vtkTemporalStatistics
 * takes. If upstream fails at a later time, the executive of VTK 9.1 and its like then asks for ever.
 * So a run asks for the first time as that does, in RequestUpdateExtent, and updates the producer
 * for the others, in RequestData.
 */
class vtkRadiantExposureFilter::vtkInternals
{
public:
  /// Continues what an abort left, if that is still what is asked for, and asks for the next time.
  void Prepare(vtkRadiantExposureFilter* filter);
  void Run(vtkRadiantExposureFilter* filter, vtkDataObject* output);
  void Forget() { this->Integral = nullptr; }

  std::string Error; ///< found before the data were asked for

private:
  void Begin(vtkRadiantExposureFilter* filter);
  bool IsUpToDate(vtkRadiantExposureFilter* filter) const;
  void UpdateProducer(vtkRadiantExposureFilter* filter) const;
  double NextTime() const { return this->Probe ? *this->Probe : this->Integral->nextTime(); }
  void Take(vtkRadiantExposureFilter* filter);
  void IntegrateOverSteps(vtkRadiantExposureFilter* filter);

  /// Null, except in a run and after an abort.
  std::unique_ptr<irradiance::ExposureIntegral> Integral;
  Settings Of{};               ///< the integral's
  bool MayBeAtSteps = false;   ///< Automatic, and no time yet came as the time of a step
  std::optional<double> Probe; ///< Automatic: the first time asked for, which is between steps
  vtkWeakPointer<vtkExecutive> Producer; ///< of what the integral took
  vtkMTimeType Upstream = 0;             ///< upstreamTime() of that
};

bool vtkRadiantExposureFilter::vtkInternals::IsUpToDate(vtkRadiantExposureFilter* filter) const
{
  return this->Integral && !this->Integral->isDone() &&
    this->Producer == filter->GetInputExecutive(0, 0) &&
    this->Upstream == irradiance::upstreamTime(filter, 0, 0) &&
    this->Of == CheckedSettings(filter, filter->GetInputInformation(0, 0));
}

void vtkRadiantExposureFilter::vtkInternals::Begin(vtkRadiantExposureFilter* filter)
{
  vtkInformation* input = filter->GetInputInformation(0, 0);
  this->Forget();
  this->Of = CheckedSettings(filter, input);
  this->Integral = MakeIntegral(this->Of, input);
  this->MayBeAtSteps = this->Of.Mode == Automatic;
  this->Probe =
    this->MayBeAtSteps ? irradiance::timeBetweenSteps(input, this->Of.Span) : std::nullopt;
  this->Producer = filter->GetInputExecutive(0, 0);
  this->Upstream = irradiance::upstreamTime(filter, 0, 0);
}

void vtkRadiantExposureFilter::vtkInternals::Prepare(vtkRadiantExposureFilter* filter)
{
  if (!this->IsUpToDate(filter))
  {
    this->Begin(filter);
  }
  vtkInformation* input = filter->GetInputInformation(0, 0);
  input->Set(Pipeline::UPDATE_TIME_STEP(), this->NextTime());
  irradiance::requestReplicates(input, true);
}

void vtkRadiantExposureFilter::vtkInternals::UpdateProducer(vtkRadiantExposureFilter* filter) const
{
  const double time = this->NextTime();
  filter->GetInputInformation(0, 0)->Set(Pipeline::UPDATE_TIME_STEP(), time);
  if (!this->Producer->Update(filter->GetInputConnection(0, 0)->GetIndex()))
  {
    throw irradiance::InputError(
      "the input could not be computed at time " + irradiance::text(time) + ", see its own error");
  }
}

void vtkRadiantExposureFilter::vtkInternals::Take(vtkRadiantExposureFilter* filter)
{
  const double time = this->NextTime();
  vtkDataObject* data = filter->GetInputDataObject(0, 0);
  if (data->GetNumberOfElements(vtkDataObject::CELL) == 0 &&
    irradiance::forgetAborted(this->Producer))
  {
    this->Upstream =
      irradiance::upstreamTime(filter, 0, 0); // SetAbortExecute() is a modification for VTK
    throw irradiance::Interrupted();
  }
  const bool isProbe = this->Probe.has_value();
  this->Probe.reset();
  if (this->MayBeAtSteps &&
    irradiance::comesAtStepsOnly(
      this->Producer, filter->GetInputConnection(0, 0)->GetIndex(), this->Of.Span))
  {
    this->IntegrateOverSteps(filter);
  }
  else if (!isProbe)
  {
    irradiance::checkTime(filter->GetInputInformation(0, 0), time, this->Of.Span);
    this->Integral->take(data);
  }
  // Upstream may modify itself as it executes, such as interpolators that set themselves up. If
  // something changed a vtkIrradianceFilter meanwhile, its time rises until it executes again.
  this->Upstream = irradiance::upstreamTime(filter, 0, 0);
}

void vtkRadiantExposureFilter::vtkInternals::IntegrateOverSteps(vtkRadiantExposureFilter* filter)
{
  this->Integral = std::make_unique<irradiance::GivenTimesIntegral>(
    irradiance::stepTimes(filter->GetInputInformation(0, 0), this->Of.Span));
  this->MayBeAtSteps = false;
}

void vtkRadiantExposureFilter::vtkInternals::Run(
  vtkRadiantExposureFilter* filter, vtkDataObject* output)
{
  irradiance::SmpExecution execution = irradiance::executionOf(filter);
  this->Take(filter);
  while (!this->Integral->isDone())
  {
    if (!execution.reportProgress(this->Integral->progress()))
    {
      throw irradiance::Interrupted();
    }
    if (!this->IsUpToDate(filter)) // an observer has changed something
    {
      this->Producer->UpdateInformation();
      this->Begin(filter);
    }
    this->UpdateProducer(filter);
    this->Take(filter);
  }
  if (!this->Integral->sums().haveCells() &&
    !irradiance::isEmptyPieceRequested(filter->GetInputInformation(0, 0)))
  {
    throw irradiance::InputError("the input has no cells at any of the times that were visited");
  }
  this->Integral->sums().write(this->Integral->last(), output);
  AddTimes(*this->Integral, output->GetFieldData());
  if (!this->Integral->shortfall().empty())
  {
    vtkWarningWithObjectMacro(filter, << this->Integral->shortfall());
  }
}

vtkRadiantExposureFilter::vtkRadiantExposureFilter()
  : StartTime(std::numeric_limits<double>::quiet_NaN())
  , EndTime(std::numeric_limits<double>::quiet_NaN())
  , Internals(new vtkInternals)
{
}

vtkRadiantExposureFilter::~vtkRadiantExposureFilter() = default;

int vtkRadiantExposureFilter::FillInputPortInformation(int, vtkInformation* info)
{
  // Composite types first: else the executive would call the filter for each block separately.
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObjectTree");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  return 1;
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
    this->Internals->Prepare(this);
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
  bool isAborted = true;
  const int result = irradiance::runFilter(this, output, [&] {
    if (!this->Internals->Error.empty())
    {
      throw irradiance::InputError(this->Internals->Error);
    }
    this->Internals->Run(this, output);
    isAborted = false;
  });
  if (result == 0 || !isAborted)
  {
    this->Internals->Forget();
  }
  irradiance::requestReplicates(this->GetInputInformation(0, 0), false); // others need not pay
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
     << indent << "MaximumNumberOfTimeSteps: " << this->MaximumNumberOfTimeSteps << "\n";
}
