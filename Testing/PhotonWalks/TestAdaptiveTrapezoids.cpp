// SPDX-License-Identifier: BSD-3-Clause
#include "Exposure/AdaptiveTrapezoids.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace irradiance::test
{
namespace
{

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
    rule.take({ rule.nextTime(), f(rule.nextTime()) }, measure);
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
    rule.take({ rule.nextTime(), std::exp(rule.nextTime()) }, measure);
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
