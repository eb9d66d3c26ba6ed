#include "vtkIrradianceFilter.h"

#include "InputError.h"
#include "OutputWriter.h"
#include "Pose.h"
#include "SmpExecution.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkLinearTransform.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>

vtkStandardNewMacro(vtkIrradianceFilter);

class vtkIrradianceFilter::vtkInternals
{
public:
  using Connections = std::vector<irradiance::InputConnection>;

  void Compute(vtkIrradianceFilter* filter, const Connections& fixed, const Connections& moving,
    vtkMultiBlockDataSet* output);
  std::vector<irradiance::AffineMap> GetPoses(const Connections& moving) const;

  std::map<int, vtkSmartPointer<vtkLinearTransform>> Transforms;
  irradiance::SceneReader Scene;
  irradiance::IrradianceEngine Engine;
};

namespace
{

enum ArrayIndex
{
  ExitanceArray = 0,
  ReflectanceArray = 1,
  FluxArray = 4
};

constexpr vtkIdType MostWalks = std::numeric_limits<std::uint32_t>::max();

std::string ConnectionName(int port, int connection)
{
  return "input port " + std::to_string(port) + ", connection " + std::to_string(connection);
}

/// Throws InputError unless `low` <= value <= `high`.
std::uint32_t Checked(const char* name, vtkIdType value, vtkIdType low, vtkIdType high)
{
  if (value < low || value > high)
  {
    throw irradiance::InputError(std::string(name) + " is " + std::to_string(value) + "; " +
      std::to_string(low) + " to " + std::to_string(high) + " are possible");
  }
  return static_cast<std::uint32_t>(value);
}

void ReadErrorSettings(vtkIrradianceFilter* filter, irradiance::EngineSettings& settings)
{
  constexpr vtkIdType mostReplicates = 256;
  const vtkIdType walks = filter->GetNumberOfWalks();
  const double target = filter->GetTargetRelativeError();
  const std::uint32_t replicates =
    Checked("NumberOfReplicates", filter->GetNumberOfReplicates(), 2, mostReplicates);
  if (!(target >= 0) || std::isinf(target))
  {
    throw irradiance::InputError("TargetRelativeError is " + std::to_string(target) +
      "; it has to be positive, or 0 for no target");
  }
  if (target > 0)
  {
    settings.targetRelativeError = target;
    settings.maximumNumberOfWalks =
      Checked("MaximumNumberOfWalks, which is at least NumberOfWalks,",
        filter->GetMaximumNumberOfWalks(), walks, MostWalks);
  }
  if (target > 0 || filter->GetComputeStandardError())
  {
    Checked("NumberOfWalks, with NumberOfReplicates replicates,", walks, replicates, MostWalks);
    settings.replicates = replicates;
  }
}

irradiance::EngineSettings CheckedSettings(vtkIrradianceFilter* filter)
{
  const double budget = filter->GetRepairTimeBudget();
  if (!(budget >= 0))
  {
    throw irradiance::InputError("RepairTimeBudget is " + std::to_string(budget) +
      "; 0 (none) or a positive number of seconds is possible");
  }
  irradiance::EngineSettings settings;
  settings.numberOfWalks = Checked("NumberOfWalks", filter->GetNumberOfWalks(), 1, MostWalks);
  ReadErrorSettings(filter, settings);
  settings.seed = static_cast<std::uint64_t>(filter->GetSeed());
  settings.traversalMode = static_cast<irradiance::TraversalMode>(filter->GetTraversalMode());
  settings.verify = filter->GetUpdateMode() == vtkIrradianceFilter::Verify;
  settings.cacheStaticHits = filter->GetCacheStaticHits() != 0;
  settings.separateSides = filter->GetSeparateSides() != 0;
  settings.repairTimeBudget = budget;
  return settings;
}

std::string TargetMissed(
  const irradiance::IrradianceEngine& engine, const irradiance::EngineSettings& settings)
{
  std::ostringstream text;
  text << "TargetRelativeError " << settings.targetRelativeError
       << " is not reached with MaximumNumberOfWalks " << engine.numberOfWalks() << ": ";
  if (std::isinf(engine.reachedRelativeError()))
  {
    text << "on more than 5 % of the area too few photons arrived to tell the error";
  }
  else
  {
    text << "95 % of the area is known to " << engine.reachedRelativeError();
  }
  return text.str();
}

}

vtkIrradianceFilter::vtkIrradianceFilter()
  : Internals(new vtkInternals)
{
  this->SetNumberOfInputPorts(2);
  const int cells = vtkDataObject::FIELD_ASSOCIATION_CELLS;
  this->SetInputArrayToProcess(ExitanceArray, 0, 0, cells, "RadiantExitance");
  this->SetInputArrayToProcess(ReflectanceArray, 0, 0, cells, "DiffuseReflectance");
  this->SetInputArrayToProcess(FluxArray, 0, 0, cells, "RadiantFlux");
}

vtkIrradianceFilter::~vtkIrradianceFilter() = default;

void vtkIrradianceFilter::SetDynamicTransform(int i, vtkLinearTransform* worldFromObject)
{
  if (this->GetDynamicTransform(i) == worldFromObject)
  {
    return;
  }
  if (worldFromObject)
  {
    this->Internals->Transforms[i] = worldFromObject;
  }
  else
  {
    this->Internals->Transforms.erase(i);
  }
  this->Modified();
}

vtkLinearTransform* vtkIrradianceFilter::GetDynamicTransform(int i)
{
  const auto found = this->Internals->Transforms.find(i);
  return found == this->Internals->Transforms.end() ? nullptr : found->second.Get();
}

void vtkIrradianceFilter::RemoveAllDynamicTransforms()
{
  if (!this->Internals->Transforms.empty())
  {
    this->Internals->Transforms.clear();
    this->Modified();
  }
}

vtkMTimeType vtkIrradianceFilter::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  for (const auto& transform : this->Internals->Transforms)
  {
    time = std::max(time, transform.second->GetMTime());
  }
  return time;
}

int vtkIrradianceFilter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

// The executive copies the times of the first connection alone; a scene has those of all.
int vtkIrradianceFilter::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* output)
{
  std::set<double> steps;
  double range[2] = { VTK_DOUBLE_MAX, -VTK_DOUBLE_MAX };
  for (int port = 0; port < 2; ++port)
  {
    for (int i = 0; i < inputs[port]->GetNumberOfInformationObjects(); ++i)
    {
      vtkInformation* info = inputs[port]->GetInformationObject(i);
      auto* stepsKey = vtkStreamingDemandDrivenPipeline::TIME_STEPS();
      auto* rangeKey = vtkStreamingDemandDrivenPipeline::TIME_RANGE();
      if (info->Has(stepsKey) && info->Length(stepsKey) > 0)
      {
        const double* times = info->Get(stepsKey);
        const int count = info->Length(stepsKey);
        steps.insert(times, times + count);
        range[0] = std::min(range[0], *std::min_element(times, times + count));
        range[1] = std::max(range[1], *std::max_element(times, times + count));
      }
      if (info->Has(rangeKey))
      {
        range[0] = std::min(range[0], info->Get(rangeKey)[0]);
        range[1] = std::max(range[1], info->Get(rangeKey)[1]);
      }
    }
  }
  vtkInformation* info = output->GetInformationObject(0);
  if (!steps.empty())
  {
    const std::vector<double> all(steps.begin(), steps.end());
    info->Set(
      vtkStreamingDemandDrivenPipeline::TIME_STEPS(), all.data(), static_cast<int>(all.size()));
  }
  if (range[0] <= range[1])
  {
    info->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
  }
  return 1;
}

// Light comes from everywhere: every piece needs the whole scene.
int vtkIrradianceFilter::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  for (int port = 0; port < 2; ++port)
  {
    for (int i = 0; i < inputs[port]->GetNumberOfInformationObjects(); ++i)
    {
      vtkInformation* info = inputs[port]->GetInformationObject(i);
      info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), 0);
      info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), 1);
      info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    }
  }
  return 1;
}

bool vtkIrradianceFilter::GoOn(double progress)
{
  this->UpdateProgress(progress);
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20221101)
  return !this->CheckAbort();
#else
  return !this->GetAbortExecute();
#endif
}

std::vector<irradiance::AffineMap> vtkIrradianceFilter::vtkInternals::GetPoses(
  const Connections& moving) const
{
  const int last = this->Transforms.empty() ? -1 : this->Transforms.rbegin()->first;
  const int first = this->Transforms.empty() ? 0 : this->Transforms.begin()->first;
  if (first < 0 || last >= static_cast<int>(moving.size()))
  {
    throw irradiance::InputError("there is a transform for dynamic connection " +
      std::to_string(first < 0 ? first : last) + ", but input port 1 has " +
      std::to_string(moving.size()) + " connections");
  }
  std::vector<irradiance::AffineMap> poses;
  for (const irradiance::InputConnection& connection : moving)
  {
    const auto found = this->Transforms.find(static_cast<int>(poses.size()));
    vtkLinearTransform* transform = found == this->Transforms.end() ? nullptr : found->second.Get();
    poses.push_back(irradiance::poseOf(connection.name, transform, connection.polyData));
  }
  return poses;
}

void vtkIrradianceFilter::vtkInternals::Compute(vtkIrradianceFilter* filter,
  const Connections& fixed, const Connections& moving, vtkMultiBlockDataSet* output)
{
  const irradiance::EngineSettings settings = CheckedSettings(filter);
  const std::vector<irradiance::AffineMap> poses = this->GetPoses(moving);
  irradiance::SmpExecution execution([filter](double progress) { return filter->GoOn(progress); });
  const auto checkpoint = [&execution] {
    if (!execution.goOn(0))
    {
      throw irradiance::Interrupted();
    }
  };
  this->Scene.read(fixed, moving, poses, filter->GetDefaultDiffuseReflectance(), checkpoint);
  for (const std::string& warning : this->Scene.takeWarnings())
  {
    vtkWarningWithObjectMacro(filter, << warning);
  }
  this->Engine.update(this->Scene.objects(), settings, execution);
  if (!this->Engine.hasEmitters())
  {
    vtkWarningWithObjectMacro(filter, << "the scene has no light: no cell with a RadiantExitance "
                                         "and an area, and no vertex with a RadiantFlux");
  }
  if (this->Engine.reachedRelativeError() > settings.targetRelativeError)
  {
    vtkWarningWithObjectMacro(filter, << TargetMissed(this->Engine, settings));
  }
  irradiance::OutputWriter(
    this->Engine, this->Scene, settings, filter->GetComputeStandardError() != 0)
    .write(fixed, moving, output);
}

int vtkIrradianceFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputs);
  output->Initialize();
  std::vector<irradiance::InputConnection> connections[2];
  for (int port = 0; port < 2; ++port)
  {
    for (int i = 0; i < inputs[port]->GetNumberOfInformationObjects(); ++i)
    {
      vtkPolyData* input = vtkPolyData::GetData(inputs[port], i);
      connections[port].push_back({ ConnectionName(port, i), input,
        this->GetInputAbstractArrayToProcess(ExitanceArray, input),
        this->GetInputAbstractArrayToProcess(ReflectanceArray, input),
        this->GetInputAbstractArrayToProcess(FluxArray, input) });
    }
  }
  if (connections[0].empty() && connections[1].empty() && this->Internals->Transforms.empty())
  {
    return 1;
  }
  try
  {
    this->Internals->Compute(this, connections[0], connections[1], output);
    vtkInformation* info = outputs->GetInformationObject(0);
    if (info->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP()))
    {
      output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(),
        info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP()));
    }
  }
  catch (const irradiance::Interrupted&)
  {
    output->Initialize();
  }
  catch (const std::exception& error)
  {
    output->Initialize();
    vtkErrorMacro(<< error.what());
  }
  return 1;
}

void vtkIrradianceFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfWalks: " << this->NumberOfWalks << "\n"
     << indent << "Seed: " << this->Seed << "\n"
     << indent << "DefaultDiffuseReflectance: " << this->DefaultDiffuseReflectance << "\n"
     << indent << "TraversalMode: " << this->TraversalMode << "\n"
     << indent << "UpdateMode: " << this->UpdateMode << "\n"
     << indent << "CacheStaticHits: " << this->CacheStaticHits << "\n"
     << indent << "SeparateSides: " << this->SeparateSides << "\n"
     << indent << "ComputeStandardError: " << this->ComputeStandardError << "\n"
     << indent << "NumberOfReplicates: " << this->NumberOfReplicates << "\n"
     << indent << "TargetRelativeError: " << this->TargetRelativeError << "\n"
     << indent << "MaximumNumberOfWalks: " << this->MaximumNumberOfWalks << "\n"
     << indent << "RepairTimeBudget: " << this->RepairTimeBudget << "\n"
     << indent << "Dynamic transforms: " << this->Internals->Transforms.size() << "\n";
  for (const auto& transform : this->Internals->Transforms)
  {
    os << indent << "Dynamic transform " << transform.first << ":\n";
    transform.second->PrintSelf(os, indent.GetNextIndent());
  }
}
