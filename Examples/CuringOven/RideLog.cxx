// SPDX-License-Identifier: BSD-3-Clause
#include "RideLog.h"

#include "CureTable.h"
#include "VtkErrors.h"

#include <vtkCellData.h>
#include <vtkCellSizeFilter.h>
#include <vtkCommand.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkIrradianceFilter.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace curingoven
{
namespace
{

double FieldOf(vtkMultiBlockDataSet* scene, const char* name)
{
  return scene->GetFieldData()->GetArray(name)->GetTuple1(0);
}

bool HaveSameBits(vtkDataArray* a, vtkDataArray* b)
{
  return (!a && !b) ||
    (a && b && a->GetNumberOfValues() == b->GetNumberOfValues() &&
      (a->GetNumberOfValues() == 0 ||
        std::memcmp(a->GetVoidPointer(0), b->GetVoidPointer(0),
          a->GetNumberOfValues() * a->GetDataTypeSize()) == 0));
}

bool HaveSameBits(vtkMultiBlockDataSet* a, vtkMultiBlockDataSet* b)
{
  const auto left = vtkCompositeDataSet::GetDataSets<vtkPolyData>(a);
  const auto right = vtkCompositeDataSet::GetDataSets<vtkPolyData>(b);
  bool areSame = left.size() == right.size() && !left.empty();
  for (std::size_t i = 0; areSame && i < left.size(); ++i)
  {
    for (const char* name : { "Irradiance", "IrradianceStandardError" })
    {
      areSame = areSame &&
        HaveSameBits(
          left[i]->GetCellData()->GetArray(name), right[i]->GetCellData()->GetArray(name));
    }
  }
  return areSame;
}

double SecondsSince(std::chrono::steady_clock::time_point begin)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}

RideLog::RideLog(const OvenOptions& options, const std::vector<Part>& parts,
  vtkIrradianceFilter* light, std::function<void(int, double)> show)
  : Options(options)
  , Parts(parts)
  , Light(light)
  , Show(std::move(show))
{
  for (const Part& part : parts)
  {
    vtkNew<vtkCellSizeFilter> sizes;
    sizes->SetInputData(part.Mesh);
    sizes->Update();
    this->Areas.emplace_back(sizes->GetPolyDataOutput()->GetCellData()->GetArray("Area"));
  }
  light->AddObserver(vtkCommand::StartEvent, this, &RideLog::BeginStep);
  light->AddObserver(vtkCommand::EndEvent, this, &RideLog::EndStep);
}

void RideLog::BeginStep()
{
  this->Begin = Clock::now();
}

void RideLog::EndStep()
{
  vtkMultiBlockDataSet* scene = this->Light->GetOutput();
  if (this->Wrong || !scene->GetFieldData()->HasArray("EmittedPower"))
  {
    return; // the filter has said what is wrong
  }
  try
  {
    Step step;
    step.Seconds = SecondsSince(this->Begin);
    step.Time = scene->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP());
    step.Emitted = FieldOf(scene, "EmittedPower");
    step.Absorbed = FieldOf(scene, "AbsorbedPower");
    step.Escaped = FieldOf(scene, "EscapedPower");
    step.OnParts = this->PowerOnParts(scene);
    const bool isFirst = this->Steps.empty();
    step.ChangedWalks =
      isFirst ? 1 : FieldOf(scene, "NumberOfInvalidWalks") / FieldOf(scene, "NumberOfWalks");
    step.ShotSegments =
      isFirst ? 1 : FieldOf(scene, "NumberOfRepairedSegments") / FieldOf(scene, "NumberOfSegments");
    this->Check(step);
    const int number = int(this->Steps.size());
    const auto comparedBefore = [&](int steps) {
      return static_cast<long long>(steps) * this->Options.Compare / this->Options.Steps;
    };
    if (comparedBefore(number + 1) > comparedBefore(number)) // spread evenly
    {
      step.FreshSeconds = this->CompareWithFreshStart(step.Time);
    }
    this->Steps.push_back(step);
    this->Show(number, step.Time);
  }
  catch (...)
  {
    this->Wrong = std::current_exception();
  }
}

double RideLog::PowerOnParts(vtkMultiBlockDataSet* scene) const
{
  double power = 0;
  auto areas = this->Areas.begin();
  for (vtkPolyData* part : PartsOf(scene))
  {
    vtkDataArray* irradiance = part->GetCellData()->GetArray("Irradiance");
    for (vtkIdType i = 0; i < part->GetNumberOfCells(); ++i)
    {
      power += (*areas)->GetTuple1(i) * irradiance->GetTuple1(i);
    }
    ++areas;
  }
  return power;
}

void RideLog::Check(const Step& step) const
{
  if (step.Emitted != step.Absorbed + step.Escaped)
  {
    char text[160];
    std::snprintf(text, sizeof text, "at %g s %.17g W are emitted, but %.17g W absorbed or escaped",
      step.Time, step.Emitted, step.Absorbed + step.Escaped);
    throw std::runtime_error(text);
  }
}

double RideLog::CompareWithFreshStart(double time)
{
  const auto fresh = MakeLight(this->Options, this->Parts, this->Light->GetNumberOfWalks());
  fresh->SetUpdateModeToRebuild(); // stores no walks, so it is as fast as can be
  fresh->UpdateInformation();
  const auto begin = Clock::now();
  fresh->UpdateTimeStep(time);
  const double seconds = SecondsSince(begin);
  if (!HaveSameBits(this->Light->GetOutput(), fresh->GetOutput()))
  {
    throw std::runtime_error(
      "--compare: the light at " + std::to_string(time) + " s differs from a fresh start's");
  }
  return seconds;
}

void RideLog::ThrowIfWrong() const
{
  if (this->Wrong)
  {
    std::rethrow_exception(this->Wrong);
  }
}

void RideLog::Write(const std::string& folder) const
{
  const std::string name = folder + "/Steps.csv";
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
    std::fopen(name.c_str(), "w"), std::fclose);
  if (!file)
  {
    throw std::runtime_error("--output: " + name + " cannot be written");
  }
  std::fprintf(file.get(),
    "time_s,emitted_W,absorbed_W,escaped_W,on_parts_W,changed_walks,shot_segments,seconds\n");
  for (const Step& step : this->Steps)
  {
    std::fprintf(file.get(), "%.17g,%.17g,%.17g,%.17g,%.17g,%.6g,%.6g,%.4g\n", step.Time,
      step.Emitted, step.Absorbed, step.Escaped, step.OnParts, step.ChangedWalks, step.ShotSegments,
      step.Seconds);
  }
}

}
