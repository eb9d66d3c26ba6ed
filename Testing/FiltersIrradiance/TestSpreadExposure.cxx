// SPDX-License-Identifier: BSD-3-Clause
// A dose that is spread over neighbouring cells, once, at the end.

#include "ExposureScenes.h"
#include "OutputChecks.h"

#include "vtkCellArray.h"
#include "vtkPoints.h"
#include "vtkSMPTools.h"

#include <cmath>
#include <utility>

using namespace ExposureScenes;

namespace
{

/// A room with a ball on its way, and its dose, with error bars.
struct SpreadWalk
{
  explicit SpreadWalk(int photons, const Scene& room = MakeEmptyRoom())
    : Room(room)
  {
    this->Light->ComputeStandardErrorOn();
    this->Light->AddInputConnection(1, this->Part->GetOutputPort());
    this->Dose->SetNumberOfSpreadPhotons(photons);
  }

  Scene Room;
  vtkSmartPointer<PartOverTime> Part = PartOverTime::Make(MakeBall(0.3, 12), kTimes,
    [](vtkPolyData* ball, double time) { MoveTo(ball, WalkThrough::PositionAt(time)); });
  vtkSmartPointer<vtkIrradianceFilter> Light = MakeFilter(this->Room, 4000);
  Exposure Dose = MakeExposure(this->Light);
};

/// J that a band brought to all cells of an output.
double EnergyOf(vtkRadiantExposureFilter* dose, unsigned int port, unsigned int i,
  const char* suffix = "", int band = 0)
{
  vtkPolyData* cells = OutputOf(BlocksOf(dose), port, i);
  vtkDataArray* exposure =
    cells->GetCellData()->GetArray((std::string("RadiantExposure") + suffix).c_str());
  double energy = 0;
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
  {
    energy += OutputChecks::AreaOf(cells, cell) * exposure->GetComponent(cell, band);
  }
  return energy;
}

int CountUnknown(vtkRadiantExposureFilter* dose)
{
  const auto errors = ValuesOf(
    OutputOf(BlocksOf(dose), 1, 0)->GetCellData()->GetArray("RadiantExposureStandardError"));
  return static_cast<int>(
    std::count_if(errors.begin(), errors.end(), [](double error) { return std::isnan(error); }));
}

}

TEST(SpreadExposure, ConservesEnergyOfEachBlockAndKnowsMore)
{
  SpreadWalk own(0), spread(250);
  own.Dose->Update();
  spread.Dose->Update();
  for (const auto& [port, i] : { std::pair{ 0u, 0u }, { 0u, 1u }, { 1u, 0u } })
  {
    const double energy = EnergyOf(own.Dose, port, i);
    EXPECT_NEAR(EnergyOf(spread.Dose, port, i), energy, 1e-12 * energy) << port << " " << i;
  }
  EXPECT_FALSE(IsSame(OutputBits(BlocksOf(own.Dose)), OutputBits(BlocksOf(spread.Dose))));
  EXPECT_GT(CountUnknown(own.Dose), 100);
  EXPECT_LT(CountUnknown(spread.Dose), 10);

  // The sums are kept upstream: what is off is as it was.
  spread.Dose->SetNumberOfSpreadPhotons(0);
  spread.Dose->Update();
  EXPECT_TRUE(IsSame(OutputBits(BlocksOf(own.Dose)), OutputBits(BlocksOf(spread.Dose))));
}

TEST(SpreadExposure, HasTheSameBitsForAnyNumberOfThreads)
{
  std::vector<OutputBits> bits;
  for (const int threads : { 1, 2 })
  {
    vtkSMPTools::LocalScope(vtkSMPTools::Config{ threads }, [&] {
      SpreadWalk walk(100);
      walk.Light->SeparateSidesOn();
      walk.Dose->Update();
      bits.emplace_back(BlocksOf(walk.Dose));
    });
  }
  EXPECT_TRUE(IsSame(bits[0], bits[1]));
}

// Bands are spread by themselves. Where every second cell is turned over, the light goes on at its
// other side.
TEST(SpreadExposure, ConservesEnergyOfBandsAndSides)
{
  Scene room = MakeEmptyRoom();
  room.Fixed[1] = MakeLamp({ 1.5, 1.5, 2.9 }, 0.5, { 100, 50, 10 });
  SpreadWalk own(0, room), spread(100, room);
  for (const SpreadWalk* walk : { &own, &spread })
  {
    for (vtkIdType cell = 0; cell < walk->Part->Model->GetNumberOfCells(); cell += 2)
    {
      walk->Part->Model->ReverseCell(cell);
    }
    walk->Light->SeparateSidesOn();
    walk->Dose->Update();
  }
  for (const int band : { 0, 1, 2 })
  {
    const auto energyOf = [&](const SpreadWalk& walk) {
      return EnergyOf(walk.Dose, 1, 0, "Front", band) + EnergyOf(walk.Dose, 1, 0, "Back", band);
    };
    EXPECT_NEAR(energyOf(spread), energyOf(own), 1e-12 * energyOf(own)) << band;
  }
  for (const vtkIdType cell : { 0, 1 })
  {
    const auto doseOf = [&](const SpreadWalk& walk, const char* side) {
      return OutputOf(BlocksOf(walk.Dose), 1, 0)
        ->GetCellData()
        ->GetArray((std::string("RadiantExposure") + side).c_str())
        ->GetComponent(cell, 0);
    };
    const char *lit = cell == 0 ? "Back" : "Front", *dark = cell == 0 ? "Front" : "Back";
    EXPECT_NE(doseOf(spread, lit), doseOf(own, lit)) << cell;
    EXPECT_GT(doseOf(spread, lit), 0) << cell;
    EXPECT_EQ(doseOf(spread, dark), 0) << cell;
  }
}

TEST(SpreadExposure, NeedsReplicatesAndAPossibleNumber)
{
  SpreadWalk walk(100);
  walk.Light->ComputeStandardErrorOff();
  ExpectWords(ErrorOf(walk.Dose),
    { "block", "no replicates of Irradiance", "NumberOfSpreadPhotons", "ComputeStandardError" });
  walk.Light->ComputeStandardErrorOn();
  walk.Dose->SetNumberOfSpreadPhotons(-1);
  ExpectWords(ErrorOf(walk.Dose), { "NumberOfSpreadPhotons is -1; 0 to 1000000 are possible" });
  walk.Dose->SetNumberOfSpreadPhotons(100);
  const auto observer = ErrorObserver::Watch(walk.Dose);
  walk.Dose->Update();
  EXPECT_TRUE(observer->Errors.empty());
  EXPECT_GT(EnergyOf(walk.Dose, 1, 0), 0);
}

// Only the cells of vtkPolyData have neighbours here: points have nothing that could be spread, nor
// need they replicates.
TEST(SpreadExposure, LeavesWhatHasNoPolygons)
{
  const Mesh point = MakePointLight({ 0, 0, 0 }, { 1 });
  const auto part = PartOverTime::Make(
    point, { 0, 2 }, [](vtkPolyData* data, double) { SetCellValues(data, "Irradiance", { 3 }); });
  const auto dose = MakeExposure(part);
  dose->SetNumberOfSpreadPhotons(100);
  dose->Update();
  ASSERT_EQ(dose->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::CELL), 1);
  EXPECT_EQ(SquareExposure(dose), 6);
}
