// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIrradianceFilter.h"

#include "Data/ArrayNames.h"
#include "Estimates/AutomaticChoice.h"
#include "FinalGather/PathLights.h"
#include "Input/ChosenArrays.h"
#include "Input/Pose.h"
#include "Input/SceneAdvice.h"
#include "Output/OutputWriter.h"
#include "Output/WalksWriter.h"
#include "Pipeline/ControllerRanks.h"
#include "Pipeline/DistributedInput.h"
#include "Pipeline/FilterRun.h"
#include "Pipeline/PhotonSource.h"
#include "Pipeline/UpstreamRequest.h"
#include "Pipeline/WalkMemory.h"
#include "Progress/InputError.h"
#include "Time/TimeKeys.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkLinearTransform.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTimeStamp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <new>
#include <optional>
#include <sstream>
#include <utility>

using namespace irradiance;

vtkStandardNewMacro(vtkIrradianceFilter);

namespace
{

/// By method, what each says of DirectLight, CellEstimate, GatherOn and UnbiasedGather.
constexpr std::array<std::array<int, 4>, 6> PartsOfMethods{ { { 2, 4, 0, 0 }, { 0, 0, 0, 0 },
  { 0, 1, 0, 0 }, { 1, 3, 0, 0 }, { 1, 3, 2, 0 }, { 1, 3, 0, 1 } } };

constexpr vtkIdType MostWalks = std::numeric_limits<std::uint32_t>::max();
constexpr int MostRaysOfTarget = 65536;
/// Of a target.
constexpr vtkIdType UsualWalks = 10000000, UsualRays = 1024;

/// `effort` times as many, at most `most`; without an effort `usual`, or all if that is less.
vtkIdType Multiplied(vtkIdType number, double effort, vtkIdType usual, vtkIdType most)
{
  if (effort == 0)
  {
    return std::max(number, usual);
  }
  const double product = effort * static_cast<double>(number);
  return product < static_cast<double>(most) ? static_cast<vtkIdType>(product) : most;
}

void ReadErrorSettings(vtkIrradianceFilter* filter, EngineSettings& settings)
{
  constexpr vtkIdType mostReplicates = 256;
  const vtkIdType walks = filter->GetNumberOfWalks();
  const double target = filter->GetTargetRelativeError();
  const std::uint32_t replicates =
    checked("NumberOfReplicates", filter->GetNumberOfReplicates(), 2, mostReplicates);
  throwIf(!(target >= 0 && target <= 1), "TargetRelativeError is ", target,
    "; it has to be positive and at most 1, or 0 for no target (5 % is 0.05)");
  if (target > 0)
  {
    const double effort = filter->GetMaximumEffort();
    throwIf(effort != 0 && !(effort >= 1), "MaximumEffort is ", effort,
      "; it has to be 1 or more, or 0 for 10,000,000 walks and 1024 rays");
    settings.targetRelativeError = target;
    settings.maximumNumberOfWalks =
      checked("MaximumNumberOfWalks, which is at least NumberOfWalks,",
        filter->GetMaximumNumberOfWalks(), walks, MostWalks);
    settings.maximumGatherRays =
      checked("MaximumNumberOfGatherRays, which is at least NumberOfRays,",
        filter->GetMaximumNumberOfGatherRays(), settings.gatherRays, MostRaysOfTarget);
  }
  if (target > 0 || filter->GetComputeStandardError())
  {
    checked("NumberOfWalks, with NumberOfReplicates replicates,", walks, replicates, MostWalks);
    settings.replicates = replicates;
  }
}

/// Sums if that is left to the scene.
CellEstimate AskedEstimate(vtkIrradianceFilter* filter)
{
  constexpr int nearest = 2;
  const int estimate = filter->GetCellEstimate();
  throwIf(estimate == nearest,
    "CellEstimate is 2, which was Nearest: for cells there are Spread (1) and Gathered (3), and "
    "for points the Estimate Nearest of vtkIrradianceProbeFilter");
  return estimate == vtkIrradianceFilter::Spread   ? CellEstimate::Spread
    : estimate == vtkIrradianceFilter::FinalGather ? CellEstimate::Gathered
                                                   : CellEstimate::Sums;
}

/// With what is possible where a property is left to the scene.
EngineSettings CheckedSettings(vtkIrradianceFilter* filter)
{
  constexpr vtkIdType mostSpreadPhotons = 1000000, mostRays = 4096;
  const double budget = filter->GetRepairTimeBudget();
  throwIf(!(budget >= 0), "RepairTimeBudget is ", budget,
    "; 0 (none) or a positive number of seconds is possible");
  const double reflectance = filter->GetDefaultDiffuseReflectance();
  throwIf(!(reflectance >= 0 && reflectance <= 1), "DefaultDiffuseReflectance is ", reflectance,
    "; 0 to 1 is possible");
  EngineSettings settings;
  settings.numberOfWalks = checked("NumberOfWalks", filter->GetNumberOfWalks(), 1, MostWalks);
  settings.gatherRays = checked("NumberOfRays", filter->GetNumberOfRays(), 1, mostRays);
  ReadErrorSettings(filter, settings);
  settings.seed = static_cast<std::uint64_t>(filter->GetSeed());
  settings.traversalMode = static_cast<TraversalMode>(filter->GetTraversalMode());
  settings.verify = filter->GetUpdateMode() == vtkIrradianceFilter::Verify;
  settings.cacheStaticHits = filter->GetCacheStaticHits() != 0;
  settings.separateSides = filter->GetSeparateSides() != 0;
  settings.gathersDirectLight = filter->GetDirectLight() != vtkIrradianceFilter::Shot;
  settings.repairTimeBudget = budget;
  settings.cellEstimate = AskedEstimate(filter);
  settings.spreadPhotons =
    checked("NumberOfSpreadPhotons", filter->GetNumberOfSpreadPhotons(), 1, mostSpreadPhotons);
  throwIf(filter->GetGatherOn() != vtkIrradianceFilter::SmallCells &&
      filter->GetGatherOn() != vtkIrradianceFilter::AllCells,
    "GatherOn is ", filter->GetGatherOn(),
    ", which was DynamicCells: set Method to Gathered or GatheredEverywhere");
  settings.gathersEverywhere = filter->GetGatherOn() == vtkIrradianceFilter::AllCells;
  settings.unbiasedGather = filter->GetUnbiasedGather() != 0;
  const std::string conflict = conflictOf(settings, settings);
  throwIf(!conflict.empty(), conflict);
  return settings;
}

/// Has walks stored, and whole on each rank, for filters that read their photons. Throws
/// InputError.
void KeepWhatIsRead(
  EngineSettings& settings, vtkInformation* request, bool areWalksShown, const Ranks& ranks)
{
  const bool areWalksRead = isRequested(request, UpstreamRequest::Walks);
  settings.allOnEachRank = areWalksRead || isRequested(request, UpstreamRequest::Photons);
  settings.keepPhotons = settings.allOnEachRank || areWalksShown;
  settings.listRepaired = areWalksShown || areWalksRead;
  throwIf(settings.allOnEachRank && settings.repairTimeBudget > 0 && ranks.areSeveral(),
    "RepairTimeBudget is ", settings.repairTimeBudget, ", but there are ", ranks.count(),
    " processes, and each of them would repair other photons for vtkPhotonWalksFilter or "
    "vtkIrradianceProbeFilter: set it to 0");
}

std::string TargetMissed(
  const IrradianceEngine& engine, const EngineSettings& settings, double effort)
{
  std::ostringstream text;
  text << "TargetRelativeError " << settings.targetRelativeError
       << " is not reached with MaximumEffort " << effort << ", which is " << engine.numberOfWalks()
       << " walks";
  if (engine.numberOfGatherRays() > 0)
  {
    text << " and " << engine.numberOfGatherRays() << " rays a side";
  }
  const double reached = engine.reachedRelativeError();
  std::isinf(reached)
    ? text << ": on more than 5 % of the area too few photons arrived to tell the error"
    : text << ": 95 % of the area is known to " << reached;
  return text.str();
}

}

class vtkIrradianceFilter::vtkInternals
{
public:
  explicit vtkInternals(vtkIrradianceFilter* filter)
    : Filter(filter)
  {
  }

  /// The processes that share the walks; null if a filter downstream has each compute alone.
  vtkMultiProcessController* GetSharing() const
  {
    const bool isAlone = isRequested(this->Filter->GetOutputInformation(0), UpstreamRequest::Alone);
    return isAlone ? nullptr : this->Filter->GetController();
  }

  /// What this process has.
  SceneInputs GetInputs(vtkInformationVector** inputs) const
  {
    const int dynamics = inputs[1]->GetNumberOfInformationObjects();
    const int last = this->Poses.empty() ? -1 : this->Poses.rbegin()->first;
    const int first = this->Poses.empty() ? 0 : this->Poses.begin()->first;
    throwIf(first < 0 || last >= dynamics, "there is a transform for dynamic connection ",
      first < 0 ? first : last, ", but input port 1 has ", dynamics, " connections");
    SceneInputs read;
    for (int i = 0; i < inputs[0]->GetNumberOfInformationObjects(); ++i)
    {
      read.statics.push_back(
        staticConnection(this->Filter, i, vtkDataObject::GetData(inputs[0], i)));
    }
    for (int i = 0; i < dynamics; ++i)
    {
      read.dynamics.push_back(
        dynamicConnection(this->Filter, i, vtkDataObject::GetData(inputs[1], i),
          this->Filter->GetDynamicTransform(i), this->Filter->GetPoseArrayName()));
    }
    return read;
  }

  /// Completes what is distributed.
  void Complete(SceneInputs& inputs, ControllerRanks& ranks)
  {
    if (this->Filter->GetDistributedInput())
    {
      throwIf(!this->GetSharing() && ControllerRanks(this->Filter->GetController()).areSeveral(),
        "DistributedInput is on, but the processes share the times of a "
        "vtkRadiantExposureFilter, so each needs the whole scene: set it to off, or that "
        "filter's Controller to null");
      this->Pieces.complete(this->Filter, ranks, inputs);
    }
    checkChosenArrays(this->Filter, inputs);
  }

  void Compute(const SceneInputs& inputs, vtkInformation* request, Ranks& ranks,
    vtkMultiBlockDataSet* output, vtkPolyData* walks)
  {
    EngineSettings settings = CheckedSettings(this->Filter);
    const WalksRequest shown{ this->Filter->GetNumberOfOutputWalks(),
      this->Filter->GetOutputWalksPort(), this->Filter->GetOutputWalksConnection(),
      this->Filter->GetOutputWalksCell() };
    ranks.expectSame(shown.hash(), "other output walks than on the first process");
    SmpExecution execution = executionOf(this->Filter, &ranks);
    if (!execution.reportProgress(0)) // an update with nothing to do does not report again
    {
      throw Interrupted();
    }
    const CancelPoint reading = cancelPointOf(execution, 0);
    if (std::exchange(this->Processes, ranks.count()) != ranks.count())
    {
      // Processes that worked alone may have seen different parts come.
      this->Scene = SceneReader();
    }
    this->Scene.read(inputs, this->Filter->GetDefaultDiffuseReflectance(), reading);
    for (const std::string& warning : this->Scene.takeWarnings())
    {
      vtkWarningWithObjectMacro(this->Filter, << warning);
    }
    if (settings.cellEstimate == CellEstimate::Gathered)
    {
      checkLights(this->Scene.objects(), "Method Gathered",
        [&](const auto& cell) { return this->Scene.nameOf(cell, inputs); });
    }
    const LeftToScene left{ this->Filter->GetDirectLight() == AutomaticDirectLight,
      this->Filter->GetCellEstimate() == AutomaticEstimate };
    KeepWhatIsRead(settings, request, shown.count > 0, ranks);
    const auto count = static_cast<std::size_t>(ranks.count());
    const std::vector<LampGroup> groups = this->LampGroups();
    try
    {
      this->Groups->update(
        { this->Scene.objects(), groups, this->Scene.groupOfSky(), left, settings,
          [&](const auto& objects, const auto& chosen) {
            settings = chosen;
            requireMemory(objects, chosen, count);
          } },
        execution);
    }
    catch (const std::bad_alloc&)
    {
      throw std::runtime_error(outOfMemory(this->Scene.objects(), settings, count));
    }
    this->Groups->forEachLit([&](const LightGroup& group) {
      if (group.engine->reachedRelativeError() > settings.targetRelativeError)
      {
        vtkWarningWithObjectMacro(
          this->Filter, << (this->Groups->areSeveral() ? "light group " + group.name + ": " : "")
                        << TargetMissed(*group.engine, settings, this->Filter->GetMaximumEffort()));
      }
    });
    const CancelPoint writing = cancelPointOf(execution, 1);
    this->WarnOfExcess();
    this->Advise(inputs, writing);
    writeOutput(*this->Groups, this->Scene, inputs,
      { this->Filter->GetComputeStandardError() != 0,
        isRequested(request, UpstreamRequest::Replicates),
        this->Filter->GetComputeLightGroups() != 0 },
      writing, output);
    std::vector<PieceCells> pieces;
    for (const InputPart* part : allPartsOf(inputs))
    {
      pieces.push_back(part->cells);
    }
    PhotonSource::attach(output, this->Groups, std::move(pieces));
    if (shown.count > 0)
    {
      ProgressSpan atItsEnd(execution, 1, 1);
      const PhotonSource source(output, "the output", true);
      writeWalks(shown, source, output, atItsEnd, walks);
    }
  }

  /// Sets a property whose name is old; `what` to do instead.
  template <class T>
  void SetOld(T& property, T value, const char* name, const char* what)
  {
    if (std::exchange(property, value) != value)
    {
      this->OldNames.warn(this->Filter, name, what);
      this->Filter->Modified();
    }
  }

  /// By the dynamic connection to which the user gave it; not null.
  std::map<int, vtkSmartPointer<vtkLinearTransform>> Poses;
  vtkMTimeType Begun = 0; ///< InputTime() when the last execution began, 0 before the first
  vtkTimeStamp Newest;
  irradiance::OldNames OldNames;
  std::array<int, 4> MethodParts = PartsOfMethods[Automatic]; ///< by MethodPart
  vtkIdType MostWalks = -1;             ///< of a target, by its old name; -1: by MaximumEffort
  int MostRays = -1;                    ///< likewise
  std::map<std::string, Bands> Factors; ///< of light groups, by name
  std::map<std::string, int> Seeds;     ///< likewise

private:
  /// With the factors of the inputs times those of the user.
  std::vector<LampGroup> LampGroups()
  {
    std::vector<LampGroup> groups = this->Scene.lampGroups();
    std::string unknown;
    const auto change = [&](const std::string& name, const auto& set) {
      const auto group = std::find_if(
        groups.begin(), groups.end(), [&](const LampGroup& some) { return some.name == name; });
      group == groups.end() ? void(unknown = name) : set(*group);
    };
    for (const auto& named : this->Seeds)
    {
      change(named.first,
        [&](LampGroup& group) { group.seed = static_cast<std::uint64_t>(named.second); });
    }
    for (const auto& named : this->Factors)
    {
      const Bands& factor = named.second;
      if (factor != Bands{ { 1, 1, 1 } })
      {
        change(named.first, [&](LampGroup& group) {
          std::transform(factor.begin(), factor.end(), group.factor.begin(), group.factor.begin(),
            std::multiplies<double>());
        });
      }
    }
    if (std::exchange(this->UnknownGroup, unknown) != unknown && !unknown.empty())
    {
      vtkWarningWithObjectMacro(
        this->Filter, << "light group " << unknown
                      << " has a factor or a seed, but no input says that it is in a "
                      << kLightGroup << " of this name");
    }
    return groups;
  }

  /// Whenever an update begins to have more light than there is.
  void WarnOfExcess()
  {
    std::string excess;
    this->Groups->forEachLit([&](const LightGroup& group) {
      const IrradianceEngine& engine = *group.engine;
      for (int band = 0; band < Power::kMaxBands && excess.empty(); ++band)
      {
        excess = excessWarning(group.shown(engine.watts(engine.balance().emitted[band]), band),
          group.shown(engine.watts(engine.balance().escaped[band]), band),
          group.shown(engine.escapedError(band), band));
      }
    });
    if (!std::exchange(this->HasExcess, !excess.empty()) && !excess.empty())
    {
      vtkWarningWithObjectMacro(this->Filter, << excess);
    }
  }

  /// Says what is probably a mistake, unless it said so when the inputs last changed.
  void Advise(const SceneInputs& inputs, const CancelPoint& cancelPoint)
  {
    if (!this->Scene.hasNews())
    {
      return;
    }
    const bool isDark = this->Groups->all().empty() ||
      (!this->Groups->areSeveral() && !this->Groups->any().hasLights());
    const std::vector<std::string> advice = !isDark
      ? sceneAdvice(inputs, this->Scene, *this->Groups, cancelPoint)
      : std::vector<std::string>(
          this->Scene.isUnderSky() ? 0 : 1, noLightWarning(this->Filter, inputs));
    this->Scene.forgetNews();
    const std::vector<std::string> before = std::exchange(this->Advice, advice);
    for (const std::string& warning : advice)
    {
      if (std::find(before.begin(), before.end(), warning) == before.end())
      {
        vtkWarningWithObjectMacro(this->Filter, << warning);
      }
    }
  }

  vtkIrradianceFilter* Filter;
  irradiance::DistributedInput Pieces;
  SceneReader Scene;
  std::uint32_t Processes = 0; ///< that shared the walks when the scene was last read
  /// Shared with the outputs, see PhotonSource.
  std::shared_ptr<LightGroups> Groups = std::make_shared<LightGroups>();
  std::string UnknownGroup;        ///< the last that was warned of
  std::vector<std::string> Advice; ///< what was probably a mistake when the inputs last changed
  bool HasExcess = false;          ///< the last update had more light than there is
};

vtkIrradianceFilter::vtkIrradianceFilter()
  : Internals(new vtkInternals(this))
{
  this->Controller = vtkMultiProcessController::GetGlobalController();
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
  for (const char* name : kArrayNames)
  {
    this->SetCellArray(name, name);
  }
}

vtkIrradianceFilter::~vtkIrradianceFilter()
{
  this->SetPoseArrayName(nullptr);
}

void vtkIrradianceFilter::SetDynamicTransform(int i, vtkLinearTransform* worldFromObject)
{
  if (this->GetDynamicTransform(i) != worldFromObject)
  {
    this->Internals->Poses.erase(i);
    if (worldFromObject)
    {
      this->Internals->Poses[i] = worldFromObject;
    }
    this->Modified();
  }
}

vtkLinearTransform* vtkIrradianceFilter::GetDynamicTransform(int i)
{
  const auto& poses = this->Internals->Poses;
  const auto found = poses.find(i);
  return found == poses.end() ? nullptr : found->second.Get();
}

void vtkIrradianceFilter::SetLightGroupFactor(
  const char* group, double first, double second, double third)
{
  const Bands factor{ { first, second, third } };
  const bool isPossible = std::all_of(
    factor.begin(), factor.end(), [](double value) { return value >= 0 && std::isfinite(value); });
  if (!group || !*group || !isPossible)
  {
    vtkErrorMacro(<< "the factor of light group " << (group ? group : "(null)") << " is " << first
                  << ", " << second << ", " << third
                  << "; a name is needed, and a number that is finite and 0 or more");
  }
  else if (const auto [found, isNew] = this->Internals->Factors.emplace(group, factor);
           isNew || std::exchange(found->second, factor) != factor)
  {
    this->Modified();
  }
}

double vtkIrradianceFilter::GetLightGroupFactor(const char* group, int band)
{
  const auto found = this->Internals->Factors.find(group ? group : "");
  const auto i = static_cast<std::size_t>(std::clamp(band, 0, Power::kMaxBands - 1));
  return found == this->Internals->Factors.end() ? 1 : found->second[i];
}

void vtkIrradianceFilter::SetLightGroupSeed(const char* group, int seed)
{
  if (!group || !*group)
  {
    vtkErrorMacro(<< "the seed of a light group needs the name of the group");
  }
  else if (const auto [found, isNew] = this->Internals->Seeds.emplace(group, seed);
           isNew || std::exchange(found->second, seed) != seed)
  {
    this->Modified();
  }
}

int vtkIrradianceFilter::GetLightGroupSeed(const char* group)
{
  const auto found = this->Internals->Seeds.find(group ? group : "");
  return found == this->Internals->Seeds.end() ? this->Seed : found->second;
}

void vtkIrradianceFilter::RemoveAllLightGroupSeeds()
{
  if (!std::exchange(this->Internals->Seeds, {}).empty())
  {
    this->Modified();
  }
}

void vtkIrradianceFilter::RemoveAllLightGroupFactors()
{
  if (!std::exchange(this->Internals->Factors, {}).empty())
  {
    this->Modified();
  }
}

void vtkIrradianceFilter::SetDynamicTransformInterpolator(int i, vtkTransformInterpolator*)
{
  vtkErrorMacro(<< "SetDynamicTransformInterpolator is gone: connect dynamic input " << i
                << " by way of a vtkKeyFramedPose, which interpolates poses between keys");
}

vtkCxxSetSmartPointerMacro(vtkIrradianceFilter, Controller, vtkMultiProcessController);

vtkMultiProcessController* vtkIrradianceFilter::GetController()
{
  return this->Controller;
}

void vtkIrradianceFilter::RemoveAllDynamicTransforms()
{
  if (!this->Internals->Poses.empty())
  {
    this->Internals->Poses.clear();
    this->Modified();
  }
}

void vtkIrradianceFilter::SetDynamicMatrix(int i, const double elements[16])
{
  this->SetDynamicTransform(i, transformOf(elements));
}

// ParaView hands over numbers one by one.
void vtkIrradianceFilter::SetDynamicMatrix(int i, double m00, double m01, double m02, double m03,
  double m10, double m11, double m12, double m13, double m20, double m21, double m22, double m23,
  double m30, double m31, double m32, double m33)
{
  const double elements[16] = { m00, m01, m02, m03, m10, m11, m12, m13, m20, m21, m22, m23, m30,
    m31, m32, m33 };
  this->SetDynamicMatrix(i, elements);
}

void vtkIrradianceFilter::SetCellArray(const char* quantity, const char* name)
{
  const std::string wanted = quantity ? quantity : "";
  const auto& all = kArrayNames;
  const auto* const found = std::find(all.begin(), all.end(), wanted);
  if (found == all.end())
  {
    vtkErrorMacro(<< "SetCellArray: there is no quantity " << wanted);
    return;
  }
  const bool isNone = !name || std::string(name) == "None";
  this->SetInputArrayToProcess(static_cast<int>(found - all.begin()), 0, 0,
    vtkDataObject::FIELD_ASSOCIATION_CELLS, isNone ? "" : name);
}

double vtkIrradianceFilter::GetFigure(const char* name)
{
  vtkDataObject* output = this->GetOutputDataObject(0);
  vtkDataArray* array = output ? output->GetFieldData()->GetArray(name) : nullptr;
  if (!array || array->GetNumberOfTuples() != 1)
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  double sum = 0;
  for (int band = 0; band < array->GetNumberOfComponents(); ++band)
  {
    sum += array->GetComponent(0, band);
  }
  return sum;
}

double vtkIrradianceFilter::GetOldFigure(const char* getter, const char* name)
{
  name = name ? name : getter;
  this->Internals->OldNames.warn(
    this, std::string("Get") + getter + "()", std::string("call GetFigure(\"") + name + "\")");
  return this->GetFigure(name);
}

void vtkIrradianceFilter::SetMethod(int method)
{
  const std::size_t clamped = std::min<std::size_t>(std::max(0, method), PathTraced);
  const std::array<int, 4>& parts = PartsOfMethods[clamped];
  if (std::exchange(this->Internals->MethodParts, parts) != parts)
  {
    this->Modified();
  }
}

int vtkIrradianceFilter::GetMethod()
{
  const auto& all = PartsOfMethods;
  const auto* const found = std::find(all.begin(), all.end(), this->Internals->MethodParts);
  return found == all.end() ? -1 : static_cast<int>(found - all.begin());
}

void vtkIrradianceFilter::SetMethodPart(MethodPart part, int value)
{
  if (value < 0)
  {
    return; // ParaView's value where no old state sets one
  }
  constexpr std::array<const char*, 4> names{ "DirectLight", "CellEstimate", "GatherOn",
    "UnbiasedGather" };
  constexpr std::array<int, 4> most{ AutomaticDirectLight, AutomaticEstimate, AllCells, 1 };
  this->Internals->OldNames.warn(this, names[part], "set Method, which says all in one");
  // `Gathered` is the name of a method now.
  const int clamped =
    part == DirectLightPart && value == Gathered ? 1 : std::min(value, most[part]);
  if (std::exchange(this->Internals->MethodParts[part], clamped) != clamped)
  {
    this->Modified();
  }
}

int vtkIrradianceFilter::GetMethodPart(MethodPart part)
{
  return this->Internals->MethodParts[part];
}

void vtkIrradianceFilter::SetNumberOfGatherRays(int rays)
{
  if (rays != -1)
  {
    this->Internals->OldNames.warn(this, "NumberOfGatherRays", "set NumberOfRays");
    this->SetNumberOfRays(rays);
  }
}

void vtkIrradianceFilter::SetMaximumNumberOfWalks(vtkIdType walks)
{
  this->Internals->SetOld(
    this->Internals->MostWalks, walks, "MaximumNumberOfWalks", "set MaximumEffort");
}

vtkIdType vtkIrradianceFilter::GetMaximumNumberOfWalks()
{
  const vtkIdType most = this->Internals->MostWalks;
  return most == -1 ? Multiplied(this->NumberOfWalks, this->MaximumEffort, UsualWalks, MostWalks)
                    : most;
}

void vtkIrradianceFilter::SetMaximumNumberOfGatherRays(int rays)
{
  this->Internals->SetOld(
    this->Internals->MostRays, rays, "MaximumNumberOfGatherRays", "set MaximumEffort");
}

int vtkIrradianceFilter::GetMaximumNumberOfGatherRays()
{
  const int most = this->Internals->MostRays;
  return most == -1 ? static_cast<int>(Multiplied(
                        this->NumberOfRays, this->MaximumEffort, UsualRays, MostRaysOfTarget))
                    : most;
}

void vtkIrradianceFilter::SetNumberOfOutputWalks(vtkIdType walks)
{
  this->Internals->SetOld(
    this->NumberOfOutputWalks, walks, "NumberOfOutputWalks", "use a vtkPhotonWalksFilter");
}

vtkMTimeType vtkIrradianceFilter::GetMTime()
{
  if (this->HasChangedMeanwhile())
  {
    // An observer of the progress changed something, and the executive takes the output for newer.
    // This time makes the output older, until the filter runs again.
    this->Internals->Newest.Modified();
    return this->Internals->Newest;
  }
  return this->OwnTime();
}

/// The latest change of the filter and its transforms.
vtkMTimeType vtkIrradianceFilter::OwnTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  for (const auto& [connection, pose] : this->Internals->Poses)
  {
    time = std::max(time, pose->GetMTime());
  }
  return time;
}

/// The latest change of these and of anything upstream.
vtkMTimeType vtkIrradianceFilter::InputTime()
{
  vtkMTimeType time = this->OwnTime();
  for (int port = 0; port < 2; ++port)
  {
    for (int i = 0; i < this->GetNumberOfInputConnections(port); ++i)
    {
      time = std::max(time, upstreamTime(this, port, i));
    }
  }
  return time;
}

/// Whether something changed during a run, up to its last progress event, after RequestData.
bool vtkIrradianceFilter::HasChangedMeanwhile()
{
  vtkDataObject* output = vtkDataObject::GetData(this->GetOutputInformation(0));
  const vtkMTimeType time = this->Internals->Begun > 0 ? this->InputTime() : 0;
  return output && time > this->Internals->Begun && time <= output->GetUpdateTime();
}

vtkExecutive* vtkIrradianceFilter::CreateDefaultExecutive()
{
  return newRanksPipeline([this] { ControllerRanks(this->Internals->GetSharing()).withdraw(); });
}

int vtkIrradianceFilter::FillInputPortInformation(int, vtkInformation* info)
{
  setInputTypes(info, "vtkDataObjectTree", "vtkDataObject");
  info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

int vtkIrradianceFilter::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkMultiBlockDataSet" : "vtkPolyData");
  return 1;
}

vtkPolyData* vtkIrradianceFilter::GetWalksOutput()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(1));
}

// The executive copies only the times of the first connection; a scene has the times of all.
int vtkIrradianceFilter::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* output)
{
  uniteTimes(inputs, 2, output);
  return 1;
}

// Light comes from everywhere: every piece needs the whole scene. Of distributed inputs each
// process has a piece, and the filter puts them together.
int vtkIrradianceFilter::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  const ControllerRanks ranks(this->Internals->GetSharing());
  for (int port = 0; port < 2; ++port)
  {
    for (int i = 0; i < inputs[port]->GetNumberOfInformationObjects(); ++i)
    {
      vtkInformation* input = inputs[port]->GetInformationObject(i);
      this->DistributedInput ? requestPiece(input, ranks) : requestWhole(input);
    }
  }
  return 1;
}

int vtkIrradianceFilter::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputs);
  vtkPolyData* walks = vtkPolyData::GetData(outputs, 1);
  const int connections =
    inputs[0]->GetNumberOfInformationObjects() + inputs[1]->GetNumberOfInformationObjects();
  const bool isUnused = connections == 0 && this->Internals->Poses.empty();
  vtkInformation* asked =
    outputs->GetInformationObject(std::max(0, request->Get(vtkExecutive::FROM_OUTPUT_PORT())));
  auto* const timeKey = vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP();
  const auto time = asked->Has(timeKey) ? std::optional<double>(asked->Get(timeKey)) : std::nullopt;
  if (!isUnused)
  {
    this->Internals->Begun = this->InputTime();
  }
  ControllerRanks ranks(this->Internals->GetSharing());
  const auto compute = [&] {
    ranks.expectSame((isUnused ? 1 : 0) + (this->DistributedInput ? 2 : 0),
      "other inputs than on the first process");
    if (isUnused)
    {
      return;
    }
    SceneInputs read = this->Internals->GetInputs(inputs);
    this->Internals->Complete(read, ranks);
    const bool isLaterPiece = isEmptyPieceRequested(asked);
    const bool isEmpty = isLaterPiece && !this->DistributedInput;
    if (!isEmpty || ranks.areSeveral())
    {
      this->Internals->Compute(read, outputs->GetInformationObject(0), ranks, output, walks);
    }
    if (isEmpty)
    {
      output->Initialize();
      writeEmptyOutput(read, CheckedSettings(this), this->ComputeStandardError != 0, output);
    }
    if (isLaterPiece)
    {
      walks->Initialize(); // each walk once
    }
    for (int i = 0; time && i < outputs->GetNumberOfInformationObjects(); ++i)
    {
      vtkDataObject::GetData(outputs, i)
        ->GetInformation()
        ->Set(vtkDataObject::DATA_TIME_STEP(), *time);
    }
  };
  return runFilter(this, output, compute, &ranks);
}

void vtkIrradianceFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << this->GetMethod() << "\n"
     << indent << "NumberOfWalks: " << this->NumberOfWalks << "\n"
     << indent << "NumberOfRays: " << this->NumberOfRays << "\n"
     << indent << "Seed: " << this->Seed << "\n"
     << indent << "DefaultDiffuseReflectance: " << this->DefaultDiffuseReflectance << "\n"
     << indent << "TraversalMode: " << this->TraversalMode << "\n"
     << indent << "UpdateMode: " << this->UpdateMode << "\n"
     << indent << "CacheStaticHits: " << this->CacheStaticHits << "\n"
     << indent << "SeparateSides: " << this->SeparateSides << "\n"
     << indent << "NumberOfSpreadPhotons: " << this->NumberOfSpreadPhotons << "\n"
     << indent << "ComputeStandardError: " << this->ComputeStandardError << "\n"
     << indent << "ComputeLightGroups: " << this->ComputeLightGroups << "\n"
     << indent << "Light group factors: " << this->Internals->Factors.size() << "\n"
     << indent << "Light group seeds: " << this->Internals->Seeds.size() << "\n"
     << indent << "NumberOfReplicates: " << this->NumberOfReplicates << "\n"
     << indent << "TargetRelativeError: " << this->TargetRelativeError << "\n"
     << indent << "MaximumEffort: " << this->MaximumEffort << "\n"
     << indent << "RepairTimeBudget: " << this->RepairTimeBudget << "\n"
     << indent << "DistributedInput: " << this->DistributedInput << "\n"
     << indent << "Controller: " << this->GetController() << "\n"
     << indent << "NumberOfOutputWalks: " << this->NumberOfOutputWalks << "\n"
     << indent << "OutputWalksPort: " << this->OutputWalksPort << "\n"
     << indent << "OutputWalksConnection: " << this->OutputWalksConnection << "\n"
     << indent << "OutputWalksCell: " << this->OutputWalksCell << "\n"
     << indent << "PoseArrayName: " << (this->PoseArrayName ? this->PoseArrayName : "(none)")
     << "\n"
     << indent << "Dynamic transforms: " << this->Internals->Poses.size() << "\n";
  for (int i = 0; i < this->GetNumberOfInputConnections(1); ++i)
  {
    if (vtkObject* pose = this->GetDynamicTransform(i))
    {
      os << indent << "Dynamic transform " << i << ":\n";
      pose->PrintSelf(os, indent.GetNextIndent());
    }
  }
}
