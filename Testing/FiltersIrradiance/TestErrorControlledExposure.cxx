// SPDX-License-Identifier: BSD-3-Clause
// Times that follow from the irradiance: the worst intervals are halved until the error is small
// enough.

#include "ExposureScenes.h"

#include "vtkCellArray.h"
#include "vtkWeakPointer.h"

#include <functional>
#include <iterator>
#include <map>
#include <numeric>
#include <set>

using namespace ExposureScenes;

namespace
{

/// The irradiance of cells at some times, and the documented order of adding it up.
struct DocumentedSum
{
  std::map<double, std::vector<double>> Irradiance;
  std::vector<double> First; ///< times, of which each three make a pair of intervals

  std::vector<double> Of(double start, double middle, double end) const
  {
    const auto inner = Irradiance.upper_bound(start);
    if (inner->first != middle || std::next(inner)->first != end)
    {
      return Add(Of(start, start + (middle - start) / 2, middle),
        Of(middle, middle + (end - middle) / 2, end));
    }
    std::vector<double> sum(inner->second.size());
    const auto add = [&](double time, double weight) {
      for (std::size_t cell = 0; cell < sum.size(); ++cell)
      {
        sum[cell] += weight * Irradiance.at(time)[cell];
      }
    };
    add(start, 0.5 * (middle - start));
    add(middle, 0.5 * (end - start));
    add(end, 0.5 * (end - middle));
    return sum;
  }
  /// Of the pairs from the first to before the last.
  std::vector<double> OfPairs(std::size_t first, std::size_t last) const
  {
    const std::size_t half = first + (last - first) / 2;
    return last - first == 1 ? Of(First[2 * first], First[2 * first + 1], First[2 * first + 2])
                             : Add(OfPairs(first, half), OfPairs(half, last));
  }
  std::vector<double> Whole() const { return OfPairs(0, First.size() / 2); }

  static std::vector<double> Add(std::vector<double> a, const std::vector<double>& b)
  {
    std::transform(a.begin(), a.end(), b.begin(), a.begin(), std::plus<>());
    return a;
  }
};

}

TEST(ErrorControlledExposure, IsTheSumOverFreshFiltersAndContinues)
{
  const WalkThrough scene(40000);
  const auto exposure = MakeErrorControlled(scene.Irradiance, 1, 0.001);
  exposure->Update();
  const std::vector<double> times = IntegrationTimesOf(exposure), visits = scene.Ball->Visits;
  EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
  EXPECT_EQ(
    std::set<double>(visits.begin(), visits.end()), std::set<double>(times.begin(), times.end()));
  EXPECT_EQ(visits.size(), times.size()) << "every time once";
  EXPECT_EQ(FieldOf(exposure, "NumberOfTimeSteps"), static_cast<double>(times.size() - 1));
  EXPECT_LE(FieldOf(exposure, "TimeIntegrationError"), 0.001);
  const std::vector<double>& first = kTimes;
  EXPECT_TRUE(std::includes(times.begin(), times.end(), first.begin(), first.end()));
  EXPECT_GT(times.size(), first.size()) << "nothing was halved";
  DocumentedSum sums[2]{ { {}, first }, { {}, first } };
  for (const double time : times)
  {
    const auto fresh = scene.FreshAt(time);
    for (const unsigned int port : { 0u, 1u })
    {
      sums[port].Irradiance[time] = ValuesOf(IrradianceOf(fresh, port, 0));
    }
  }
  for (const unsigned int port : { 0u, 1u })
  {
    EXPECT_EQ(ValuesOf(ExposureOf(exposure, port, 0)), sums[port].Whole());
  }

  const OutputBits bits(BlocksOf(exposure));
  scene.Ball->Visits.clear();
  const auto aborter = EventObserver::Watch(exposure);
  for (const int events : { 3, 5, 0 }) // first among the first intervals, then while halving
  {
    aborter->AbortIn = events;
    exposure->SetAbortExecute(0);
    exposure->Modified();
    exposure->Update();
  }
  EXPECT_EQ(scene.Ball->Visits, visits);
  EXPECT_TRUE(IsSame(bits, OutputBits(BlocksOf(exposure))));
}

// Added up by halves or in the order of time: exposures and their errors are the same, with a part
// that comes, goes and comes again.
TEST(ErrorControlledExposure, HasTheErrorBarsOfItsTimes)
{
  WalkThrough scene(3000);
  scene.Irradiance->ComputeStandardErrorOn();
  const auto isThere = [](double time) {
    return (time > 0.2 && time < 0.6) || (time > 0.8 && time < 1.3);
  };
  scene.Ball->Change = [isThere](vtkPolyData* ball, double time) {
    if (!isThere(time))
    {
      ball->Initialize();
      return;
    }
    MoveTo(ball, WalkThrough::PositionAt(std::floor(time * 8) / 8)); // so photons come in runs
  };
  const auto exposure = MakeErrorControlled(scene.Irradiance, 5, 0.02);
  exposure->Update();
  scene.Ball->Times = IntegrationTimesOf(exposure);
  EXPECT_GT(scene.Ball->Times.size(), 10u);
  const auto valuesOf = [&](vtkRadiantExposureFilter* filter) {
    std::vector<double> values;
    for (const unsigned int port : { 0u, 1u })
    {
      for (const char* name : { "RadiantExposure", "RadiantExposureStandardError" })
      {
        const auto some =
          ValuesOf(OutputOf(BlocksOf(filter), port, 0)->GetCellData()->GetArray(name));
        values.insert(values.end(), some.begin(), some.end());
      }
    }
    values.push_back(FieldOf(filter, "AbsorbedEnergy"));
    values.push_back(FieldOf(filter, "PowerBalanceError"));
    return values;
  };
  scene.Ball->Modified();
  const auto inOrder = MakeExposure(scene.Irradiance);
  inOrder->Update();
  EXPECT_EQ(IntegrationTimesOf(inOrder), scene.Ball->Times);
  const auto values = valuesOf(exposure), expected = valuesOf(inOrder);
  ASSERT_EQ(values.size(), expected.size());
  int known = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    ASSERT_EQ(std::isnan(values[i]), std::isnan(expected[i])) << i;
    EXPECT_TRUE(std::isnan(values[i]) || std::abs(values[i] - expected[i]) <= 1e-12 * expected[i])
      << i << ": " << values[i] << " for " << expected[i];
    known += std::isnan(values[i]) ? 0 : 1;
  }
  EXPECT_GT(known, 48);
}

// A lamp that passes: the error is within the tolerance, with the more times the smaller that is,
// and most of them where the irradiance changes.
TEST(ErrorControlledExposure, ReachesItsTolerance)
{
  const auto square =
    MakeLitSquare({ 0, 10 }, [](double time) { return 1 / (1 + std::pow((time - 3) / 0.3, 2)); });
  const double exact = 0.3 * (std::atan(7 / 0.3) + std::atan(3 / 0.3));
  const auto exposure = MakeErrorControlled(square, 10, 1);
  std::size_t fewer = 0;
  for (const double tolerance : { 0.1, 0.01, 0.001 })
  {
    exposure->SetRelativeTolerance(tolerance);
    exposure->Update();
    EXPECT_NEAR(SquareExposure(exposure), exact, tolerance * exact);
    EXPECT_LE(FieldOf(exposure, "TimeIntegrationError"), tolerance);
    EXPECT_GE(FieldOf(exposure, "TimeIntegrationError") * exact,
      std::abs(SquareExposure(exposure) - exact));
    const auto times = IntegrationTimesOf(exposure);
    EXPECT_GT(times.size(), fewer);
    fewer = times.size();
    if (tolerance == 0.001)
    {
      const auto inPeak =
        std::count_if(times.begin(), times.end(), [](double time) { return time > 2 && time < 4; });
      EXPECT_GT(2 * static_cast<std::size_t>(inPeak), times.size());
    }
  }
}

// A part that appears. Each halving halves the error, so it is within any tolerance after some.
TEST(ErrorControlledExposure, EndsAtAJump)
{
  const auto square = PartOverTime::Make(MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1),
    { 0, 1 }, [](vtkPolyData* part, double time) {
      if (time < 1.0 / 3)
      {
        part->Initialize();
        return;
      }
      SetCellValues(part, "Irradiance", { 3 });
    });
  const auto exposure = MakeErrorControlled(square, 2, 1e-4);
  const auto observer = ErrorObserver::Watch(exposure);
  exposure->Update();
  EXPECT_NEAR(SquareExposure(exposure), 2, 1e-4 * 2);
  EXPECT_LT(FieldOf(exposure, "NumberOfTimeSteps"), 40);
  EXPECT_TRUE(observer->Warnings.empty());

  exposure->SetMaximumNumberOfTimeSteps(10);
  exposure->Update();
  EXPECT_LE(FieldOf(exposure, "NumberOfTimeSteps"), 10);
  ExpectOne(observer->Warnings,
    { "RelativeTolerance 0.0001", "MaximumNumberOfTimeSteps 10", "the input: 0.0" });
  EXPECT_GT(FieldOf(exposure, "TimeIntegrationError"), 1e-4);
  EXPECT_NEAR(SquareExposure(exposure), 2, 2 * FieldOf(exposure, "TimeIntegrationError"));
}

TEST(ErrorControlledExposure, RejectsBadSettings)
{
  const auto square = MakeLitSquare({ 0, 1 }, [](double) { return 5; });
  const auto exposure = MakeExposure(square);
  exposure->SetIntegrationModeToErrorControlled();
  exposure->SetRelativeTolerance(0);
  ExpectWords(ErrorOf(exposure), { "RelativeTolerance is 0" });
  exposure->SetRelativeTolerance(std::nan(""));
  ExpectWords(ErrorOf(exposure), { "RelativeTolerance is nan" });
  exposure->SetRelativeTolerance(0.1);
  exposure->SetMaximumNumberOfTimeSteps(19);
  ExpectWords(ErrorOf(exposure), { "MaximumNumberOfTimeSteps is 19", "20" });
  exposure->SetMaximumNumberOfTimeSteps(20);
  exposure->Update();
  EXPECT_DOUBLE_EQ(SquareExposure(exposure), 5);
  EXPECT_EQ(FieldOf(exposure, "NumberOfTimeSteps"), 20);
}

// It shines and flickers until it leaves. Steps that are spent in the order of time are used up
// before that.
TEST(ErrorControlledExposure, HalvesTheWorstFirst)
{
  constexpr double leaves = 7.3;
  const auto square = PartOverTime::Make(MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1),
    { 0, 10 }, [](vtkPolyData* part, double time) {
      if (time > leaves)
      {
        part->Initialize();
        return;
      }
      SetCellValues(part, "Irradiance", { 10 + std::sin(300 * time) });
    });
  const double exact = 10 * leaves + (1 - std::cos(300 * leaves)) / 300;
  const auto exposure = MakeErrorControlled(square, 4, 1e-6);
  const auto observer = ErrorObserver::Watch(exposure);
  exposure->SetMaximumNumberOfTimeSteps(200);
  exposure->Update();
  EXPECT_EQ(observer->Warnings.size(), 1u);
  EXPECT_EQ(FieldOf(exposure, "NumberOfTimeSteps"), 200);
  EXPECT_LT(FieldOf(exposure, "TimeIntegrationError"), 0.1) << "the flicker is a tenth";
  const double error = std::abs(SquareExposure(exposure) - exact);
  EXPECT_LE(error, FieldOf(exposure, "TimeIntegrationError") * exact);
  EXPECT_LE(error, 0.02 * exact);
}

// A triangle of light between two keys, far narrower than the first intervals.
TEST(ErrorControlledExposure, SeesAFlashBetweenTheKeys)
{
  const auto square = MakeLitSquare({ 0, 4, 4.01, 4.02, 10 },
    [](double time) { return 1 + 1e5 * std::max(0.0, 0.01 - std::abs(time - 4.01)); });
  const double exact = 10 + 1e5 * 0.01 * 0.01;
  const auto exposure = MakeErrorControlled(square, 4, 1e-3);
  exposure->Update();
  EXPECT_NEAR(SquareExposure(exposure), exact, 1e-3 * exact);
  const auto times = IntegrationTimesOf(exposure);
  for (const double key : square->Times)
  {
    EXPECT_TRUE(std::binary_search(times.begin(), times.end(), key)) << key;
  }
  // No first interval is longer than a quarter of the span.
  EXPECT_TRUE(std::adjacent_find(times.begin(), times.end(),
                [](double a, double b) { return b - a > 2.5; }) == times.end());
}

// A part flashes up now and then over 400 steps. Times are held only where the halving goes on.
TEST(ErrorControlledExposure, HoldsFewTimes)
{
  std::vector<vtkWeakPointer<vtkDataArray>> arrays;
  std::size_t mostHeld = 0;
  std::vector<double> steps(401);
  std::iota(steps.begin(), steps.end(), 0);
  const auto square = PartOverTime::Make(MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1),
    steps, [&](vtkPolyData* part, double time) {
      SetCellValues(part, "Irradiance", { 1 + (std::fmod(time, 100) > 70.3 ? 1.0 : 0.0) });
      arrays.emplace_back(part->GetCellData()->GetArray("Irradiance"));
      const auto held = std::count_if(
        arrays.begin(), arrays.end(), [](const auto& array) { return array != nullptr; });
      mostHeld = std::max(mostHeld, static_cast<std::size_t>(held));
    });
  const auto exposure = MakeErrorControlled(square, 20, 1e-4);
  exposure->Update();
  EXPECT_NEAR(SquareExposure(exposure), 400 + 4 * 29.7, 1e-4 * 520);
  EXPECT_GT(arrays.size(), 400u);
  EXPECT_LT(mostHeld, 40u);
}

// Cells of fewer points than they need have no area.
TEST(ErrorControlledExposure, TakesCellsWithoutArea)
{
  const auto square = MakeLitSquare({ 0, 1 }, [](double time) { return 3 + time; });
  vtkNew<vtkCellArray> polygons, lines, strips;
  vtkNew<vtkIdList> points;
  square->Model->GetPolys()->GetCellAtId(0, points);
  polygons->InsertNextCell(points);
  for (const vtkIdType count : { 0, 1, 2 })
  {
    points->SetNumberOfIds(count);
    polygons->InsertNextCell(points);
    strips->InsertNextCell(points);
    lines->InsertNextCell(points);
  }
  square->Model->SetPolys(polygons);
  square->Model->SetStrips(strips);
  square->Model->SetLines(lines);
  const auto exposure = MakeErrorControlled(square, 4, 0.01);
  exposure->Update();
  vtkDataArray* doses = vtkPolyData::SafeDownCast(exposure->GetOutputDataObject(0))
                          ->GetCellData()
                          ->GetArray("RadiantExposure");
  ASSERT_EQ(doses->GetNumberOfTuples(), 10);
  EXPECT_DOUBLE_EQ(doses->GetComponent(9, 0), 3.5);
}

// The filter upstream says so, and the dose is that without them.
TEST(ErrorControlledExposure, OfASceneWithCellsWithoutArea)
{
  const WalkThrough scene(1000), plain(1000);
  vtkNew<vtkCellArray> polygons;
  polygons->DeepCopy(scene.Ball->Model->GetPolys());
  const std::array<vtkIdType, 2> ids{ 0, 1 };
  polygons->InsertNextCell(1, ids.data());
  polygons->InsertNextCell(2, ids.data());
  scene.Ball->Model->SetPolys(polygons);
  const auto exposure = MakeErrorControlled(scene.Irradiance, 4, 0.1),
             expected = MakeErrorControlled(plain.Irradiance, 4, 0.1);
  const auto upstream = ErrorObserver::Watch(scene.Irradiance);
  const auto own = ErrorObserver::Watch(exposure);
  exposure->Update();
  expected->Update();
  ASSERT_FALSE(upstream->Warnings.empty());
  ExpectWords(upstream->Warnings[0], { "2", "area" });
  EXPECT_TRUE(own->Warnings.empty() && own->Errors.empty());
  EXPECT_EQ(IntegrationTimesOf(exposure), IntegrationTimesOf(expected));
  vtkDataArray *doses = ExposureOf(exposure, 1, 0), *plainDoses = ExposureOf(expected, 1, 0);
  ASSERT_EQ(doses->GetNumberOfTuples(), plainDoses->GetNumberOfTuples() + 2);
  for (vtkIdType i = 0; i < doses->GetNumberOfTuples(); ++i)
  {
    EXPECT_EQ(doses->GetComponent(i, 0),
      i < plainDoses->GetNumberOfTuples() ? plainDoses->GetComponent(i, 0) : 0);
  }
}
