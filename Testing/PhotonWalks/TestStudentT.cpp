// SPDX-License-Identifier: BSD-3-Clause
#include "Estimates/StudentT.h"

#include <gtest/gtest.h>

#include <cmath>

namespace irradiance::test
{
namespace
{

// Two-sided quantiles from the NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.6.7.2.
TEST(StudentT, QuantilesOfThePublishedTable)
{
  const struct
  {
    int freedom;
    double t95, t99;
  } rows[] = { { 1, 12.706, 63.657 }, { 2, 4.303, 9.925 }, { 3, 3.182, 5.841 }, { 4, 2.776, 4.604 },
    { 5, 2.571, 4.032 }, { 6, 2.447, 3.707 }, { 7, 2.365, 3.499 }, { 8, 2.306, 3.355 },
    { 9, 2.262, 3.250 }, { 10, 2.228, 3.169 }, { 15, 2.131, 2.947 }, { 20, 2.086, 2.845 },
    { 30, 2.042, 2.750 }, { 31, 2.040, 2.744 }, { 63, 1.998, 2.656 }, { 100, 1.984, 2.626 } };
  for (const auto& [freedom, t95, t99] : rows)
  {
    EXPECT_NEAR(studentQuantile(0.95, freedom), t95, 5.1e-4) << freedom;
    EXPECT_NEAR(studentQuantile(0.99, freedom), t99, 5.1e-4) << freedom;
  }
}

// Closed forms: one degree is Cauchy's distribution, two an algebraic one.
TEST(StudentT, ClosedForms)
{
  for (const double p : { 0.01, 0.5, 0.95, 0.999 })
  {
    EXPECT_NEAR(studentQuantile(p, 1) / std::tan(0.5 * M_PI * p), 1, 1e-12);
    EXPECT_NEAR(studentQuantile(p, 2) / (p * std::sqrt(2 / (1 - p * p))), 1, 1e-11);
  }
}

TEST(StudentT, TendsToTheNormalDistribution)
{
  for (const double t : { 0.5, 1.0, 1.96, 3.0 })
  {
    EXPECT_NEAR(studentProbability(t, 10000), std::erf(t / std::sqrt(2.0)), 1e-4);
  }
}

TEST(StudentT, QuantileUndoesProbability)
{
  for (int freedom = 1; freedom < 256; ++freedom)
  {
    EXPECT_NEAR(studentProbability(studentQuantile(0.95, freedom), freedom), 0.95, 1e-13);
  }
}

}
}
