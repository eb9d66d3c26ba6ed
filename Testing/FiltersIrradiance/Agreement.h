// SPDX-License-Identifier: BSD-3-Clause
#ifndef Agreement_h
#define Agreement_h

#include "OutputChecks.h"
#include "TestScenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <string>

/// How far the values of two filters are apart, in units of their standard errors.
struct Distance
{
  double Squares = 0; ///< sum over cells whose errors are known
  int Cells = 0;
  double ErrorPart = 0; ///< power of the standard errors, of
  double Power = 0;     ///< that of all cells

  Distance(vtkIrradianceFilter* a, vtkIrradianceFilter* b)
  {
    const auto ofA = OutputChecks::LeavesOf(a->GetOutput()),
               ofB = OutputChecks::LeavesOf(b->GetOutput());
    for (std::size_t leaf = 0; leaf < ofA.size(); ++leaf)
    {
      for (const std::string& side : OutputChecks::SidesOf(a))
      {
        this->Add(ofA[leaf], ofB[leaf], side);
      }
    }
  }

private:
  void Add(vtkPolyData* a, vtkPolyData* b, const std::string& side)
  {
    const auto arrayOf = [](vtkPolyData* data, const std::string& name) {
      return data->GetCellData()->GetArray(name.c_str());
    };
    vtkDataArray* const values[] = { arrayOf(a, "Irradiance" + side),
      arrayOf(b, "Irradiance" + side) };
    vtkDataArray* const errors[] = { arrayOf(a, "Irradiance" + side + "StandardError"),
      arrayOf(b, "Irradiance" + side + "StandardError") };
    for (vtkIdType cell = 0; cell < a->GetNumberOfCells(); ++cell)
    {
      for (int band = 0; band < values[0]->GetNumberOfComponents(); ++band)
      {
        const double variance = std::pow(errors[0]->GetComponent(cell, band), 2) +
          std::pow(errors[1]->GetComponent(cell, band), 2);
        if (variance > 0) // known
        {
          const double off =
            values[0]->GetComponent(cell, band) - values[1]->GetComponent(cell, band);
          this->Squares += off * off / variance;
          this->ErrorPart += std::sqrt(variance) * OutputChecks::AreaOf(a, cell);
          this->Power += values[1]->GetComponent(cell, band) * OutputChecks::AreaOf(a, cell);
          ++this->Cells;
        }
      }
    }
  }
};

/// Shoots and gathers the light of a scene, which must agree.
///
/// The squared distance of a cell in units of its error has the mean n / (n - 2) and, over cells,
/// about the variance 2 n^2 (n - 1) / ((n - 2)^2 (n - 4)), for n >= 63 degrees of freedom. The sum
/// is off by 5 of its standard deviations once in 10^6, with cells that know of each other perhaps
/// once in 10^4; nets make it smaller.
inline void ExpectAgreement(const TestScenes::Scene& scene, bool sides)
{
  const auto make = [&](int seed) {
    const auto filter = TestScenes::MakeFilter(scene, 200000);
    filter->SetSeed(seed);
    filter->SetSeparateSides(sides);
    filter->ComputeStandardErrorOn();
    filter->SetNumberOfReplicates(64);
    return filter;
  };
  const auto shot = make(1), gathered = make(2);
  gathered->SetDirectLightToGathered();
  shot->Update();
  gathered->Update();
  const Distance distance(gathered, shot);
  const double cells = distance.Cells, n = 63, mean = n / (n - 2);
  const double sigma = mean * std::sqrt(2 * (n - 1) / (n - 4) * cells);
  std::cout << distance.Squares << " of " << cells << " cells, " << mean * cells << " +- " << sigma
            << " expected; errors are " << distance.ErrorPart / distance.Power << "\n";
  EXPECT_GT(cells, 50);
  EXPECT_LT(distance.Squares, mean * cells + 5 * sigma);
  EXPECT_GT(distance.Squares, 0.3 * cells) << "the errors are too large";
  EXPECT_LT(distance.ErrorPart, 0.05 * distance.Power) << "else a test of nothing";
}

#endif
