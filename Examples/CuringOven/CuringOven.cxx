// SPDX-License-Identifier: BSD-3-Clause
/**
 * Machine parts with a UV coating ride on a conveyor through a tunnel with strip lamps. Which dose
 * does each cell of each part receive, J/m2, how well is it known, and where is the coating under-
 * or over-cured?
 *
 * The pipeline: parts -> vtkKeyFramedPose -> vtkIrradianceFilter (with the oven) ->
 * vtkRadiantExposureFilter, which leads all of them through time. See README.md in this folder.
 */
#include "CureTable.h"
#include "OutputFolder.h"
#include "OvenFilm.h"
#include "OvenOptions.h"
#include "ProductionLine.h"
#include "ProgressBar.h"
#include "RideLog.h"
#include "VtkErrors.h"

#include <vtkCompositeDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIrradianceFilter.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRadiantExposureFilter.h>
#include <vtkSMPTools.h>
#include <vtkTransform.h>
#include <vtkXMLMultiBlockDataWriter.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>

using namespace curingoven;
using movingteapot::ProgressBar;
using movingteapot::VtkErrors;

namespace
{

/** What a ride with so many walks came to. */
struct Outcome
{
  vtkSmartPointer<vtkMultiBlockDataSet> Scene; // with doses
  std::vector<Cure> Cures;
  std::vector<Step> Steps;
  double Accuracy = 0;
  double Seconds = 0; // all of it, but for pictures and comparisons
};

Outcome Ride(const OvenOptions& options, const std::vector<Part>& parts, int walks)
{
  const auto light = MakeLight(options, parts, walks);
  vtkNew<vtkRadiantExposureFilter> dose;
  dose->SetInputConnection(light->GetOutputPort());
  dose->SetIntegrationModeToUniform();
  dose->SetNumberOfTimeSteps(options.Steps - 1);
  dose->SetNumberOfSpreadPhotons(options.SpreadDose);

  using Clock = std::chrono::steady_clock;
  std::chrono::duration<double> aside{ 0 };
  OvenFilm film(options);
  ProgressBar bar(options.Steps);
  const RideLog log(options, parts, light, [&](int step, double time) {
    const auto begin = Clock::now();
    film.AddFrame(step, time, light->GetOutput());
    bar.BeginStep(1, "step " + std::to_string(step + 1) + " of " + std::to_string(options.Steps));
    aside += Clock::now() - begin;
  });
  const auto begin = Clock::now();
  const VtkErrors errors;
  dose->Update(); // an update of the light for each time
  std::chrono::duration<double> all = Clock::now() - begin - aside;
  bar.Finish();
  log.ThrowIfWrong();
  errors.ThrowIfAny("the dose cannot be computed");

  Outcome outcome;
  outcome.Scene = vtkMultiBlockDataSet::SafeDownCast(dose->GetOutputDataObject(0));
  outcome.Cures = Judge(outcome.Scene, parts, options);
  outcome.Accuracy = ReachedAccuracy(outcome.Scene, options);
  outcome.Steps = log.GetSteps();
  outcome.Seconds = all.count();
  for (const Step& step : outcome.Steps)
  {
    outcome.Seconds -= step.FreshSeconds;
  }
  film.WriteParts(outcome.Scene, parts);
  log.Write(options.Output);
  return outcome;
}

// As the error falls with the root of their number.
int MoreWalks(int walks, double reached, const OvenOptions& options)
{
  const double ratio = reached / options.Accuracy;
  const double factor = std::isfinite(ratio) ? std::clamp(1.2 * ratio * ratio, 1.5, 8.0) : 4.0;
  return int(std::min(double(options.MostWalks), std::ceil(walks * factor)));
}

void PrintAccuracy(const Outcome& outcome, int walks, const OvenOptions& options)
{
  std::printf("With %d walks ", walks);
  if (std::isinf(outcome.Accuracy))
  {
    std::printf("too few photons arrive on 5 %% of the parts' area or more to know their errors");
  }
  else
  {
    std::printf("95 %% of the parts' area is known within +-%.1f %%", 100 * outcome.Accuracy);
  }
  std::printf(
    options.Accuracy > 0 ? "; +-%.1f %% was asked for.\n" : ".\n", 100 * options.Accuracy);
}

template <typename Value>
double Mean(const std::vector<Step>& steps, Value value)
{
  double sum = 0;
  for (const Step& step : steps)
  {
    sum += value(step);
  }
  return sum / steps.size();
}

void PrintRide(const Outcome& outcome)
{
  const std::vector<Step> updates(outcome.Steps.begin() + 1, outcome.Steps.end());
  const double emitted = outcome.Steps.front().Emitted;
  std::printf(
    "Of the lamps' %.0f W, %.1f %% reach parts and %.1f %% leave the oven, on the average of "
    "all times; in\neach of the %zu steps emitted = absorbed + escaped, exactly.\n",
    emitted, 100 * Mean(outcome.Steps, [](const Step& s) { return s.OnParts; }) / emitted,
    100 * Mean(outcome.Steps, [](const Step& s) { return s.Escaped; }) / emitted,
    outcome.Steps.size());
  std::printf(
    "The first shooting took %.2f s, an update %.3f s on the average, the whole dose %.1f s; "
    "an update\nchanged %.1f %% of the walks and shot %.1f %% of the segments again.\n",
    outcome.Steps.front().Seconds, Mean(updates, [](const Step& s) { return s.Seconds; }),
    outcome.Seconds, 100 * Mean(updates, [](const Step& s) { return s.ChangedWalks; }),
    100 * Mean(updates, [](const Step& s) { return s.ShotSegments; }));
}

void PrintComparison(const Outcome& outcome)
{
  std::vector<Step> compared;
  std::copy_if(outcome.Steps.begin(), outcome.Steps.end(), std::back_inserter(compared),
    [](const Step& step) { return step.FreshSeconds > 0; });
  if (compared.empty())
  {
    return;
  }
  const double fresh = Mean(compared, [](const Step& s) { return s.FreshSeconds; });
  const double light =
    outcome.Steps.size() * Mean(outcome.Steps, [](const Step& s) { return s.Seconds; });
  const double whole = outcome.Seconds - light + outcome.Steps.size() * fresh;
  std::printf(
    "%zu steps were compared with fresh starts, %.2f s each: the same, bit for bit. Fresh "
    "starts at all steps\nwould take %.0f s, %.1f times as long as the whole dose took.\n",
    compared.size(), fresh, whole, whole / outcome.Seconds);
}

// The doses end where all parts were taken off. Here they stand on the belt, at the distances at
// which they ride.
void PlaceOnBelt(vtkMultiBlockDataSet* scene, const std::vector<Part>& parts)
{
  const std::vector<vtkPolyData*> shown = PartsOf(scene);
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    vtkNew<vtkTransform> beltFromPart;
    beltFromPart->Translate(Spacing * ((parts.size() - 1) / 2.0 - i), 0, 0);
    vtkNew<vtkPoints> points;
    beltFromPart->TransformPoints(parts[i].Mesh->GetPoints(), points);
    shown[i]->SetPoints(points);
  }
}

void WriteScene(const Outcome& outcome, const std::vector<Part>& parts, const OvenOptions& options)
{
  PlaceOnBelt(outcome.Scene, parts);
  vtkNew<vtkDoubleArray> limits; // J/m2
  limits->SetName("DoseLimits");
  limits->InsertNextValue(options.LeastDose);
  limits->InsertNextValue(options.MostDose);
  outcome.Scene->GetFieldData()->AddArray(limits);
  movingteapot::AddParaViewState(options.Output);
  const std::string file = options.Output + "/CuringOven.vtm";
  const VtkErrors errors;
  vtkNew<vtkXMLMultiBlockDataWriter> writer; // for ParaView
  writer->SetInputData(outcome.Scene);
  writer->SetFileName(file.c_str());
  writer->SetDataModeToBinary(); // Debian's ParaView cannot read the default, appended data
  writer->Write();
  errors.ThrowIfAny("--output: " + file + " cannot be written");
}

void Run(const OvenOptions& options)
{
  vtkSMPTools::Initialize(options.Threads);
  const std::vector<Part> parts = ReadParts(options);
  movingteapot::PrepareFolder(options.Output,
    R"((Parts|Cells|Steps)\.csv|(CuringOven|Parts)\.png|CuringOven\.(vtm|ogv)|ParaViewState\.py)"
    R"(|CuringOven(/CuringOven_\d+\.vtp)?)");
  for (const Part& part : parts)
  {
    std::cout << part.Name << " " << part.Mesh->GetNumberOfCells() << " cells, ";
  }
  std::cout << options.Steps << " steps, " << vtkSMPTools::GetEstimatedNumberOfThreads()
            << " threads." << std::endl;

  int walks = options.Walks;
  Outcome outcome = Ride(options, parts, walks);
  while (outcome.Accuracy > options.Accuracy && options.Accuracy > 0 && walks < options.MostWalks)
  {
    PrintAccuracy(outcome, walks, options);
    walks = MoreWalks(walks, outcome.Accuracy, options);
    outcome = Ride(options, parts, walks);
  }
  PrintTable(outcome.Cures, options);
  PrintAccuracy(outcome, walks, options);
  PrintRide(outcome);
  PrintComparison(outcome);
  WriteTables(outcome.Cures, outcome.Scene, parts, options.Output);
  WriteScene(outcome, parts, options);
  std::printf(
    "Written to %s: Parts.csv, Cells.csv, Steps.csv, CuringOven.vtm, ParaViewState.py%s\n",
    options.Output.c_str(), options.Pictures ? ", CuringOven.ogv, CuringOven.png, Parts.png" : "");
}

}

int main(int argc, char* argv[])
{
  try
  {
    OvenOptions options = ReadOptions({ argv + 1, argv + argc });
    if (options.Help)
    {
      std::cout << HelpText();
    }
    else
    {
      options.Pictures = options.Pictures && movingteapot::CanDraw();
      Run(options);
    }
    return EXIT_SUCCESS;
  }
  catch (const std::exception& error)
  {
    std::cerr << "CuringOven: " << error.what() << std::endl;
    return EXIT_FAILURE;
  }
}
