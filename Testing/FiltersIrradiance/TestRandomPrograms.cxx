// SPDX-License-Identifier: BSD-3-Clause
// Random programs of what users do to one long-lived filter, which keeps the bits of a fresh one
// (compared after a third of the operations), and so do an eye and sensors that look at its
// photons. VTKIRRADIANCE_TEST_EFFORT=9 runs nine times as many, VTKIRRADIANCE_TEST_PROGRAM=17 runs
// number 17 alone and prints each operation. Two builds that compute the same bits print the same
// digest.

#include "RandomProgram.h"

#include <gtest/gtest.h>

#include <iterator>

using namespace RandomPrograms;

TEST(RandomPrograms, UpdatesEqualFreshFilters)
{
  const std::vector<Operation> operations(std::begin(Operations), std::end(Operations));
  Counts counts;
  ForEachProgram(28, [&](int program, bool isAloud) {
    Trial trial(static_cast<std::uint64_t>(program), counts);
    if (program % 3 == 1) // else few choose for long
    {
      trial.Set().DirectLight = vtkIrradianceFilter::AutomaticDirectLight;
      trial.Set().CellEstimate = vtkIrradianceFilter::AutomaticEstimate;
      trial.Set().NumberOfWalks *= 16; // until others are drawn: then rays are too many
      trial.Apply();
    }
    if (program % 3 == 2) // else few gather for long
    {
      trial.Set().DirectLight = vtkIrradianceFilter::Gathered;
      trial.Set().CellEstimate =
        program % 2 == 1 ? vtkIrradianceFilter::FinalGather : vtkIrradianceFilter::Sums;
      trial.Given.Look.HasEye = trial.Given.Look.HasSensors = false;
      trial.Apply();
    }
    if (program == 21)
    {
      AddManyParts(trial, 1000);
    }
    RunProgram(program, trial, operations, isAloud);
  });
  Print(counts);
}
