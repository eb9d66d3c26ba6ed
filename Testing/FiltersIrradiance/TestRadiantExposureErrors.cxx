// SPDX-License-Identifier: BSD-3-Clause
// The standard error of the exposure: irradiances of different times come from the same walks.

#include "ExposureScenes.h"
#include "StripLamp.h"

#include <cmath>

using namespace ExposureScenes;

namespace
{

vtkCellData* CellsOf(vtkAlgorithm* filter, unsigned int port, unsigned int i)
{
  auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  return OutputOf(output, port, i)->GetCellData();
}

/// A small room, lit from above, with a ball in it.
Scene MakeRoomWithBall()
{
  return { MakeEmptyRoom().Fixed, { MakeMoving(MakeBall(0.3, 6), { 1, 1, 1 }) } };
}

/// A room through which a ball moves at 1 m/s, with error bars.
vtkSmartPointer<vtkIrradianceFilter> MakeFilterWithError(const std::vector<double>& times)
{
  const auto ball = PartOverTime::Make(MakeBall(0.4, 6), times, [](vtkPolyData* part, double time) {
    MoveTo(part, { 0.6 + time, 1.5, 1.5 });
  });
  const auto irradiance = MakeFilter(MakeEmptyRoom(), 16000);
  irradiance->AddInputConnection(1, ball->GetOutputPort());
  irradiance->ComputeStandardErrorOn();
  return irradiance;
}

}

// If nothing changes, the exposure and its error are the irradiance and its error, times the time;
// known and unknown are the same cells.
TEST(RadiantExposureError, OfAStillSceneIsThatOfTheIrradiance)
{
  Scene scene = MakeRoomWithBall();
  scene.Fixed[1] = MakeLamp({ 1.5, 1.5, 2.9 }, 0.5, { 100, 50, 0 });
  const auto irradiance = MakeFilter(scene, 3200);
  irradiance->ComputeStandardErrorOn();
  const auto exposure = MakeExposure(irradiance);
  exposure->SetIntegrationModeToUniform();
  exposure->SetNumberOfTimeSteps(3);
  exposure->SetStartTime(2);
  exposure->SetEndTime(6);
  for (const int method : { vtkIrradianceFilter::Walks, vtkIrradianceFilter::SpreadWalks })
  {
    irradiance->SetMethod(method);
    for (const bool areSides : { false, true })
    {
      irradiance->SetSeparateSides(areSides);
      exposure->Update();
      int known = 0, unknown = 0;
      for (const std::string side : { "", "Front", "Back" })
      {
        for (const unsigned int port : { 0u, 1u })
        {
          const auto errors =
            ValuesOf(CellsOf(irradiance, port, 0)
                       ->GetArray(("Irradiance" + side + "StandardError").c_str()));
          const auto exposed =
            ValuesOf(CellsOf(exposure, port, 0)
                       ->GetArray(("RadiantExposure" + side + "StandardError").c_str()));
          EXPECT_EQ(errors.empty(), side.empty() == areSides);
          ASSERT_EQ(errors.size(), exposed.size());
          for (std::size_t i = 0; i < errors.size(); ++i)
          {
            ASSERT_EQ(std::isnan(errors[i]), std::isnan(exposed[i])) << side << i;
            ++(std::isnan(errors[i]) ? unknown : known);
            EXPECT_TRUE(std::isnan(errors[i]) || std::abs(exposed[i] / (4 * errors[i]) - 1) < 1e-9)
              << exposed[i] << " is not 4 times " << errors[i];
          }
        }
      }
      EXPECT_GT(known, 20);
      EXPECT_GT(unknown, 20);
    }
  }
  EXPECT_NEAR(FieldOf(exposure, "ConfidenceFactor"), 2.1314, 1e-4);
}

// Over the seeds, exposures scatter as their standard errors say: the ratio of the two variances,
// averaged over the cells, is off by 5 of its standard errors once in 10^6. Errors whose squares
// are added are too small.
TEST(RadiantExposureError, IsTheScatterOverSeeds)
{
  const auto irradiance = MakeFilterWithError({ 0, 0.25, 0.5, 0.75, 1, 1.25 });
  const auto exposure = MakeExposure(irradiance);
  constexpr int seeds = 40;
  struct Cell
  {
    double Sum = 0, Squares = 0, Variance = 0;
  };
  std::array<std::vector<Cell>, 2> cells;
  for (int seed = 1; seed <= seeds; ++seed)
  {
    irradiance->SetSeed(seed);
    exposure->Update();
    for (const unsigned int port : { 0u, 1u })
    {
      vtkCellData* exposed = CellsOf(exposure, port, 0);
      const auto values = ValuesOf(exposed->GetArray("RadiantExposure"));
      const auto errors = ValuesOf(exposed->GetArray("RadiantExposureStandardError"));
      ASSERT_EQ(values.size(), errors.size());
      cells[port].resize(values.size());
      for (std::size_t i = 0; i < values.size(); ++i)
      {
        cells[port][i].Sum += values[i];
        cells[port][i].Squares += values[i] * values[i];
        cells[port][i].Variance += errors[i] * errors[i] / seeds;
      }
    }
  }
  for (const std::vector<Cell>& ofPort : cells)
  {
    double ratio = 0, known = 0; // cells whose errors are known with all seeds
    for (const Cell& cell : ofPort)
    {
      const double scatter = (cell.Squares - cell.Sum * cell.Sum / seeds) / (seeds - 1);
      ratio += std::isnan(cell.Variance) ? 0 : cell.Variance / scatter;
      known += std::isnan(cell.Variance) ? 0 : 1;
    }
    ASSERT_GE(known, 16);
    // 1 / scatter has the mean 1 + 2 / (seeds - 3) in units of 1 / variance.
    const double expected = (seeds - 1.0) / (seeds - 3.0);
    EXPECT_NEAR(ratio / known, expected, 5 * std::sqrt((2.0 / seeds + 2.0 / seeds / 15) / known));
  }
}

// Standard deviations obey the triangle inequality: added, they are an upper bound. Their squares,
// added, are far too small where the photons stay the same.
TEST(RadiantExposureError, IsBetweenSquaresAddedAndErrorsAdded)
{
  const std::vector<double> times{ 0, 0.25, 0.5, 0.75, 1, 1.25 };
  const auto irradiance = MakeFilterWithError(times);
  const auto exposure = MakeExposure(irradiance);
  exposure->Update();
  const auto errors = ValuesOf(CellsOf(exposure, 0, 0)->GetArray("RadiantExposureStandardError"));
  std::vector<double> sum(errors.size()), squares(errors.size());
  for (std::size_t i = 0; i < times.size(); ++i)
  {
    const double weight = i == 0 || i + 1 == times.size() ? 0.125 : 0.25;
    irradiance->UpdateTimeStep(times[i]);
    EXPECT_FALSE(CellsOf(irradiance, 0, 0)->HasArray("IrradianceReplicates"))
      << "nobody asks for them any more";
    const auto then = ValuesOf(CellsOf(irradiance, 0, 0)->GetArray("IrradianceStandardError"));
    for (std::size_t cell = 0; cell < errors.size(); ++cell)
    {
      sum[cell] += weight * then[cell];
      squares[cell] += std::pow(weight * then[cell], 2);
    }
  }
  double excess = 0;
  for (std::size_t cell = 0; cell < errors.size(); ++cell)
  {
    EXPECT_LE(errors[cell], sum[cell] * (1 + 1e-9));
    excess += errors[cell] * errors[cell] / squares[cell] / static_cast<double>(errors.size());
  }
  EXPECT_GT(excess, 2);
}

TEST(RadiantExposureError, WithoutReplicatesIsTheSumOfErrors)
{
  const auto square = PartOverTime::Make(MakeRectangle({ 0, 0, 0 }, { 2, 0, 0 }, { 0, 1, 0 }, 1),
    { 0, 1, 3 }, [](vtkPolyData* part, double time) {
      SetCellValues(part, "Irradiance", { 5, 6, 7 });
      SetCellValues(
        part, "IrradianceStandardError", { 0.5, 1 + time, time == 3 ? std::nan("") : 1.0 });
    });
  const auto exposure = MakeExposure(square);
  exposure->Update();
  auto* cells = vtkPolyData::SafeDownCast(exposure->GetOutputDataObject(0))->GetCellData();
  vtkDataArray* errors = cells->GetArray("RadiantExposureStandardError");
  ASSERT_TRUE(errors);
  EXPECT_EQ(errors->GetNumberOfComponents(), 3);
  EXPECT_DOUBLE_EQ(errors->GetComponent(0, 0), 1.5);
  EXPECT_DOUBLE_EQ(errors->GetComponent(0, 1), 0.5 * 1 + 1.5 * 2 + 1 * 4);
  EXPECT_TRUE(std::isnan(errors->GetComponent(0, 2)));
}

namespace
{

/// The standard error of the exposure of a square with these replicates at the times 0, 1 and 2,
/// whose weights are 1/2, 1 and 1/2. The irradiance is their mean, a photon's is 1.
double ErrorOf(const std::vector<std::vector<double>>& replicates)
{
  const auto square = PartOverTime::Make(MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1),
    { 0, 1, 2 }, [&](vtkPolyData* part, double time) {
      const std::vector<double>& now = replicates[static_cast<std::size_t>(time)];
      double mean = 0;
      for (const double replicate : now)
      {
        mean += replicate / static_cast<double>(now.size());
      }
      SetCellValues(part, "Irradiance", { mean });
      SetCellValues(part, "IrradianceReplicates", now);
      SetCellValues(part, "IrradianceOfPhoton", { 1 });
    });
  const auto exposure = MakeExposure(square);
  exposure->Update();
  auto* cells = vtkPolyData::SafeDownCast(exposure->GetOutputDataObject(0))->GetCellData();
  return cells->GetArray("RadiantExposureStandardError")->GetComponent(0, 0);
}

}

TEST(RadiantExposureError, FollowsFromTheReplicates)
{
  // Exposures of 60 + 90 + 30 and 40 + 110 + 50.
  EXPECT_DOUBLE_EQ(ErrorOf({ { 120, 80 }, { 90, 110 }, { 60, 100 } }), 10);
  // Replicates that agree by chance: a photon's step, of all the time as nothing changes ...
  EXPECT_DOUBLE_EQ(ErrorOf({ { 30, 30 }, { 30, 30 }, { 30, 30 } }), std::sqrt(2.0 / 12) * 2);
  // ... and of half a second and 3 halves of one.
  EXPECT_DOUBLE_EQ(
    ErrorOf({ { 30, 30 }, { 31, 31 }, { 31, 31 } }), std::sqrt(2.0 / 12 * (0.25 + 2.25)));
  // 24 photons are too few; 25 that stay are enough.
  EXPECT_TRUE(std::isnan(ErrorOf({ { 24, 24 }, { 24, 24 }, { 24, 24 } })));
  EXPECT_GT(ErrorOf({ { 25, 25 }, { 25, 25 }, { 25, 25 } }), 0);
  // 10 photons at a time, 30 in all: known if the replicates say that the error is a fifth at most.
  EXPECT_DOUBLE_EQ(ErrorOf({ { 8, 12 }, { 12, 8 }, { 8, 12 } }), std::sqrt(2.0 / 12 * 1.5));
  EXPECT_DOUBLE_EQ(ErrorOf({ { 12, 8 }, { 11, 9 }, { 13, 7 } }), (23.5 - 16.5) / 2);
  EXPECT_TRUE(std::isnan(ErrorOf({ { 15, 5 }, { 16, 4 }, { 15, 5 } })));
  EXPECT_TRUE(std::isnan(ErrorOf({ { 0, 0 }, { 0, 0 }, { 0, 0 } })));
  // 26 at one time and none at the others: the lit time has enough.
  EXPECT_DOUBLE_EQ(ErrorOf({ { 0, 0 }, { 40, 12 }, { 0, 0 } }), 14);
}

TEST(RadiantExposureError, IsThereOnlyIfTheInputHasErrors)
{
  const auto irradiance = MakeFilter(MakeRoomWithBall(), 500);
  const auto exposure = MakeExposure(irradiance);
  exposure->SetIntegrationModeToUniform();
  exposure->SetStartTime(0);
  exposure->SetEndTime(1);
  exposure->Update();
  EXPECT_FALSE(CellsOf(exposure, 0, 0)->HasArray("RadiantExposureStandardError"));
  irradiance->ComputeStandardErrorOn();
  exposure->Update();
  EXPECT_TRUE(CellsOf(exposure, 0, 0)->HasArray("RadiantExposureStandardError"));
  EXPECT_FALSE(CellsOf(exposure, 0, 0)->HasArray("IrradianceReplicates"));
}

namespace
{

/// A plate rides under a strip lamp, with error bars.
struct PlateUnderStripLamp : StripLamp
{
  explicit PlateUnderStripLamp(vtkIdType walks)
  {
    this->Plate = PartOverTime::Make(
      StripLamp::Plate(), { 0, Way / Speed }, [](vtkPolyData* part, double time) {
        MoveTo(part, { Speed * time - Way / 2, 0, 0 });
      });
    this->Irradiance = MakeFilter({ { Lamp() }, {} }, walks);
    this->Irradiance->SetDefaultDiffuseReflectance(0);
    this->Irradiance->AddInputConnection(1, this->Plate->GetOutputPort());
    this->Irradiance->ComputeStandardErrorOn();
    this->Exposed = MakeExposure(this->Irradiance);
    this->Exposed->SetIntegrationModeToUniform();
    this->Exposed->SetNumberOfTimeSteps(32); // less than Height each; smooth and 0 at the ends
  }

  std::vector<double> Values(const char* array)
  {
    return ValuesOf(CellsOf(Exposed, 1, 0)->GetArray(array));
  }

  vtkSmartPointer<PartOverTime> Plate;
  vtkSmartPointer<vtkIrradianceFilter> Irradiance;
  Exposure Exposed;
};

}

// Student's t with 15 degrees of freedom exceeds 6.5 once in 10^5, so with 3 rows the error bars
// fail by chance for one seed in 30,000. 1 % are 4 standard errors: 3 rows fail for one seed in
// 300.
TEST(RadiantExposureError, OfAPlateUnderAStripLampCoversTheClosedForm)
{
  PlateUnderStripLamp scene(640000);
  scene.Exposed->Update();
  const auto values = scene.Values("RadiantExposure"),
             errors = scene.Values("RadiantExposureStandardError");
  for (int row = 0; row < StripLamp::Rows; ++row)
  {
    const auto i = static_cast<std::size_t>(row);
    const double exact = StripLamp::ExposureOfRow(row);
    EXPECT_NEAR(values[i], exact, 0.01 * exact);
    EXPECT_NEAR(values[i], exact, 6.5 * errors[i]);
    EXPECT_LT(errors[i], 0.004 * exact);
  }
}

// 40 seeds with 3 rows each: 95 % of 120 intervals, +- 2 % (a standard deviation). Below 85 % or
// with all of them once in 500 runs at most.
TEST(RadiantExposureError, CoversTheClosedFormAsOftenAsItSays)
{
  PlateUnderStripLamp scene(1600);
  constexpr int intervals = 40 * StripLamp::Rows;
  int inside = 0;
  for (int seed = 1; seed <= 40; ++seed)
  {
    scene.Irradiance->SetSeed(seed);
    scene.Exposed->Update();
    const auto values = scene.Values("RadiantExposure"),
               errors = scene.Values("RadiantExposureStandardError");
    for (int row = 0; row < StripLamp::Rows; ++row)
    {
      const auto i = static_cast<std::size_t>(row);
      inside += std::abs(values[i] - StripLamp::ExposureOfRow(row)) <= 2.1314 * errors[i] ? 1 : 0;
    }
  }
  EXPECT_GE(inside, 0.85 * intervals);
  EXPECT_LT(inside, intervals);
}
