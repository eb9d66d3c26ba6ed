// SPDX-License-Identifier: BSD-3-Clause
// The error control of an exposure and the noise of photons: what it follows, and what it does not.

#include "ExposureScenes.h"

#include <functional>
#include <random>

using namespace ExposureScenes;

namespace
{

/// Rows of squares of 1 m2 with an irradiance that a function of cell and time gives, in photons of
/// 0.5 W/m2 each, which say so if they are asked.
vtkSmartPointer<PartOverTime> MakePhotonSquares(
  int rows, const std::function<double(int, double)>& photons)
{
  const double side = rows;
  return PartOverTime::Make(MakeRectangle({ 0, 0, 0 }, { side, 0, 0 }, { 0, side, 0 }, rows),
    { 0, 1 }, [photons](vtkPolyData* part, double time) {
      SetCellValues(part, "Irradiance", { 0 });
      SetCellValues(part, "IrradianceOfPhoton", { 0.5 });
      vtkDataArray* irradiance = part->GetCellData()->GetArray("Irradiance");
      for (vtkIdType cell = 0; cell < part->GetNumberOfCells(); ++cell)
      {
        irradiance->SetComponent(cell, 0, 0.5 * photons(static_cast<int>(cell), time));
      }
    });
}

/// A number of photons that depends on nothing but these.
double PoissonAt(int cell, double time, double mean)
{
  std::minstd_rand bits(static_cast<unsigned int>(1 + cell + time * (1 << 30)));
  bits.discard(2);
  return std::poisson_distribution<int>(mean)(bits);
}

}

// 400 cells receive 1, 10 or 100 photons each, others at each time. Of the mean of 21 times the
// standard deviation is at most 1.2 % of the exposure of all; 6 of them are exceeded once in 10^9.
TEST(ExposureNoise, StopsAtTheNoiseOfPhotons)
{
  for (const double mean : { 1.0, 10.0, 100.0 })
  {
    const auto squares =
      MakePhotonSquares(20, [mean](int cell, double time) { return PoissonAt(cell, time, mean); });
    const auto exposure = MakeErrorControlled(squares, 20, 0.01);
    const auto observer = ErrorObserver::Watch(exposure);
    exposure->Update();
    EXPECT_LE(FieldOf(exposure, "NumberOfTimeSteps"), 22) << mean;
    EXPECT_GT(FieldOf(exposure, "TimeIntegrationNoise"), 0.2 / std::sqrt(mean));
    EXPECT_LE(FieldOf(exposure, "TimeIntegrationError"), 0.01);
    EXPECT_TRUE(observer->Warnings.empty());
  }
}

// A spot of light crosses the squares, row by row. It brings 20 photons to a cell on average, so no
// cell can tell, but their sums can: the dose of the first times alone would be in 10 stripes.
TEST(ExposureNoise, SeesThroughTheNoise)
{
  constexpr int rows = 50;
  constexpr double width = 0.03; // of the spot, of all rows
  const auto squares = MakePhotonSquares(rows, [](int cell, double time) {
    const double row = (cell / rows + 0.5) / rows;
    return PoissonAt(cell, time, 20 * std::exp(-0.5 * std::pow((row - time) / width, 2)));
  });
  const auto exposure = MakeErrorControlled(squares, 10, 0.05);
  exposure->Update();
  EXPECT_LE(FieldOf(exposure, "NumberOfTimeSteps"), 200);
  // In the middle, far from the ends, every row has the same: sqrt(2 pi) width * 20 photons.
  const double exact = 0.5 * 20 * width * std::sqrt(2 * 3.14159265358979);
  vtkDataArray* doses = vtkPolyData::SafeDownCast(exposure->GetOutputDataObject(0))
                          ->GetCellData()
                          ->GetArray("RadiantExposure");
  for (int row = 10; row < 40; ++row)
  {
    double mean = 0;
    for (int i = 0; i < rows; ++i)
    {
      mean += doses->GetComponent(row * rows + i, 0) / rows;
    }
    // A tenth, and 5 standard deviations of its noise.
    EXPECT_NEAR(mean, exact, 0.1 * exact + 0.1 * exact) << row;
  }
}

// The ball meets other photons at each place, and each is a step of its irradiance.
TEST(ExposureNoise, DoesNotFollowSinglePhotons)
{
  const WalkThrough scene(2000);
  const auto exposure = MakeErrorControlled(scene.Irradiance, 20, 0.01);
  const auto observer = ErrorObserver::Watch(exposure);
  exposure->Update();
  EXPECT_LE(FieldOf(exposure, "NumberOfTimeSteps"), 100);
  EXPECT_GT(FieldOf(exposure, "TimeIntegrationNoise"), 0.01);
  EXPECT_TRUE(observer->Warnings.empty());
}
