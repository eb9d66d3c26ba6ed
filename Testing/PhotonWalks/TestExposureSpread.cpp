// SPDX-License-Identifier: BSD-3-Clause
// Exposure, spread over the cells around: of photons that are drawn here, so that all is known
// beforehand.

#include "Exposure/AdaptiveTrapezoids.h"
#include "Exposure/ExposureSpread.h"
#include "Kit.h"

namespace irradiance::test
{
namespace
{

constexpr std::size_t kDoseReplicates = 16;
constexpr double kJoules = 0.5; // J/m2, that one photon brings to a cell

/// n * n squares of 1 m2, of two triangles each; those of odd number may be turned over.
ExposedSurface squares(std::size_t n, bool areTurned = false)
{
  ExposedSurface surface;
  surface.numberOfCells = n * n;
  for (std::size_t cell = 0; cell < n * n; ++cell)
  {
    const Vector3 corner(static_cast<double>(cell % n), static_cast<double>(cell / n), 0);
    const Vector3 right = corner + Vector3::UnitX(), up = corner + Vector3::UnitY(),
                  far = right + Vector3::UnitY();
    for (Triangle triangle : { Triangle{ corner, right, far }, Triangle{ corner, far, up } })
    {
      if (areTurned && cell % 2 == 1)
      {
        std::swap(triangle.b, triangle.c);
      }
      surface.triangles.push_back(triangle);
      surface.cellOfTriangle.push_back(static_cast<std::uint32_t>(cell));
    }
  }
  return surface;
}

/// Exposure to photons: photons(replicate, cell, band) arrive in each time.
struct Dose
{
  using Photons = std::function<double(std::size_t, std::size_t, std::size_t)>;

  explicit Dose(std::size_t cells, int bands = 1)
    : bands(static_cast<std::size_t>(bands))
    , exposure(cells * this->bands)
    , sums(exposure.size(), bands, kDoseReplicates)
  {
  }

  void add(const Photons& photons, double weight = 1)
  {
    const std::size_t cells = exposure.size() / bands;
    auto of = std::shared_ptr<double[]>(new double[exposure.size() * kDoseReplicates]);
    std::vector<double> mean(exposure.size()), photon(exposure.size(), kJoules);
    for (std::size_t cell = 0; cell < cells; ++cell)
    {
      for (std::size_t r = 0; r < kDoseReplicates; ++r)
      {
        for (std::size_t band = 0; band < bands; ++band)
        {
          const double arrived = photons(r, cell, band) * kJoules;
          of[(cell * kDoseReplicates + r) * bands + band] = arrived * kDoseReplicates;
          mean[cell * bands + band] += arrived;
        }
      }
    }
    sums.add(mean.data(), of, photon.data(), weight);
    for (std::size_t i = 0; i < mean.size(); ++i)
    {
      exposure[i] += weight * mean[i];
    }
  }

  double error(std::size_t cell) const { return sums.standardError(cell, exposure[cell]); }
  ExposedSide side() { return { &exposure, &sums }; }
  void spread(const ExposedSurface& surface, double photons)
  {
    Execution execution;
    spreadExposure(surface, static_cast<int>(bands), { side() }, photons, execution);
  }

  /// Of a band, in all cells of 1 m2: of the exposure and of each replicate, J.
  std::vector<double> energies(std::size_t band)
  {
    std::vector<double> energies(1 + kDoseReplicates);
    for (std::size_t i = band; i < exposure.size(); i += bands)
    {
      energies[0] += exposure[i];
      for (std::size_t r = 0; r < kDoseReplicates; ++r)
      {
        energies[1 + r] += sums.exposure(i, r);
      }
    }
    return energies;
  }

  std::size_t bands;
  std::vector<double> exposure;
  ReplicateSums sums;
};

/// Independent photons, so many to a cell on average.
Dose::Photons poisson(double mean, unsigned seed)
{
  return [random = std::make_shared<std::mt19937_64>(seed),
           count = std::poisson_distribution<int>(mean / kDoseReplicates)](
           std::size_t, std::size_t, std::size_t) mutable { return double(count(*random)); };
}

double squaredDeviation(const std::vector<double>& values, double mean)
{
  return std::accumulate(values.begin(), values.end(), 0.0,
           [&](double sum, double value) { return sum + std::pow(value / mean - 1, 2); }) /
    static_cast<double>(values.size());
}

// The sums are exact in quanta of 2^-52 of the energy; what is read and written is rounded to half
// of one.
TEST(ExposureSpread, ConservesEnergyInEachBand)
{
  Dose dose(900, 3);
  dose.add([random = std::mt19937_64(1)](std::size_t, std::size_t cell, std::size_t band) mutable {
    return double(random() % (1 + cell % 7 * (band + 1)));
  });
  Dose before = dose;
  dose.spread(squares(30), 2000);
  EXPECT_NE(dose.exposure, before.exposure);
  for (const std::size_t band : { 0u, 1u, 2u })
  {
    const std::vector<double> after = dose.energies(band), expected = before.energies(band);
    for (std::size_t i = 0; i < after.size(); ++i)
    {
      EXPECT_NEAR(after[i], expected[i], 1e-12 * expected[i]) << band << " " << i;
    }
  }
}

// All replicates say something else, but of all cells the same.
TEST(ExposureSpread, KeepsAUniformDose)
{
  Dose dose(400);
  dose.add([](std::size_t r, std::size_t, std::size_t) { return 3.0 + double(r % 3); });
  const std::vector<double> before = dose.exposure;
  dose.spread(squares(20), 1e6);
  for (std::size_t i = 0; i < before.size(); ++i)
  {
    EXPECT_NEAR(dose.exposure[i], before[i], 1e-9 * before[i]);
    EXPECT_NEAR(dose.sums.exposure(i, 1), 4 * kJoules * kDoseReplicates, 1e-9);
  }
}

// Cells that receive as many photons as they draw on keep their bits and their errors, beside small
// ones too.
TEST(ExposureSpread, LeavesCellsWithEnoughPhotons)
{
  Dose dose(100);
  dose.add(poisson(30, 2));
  const Dose before = dose;
  dose.spread(squares(10), 20);
  EXPECT_EQ(dose.exposure, before.exposure);
  ExposedSurface surface = squares(10);
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
  {
    Triangle& triangle = surface.triangles[i];
    const bool isLarge = surface.cellOfTriangle[i] < 50;
    triangle = transformed(
      { (isLarge ? 20.0 : 1.0) * Matrix3::Identity(), Vector3(0, 0, isLarge ? 0.0 : 1.0) },
      triangle);
  }
  dose.spread(surface, 10); // a width of about 130 m2
  for (std::size_t i = 0; i < 50; ++i)
  {
    EXPECT_EQ(dose.exposure[i], before.exposure[i]);
    EXPECT_EQ(std::isnan(dose.error(i)), std::isnan(before.error(i))) << i;
    EXPECT_TRUE(std::isnan(before.error(i)) || dose.error(i) == before.error(i)) << i;
  }
  EXPECT_NE(dose.exposure[60], before.exposure[60]);
}

// Of n photons a dose is known to 1 / sqrt(n). Four surfaces of 48 * 48 / 32 neighbourhoods give
// the mean square to 8 % (standard deviation), borders and the area that a point fills to a fifth:
// 1.7 is exceeded once in 10^6.
TEST(ExposureSpread, BringsTheNoiseOfThePhotonsAskedFor)
{
  constexpr double n = 64, mean = 2;
  double square = 0, claimed = 0;
  for (const unsigned seed : { 1u, 2u, 3u, 4u })
  {
    Dose dose(48 * 48);
    dose.add(poisson(mean, seed));
    EXPECT_NEAR(squaredDeviation(dose.exposure, mean * kJoules), 1 / mean, 0.1);
    dose.spread(squares(48), n);
    square += squaredDeviation(dose.exposure, mean * kJoules) / 4;
    for (std::size_t i = 0; i < dose.exposure.size(); ++i)
    {
      claimed += std::isnan(dose.error(i))
        ? 0
        : std::pow(dose.error(i) / (mean * kJoules), 2) / (4 * 48 * 48);
    }
  }
  EXPECT_GT(square, 1 / n / 1.7);
  EXPECT_LT(square, 1.7 / n);
  EXPECT_NEAR(claimed, square, 0.4 * square);
}

// What the same walks bring at ten times are no ten photons. By other walks it is: then a tenth is
// as wide.
TEST(ExposureSpread, CountsAWalkOnce)
{
  Dose once(900), often(900), anew(900);
  once.add(poisson(1, 1));
  for (unsigned time = 0; time < 8; ++time)
  {
    often.add(poisson(1, 1));
    anew.add(poisson(1, 1 + time));
  }
  for (Dose* dose : { &once, &often, &anew })
  {
    dose->spread(squares(30), 100);
  }
  for (std::size_t i = 0; i < once.exposure.size(); ++i)
  {
    EXPECT_NEAR(often.exposure[i], 8 * once.exposure[i], 1e-9);
  }
  // Of 100 photons both. Neighbourhoods of 100 cells are few, so each mean square is within a
  // factor of 3.
  EXPECT_NEAR(std::log(squaredDeviation(often.exposure, 8 * kJoules) /
                squaredDeviation(anew.exposure, 8 * kJoules)),
    0, std::log(3));
}

// On the front of one cell, the back of the next, the same light goes on; the other sides stay
// dark.
TEST(ExposureSpread, GoesOnWhereCellsAreTurnedOver)
{
  const auto surface = squares(21, true);
  Dose front(441), back(441);
  const auto lit = [&](std::size_t turned) {
    return [turned, photons = poisson(2, 3)](std::size_t r, std::size_t cell, std::size_t band) {
      return cell % 2 == turned ? photons(r, cell, band) : 0.0;
    };
  };
  front.add(lit(0));
  back.add(lit(1));
  const double energy = front.energies(0)[0] + back.energies(0)[0];
  Execution execution;
  spreadExposure(surface, 1, { front.side(), back.side() }, 60, execution);
  EXPECT_NEAR(front.energies(0)[0] + back.energies(0)[0], energy, 1e-12 * energy);
  std::vector<double> both;
  for (std::size_t cell = 0; cell < 441; ++cell)
  {
    const Dose &light = cell % 2 == 0 ? front : back, &dark = cell % 2 == 0 ? back : front;
    EXPECT_EQ(dark.exposure[cell], 0);
    both.push_back(light.exposure[cell]);
  }
  EXPECT_LT(squaredDeviation(both, 2 * kJoules), 3.0 / 60);
}

// Two photons a cell are too few for an error; of the 100 around it is known. Twelve surfaces of 40
// * 40 / 50 neighbourhoods: the share has a standard deviation of 1.1 %.
TEST(ExposureSpread, HasIntervalsThatHoldTheTruth)
{
  IntervalCount intervals(kDoseReplicates);
  for (unsigned seed = 1; seed <= 12; ++seed)
  {
    Dose dose(1600);
    dose.add(poisson(2, 100 + seed));
    EXPECT_TRUE(std::isnan(dose.error(0)));
    dose.spread(squares(40), 100);
    for (std::size_t i = 0; i < dose.exposure.size(); ++i)
    {
      intervals.add(dose.exposure[i] - 2 * kJoules, dose.error(i));
    }
  }
  intervals.expectHonest();
  EXPECT_GT(intervals.shareKnown(), 0.95);
  EXPECT_GT(intervals.shareThatHolds(), 0.93);
  EXPECT_LT(intervals.shareThatHolds(), 0.98);
}

// Too few on the whole body: nothing is known, wherever they are.
TEST(ExposureSpread, KnowsNoErrorOfFewPhotons)
{
  Dose dose(400);
  dose.add(
    [](std::size_t r, std::size_t cell, std::size_t) { return cell == 10 + 17 * r ? 1.0 : 0.0; });
  dose.spread(squares(20), 1000);
  EXPECT_GT(dose.exposure[399], 0);
  for (std::size_t i = 0; i < 400; ++i)
  {
    EXPECT_TRUE(std::isnan(dose.error(i)));
  }
}

// Nothing arrived, or nothing is known of photons, as all replicates are the same.
TEST(ExposureSpread, LeavesWhatHasNoNoise)
{
  for (const double photons : { 0.0, 3.0 })
  {
    Dose dose(100);
    dose.add([&](std::size_t, std::size_t cell, std::size_t) { return photons * double(cell); });
    const std::vector<double> before = dose.exposure;
    dose.spread(squares(10), 1e6);
    EXPECT_EQ(dose.exposure, before);
  }
}

struct Sample
{
  double time, value;
};

/// They must come in the order of time.
struct Sums
{
  double total = 0, first = -HUGE_VAL, last = -HUGE_VAL;
  void add(const Sample& sample, double weight)
  {
    EXPECT_LT(last, sample.time);
    first = std::isfinite(first) ? first : sample.time;
    last = sample.time;
    total += weight * sample.value;
  }
  void close() {}
  void append(const Sums& later)
  {
    EXPECT_EQ(last, later.first);
    last = later.last;
    total += later.total;
  }
};

using Rule = AdaptiveTrapezoids<Sample, Sums>;

/// One block; its error is that of the trapezoid over both intervals.
std::vector<IntervalMeasure> measure(const std::array<const Sample*, 3>& at)
{
  const double first = trapezoidWeight(at[0]->time, at[1]->time) * (at[0]->value + at[1]->value);
  const double second = trapezoidWeight(at[1]->time, at[2]->time) * (at[1]->value + at[2]->value);
  const double whole = trapezoidWeight(at[0]->time, at[2]->time) * (at[0]->value + at[2]->value);
  return { { first + second, std::abs(first + second - whole), 0 } };
}

Rule integrated(const std::function<double(double)>& f, const TimeSpan& span, double tolerance)
{
  constexpr std::size_t mostIntervals = 100000;
  Rule rule(firstTimes({}, span, 4), tolerance, mostIntervals);
  double progress = 0;
  while (!rule.isDone())
  {
    EXPECT_GE(rule.progress(), progress);
    progress = rule.progress();
    const double time = rule.nextTimes(1).front();
    rule.take({ time, f(time) }, measure);
  }
  EXPECT_EQ(rule.progress(), 1);
  return rule;
}

TEST(AdaptiveTrapezoids, AStraightLineNeedsTheFirstTimesAlone)
{
  Rule rule = integrated([](double t) { return 3 + 2 * t; }, { 0, 8 }, 1e-9);
  EXPECT_EQ(rule.times(), (std::vector<double>{ 0, 2, 4, 6, 8 }));
  EXPECT_EQ(rule.takeSums().total, 88);
}

TEST(AdaptiveTrapezoids, TheErrorIsBelowTheTolerance)
{
  const struct
  {
    std::function<double(double)> f;
    double integral; // over 0..1
  } cases[] = {
    { [](double t) { return t * t; }, 1 / 3.0 },
    { [](double t) { return std::sqrt(t); }, 2 / 3.0 },
    { [](double t) { return t < 0.3 ? 0.0 : 1.0; }, 0.7 },
    { [](double t) { return 1e-4 / ((t - 0.6) * (t - 0.6) + 1e-4); },
      1e-2 * (std::atan(40.0) + std::atan(60.0)) },
  };
  for (const auto& [f, integral] : cases)
  {
    for (const double tolerance : { 1e-2, 1e-4 })
    {
      Rule rule = integrated(f, { 0, 1 }, tolerance);
      EXPECT_LE(rule.halving().relativeError(), tolerance);
      EXPECT_NEAR(rule.takeSums().total / integral, 1, tolerance) << integral;
    }
  }
}

// Whatever was settled when, the sums are the trapezoidal rule over all times that were visited.
TEST(AdaptiveTrapezoids, SumsAreThoseOfAllTimes)
{
  const auto f = [](double t) { return std::exp(-5 * t) + (t > 0.71 ? 1 : 0); };
  Rule rule = integrated(f, { 0, 1 }, 1e-3);
  const std::vector<double> times = rule.times();
  EXPECT_GT(times.size(), 20u);
  double total = 0;
  for (std::size_t i = 1; i < times.size(); ++i)
  {
    ASSERT_LT(times[i - 1], times[i]);
    total += trapezoidWeight(times[i - 1], times[i]) * (f(times[i - 1]) + f(times[i]));
  }
  EXPECT_NEAR(rule.takeSums().total, total, 1e-14);
}

TEST(AdaptiveTrapezoids, ItEndsWhereNoMoreIntervalsAreAllowed)
{
  constexpr std::size_t mostIntervals = 12;
  Rule rule({ 0, 1, 2 }, 1e-12, mostIntervals);
  while (!rule.isDone())
  {
    const double time = rule.nextTimes(1).front();
    rule.take({ time, std::exp(time) }, measure);
  }
  EXPECT_EQ(rule.times().size(), mostIntervals + 1);
  EXPECT_GT(rule.halving().relativeError(), 1e-12);
}

TEST(IntegrationTimes, FirstTimesKeepStepsAndAreAnOddNumber)
{
  EXPECT_EQ(firstTimes({ -1, 0, 3, 9 }, { 0, 4 }, 4), (std::vector<double>{ 0, 1, 2, 3, 4 }));
  EXPECT_EQ(firstTimes({}, { 0, 3 }, 3), (std::vector<double>{ 0, 0.5, 1, 2, 3 }));
  EXPECT_EQ(firstTimes({ 0.5 }, { 0, 3 }, 1), (std::vector<double>{ 0, 0.5, 3 }));
}

}
}
