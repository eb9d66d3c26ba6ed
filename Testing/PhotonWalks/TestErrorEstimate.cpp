// SPDX-License-Identifier: BSD-3-Clause
#include "Estimates/ErrorEstimate.h"
#include "Kit.h"

namespace irradiance::test
{
namespace
{

/// A row of quads along x, `widths` m wide and 1 m long.
SceneObjects strip(const std::vector<double>& widths, int bands = 1)
{
  ObjectBuilder builder(bands);
  double x = 0;
  for (const double width : widths)
  {
    builder.addQuad({ x, 0, 0 }, { width, 0, 0 }, { 0, 1, 0 }, 1, 1, grey(0));
    x += width;
  }
  return { builder.build(), {} };
}

/// What a target misses by error bars.
TargetMiss missOf(double target, const ErrorEstimate& estimate, const SceneObjects& objects)
{
  SceneCells cells;
  cells.update(objects, {});
  Execution serial;
  return estimate.missOf(target, cells, false, serial);
}

/// Adds `quanta` of a walk to a cell of strip().
void add(CellSums& sums, std::uint32_t walk, std::uint32_t cell, const Power& quanta)
{
  std::vector<Deposit> deposits;
  sums.collect(sums.slotOf(walk, { 0, cell }), true, quanta, 1, deposits);
  sums.add(deposits);
}

/// Of a cell, where a photon is so many quanta.
double errorOf(const CellSums& sums, const WalkPlan& plan, double photon, std::size_t cell = 0,
  std::size_t rounds = 1)
{
  return ErrorEstimate(sums, plan, rounds, { photon, 0, 0 }).standardError({ 0, cell }, 0);
}

// The textbook's standard error of the mean of R equal shares, times R.
TEST(ErrorEstimate, IsThatOfTheMeanOfReplicates)
{
  constexpr std::uint32_t kReplicates = 8, kWalks = 8000;
  RandomVectors random(11);
  const WalkPlan plan(kWalks, kWalks, kReplicates);
  CellSums sums(strip({ 1, 1 }), plan);
  ReplicateMean estimates;
  for (std::uint32_t i = 0; i < kReplicates; ++i)
  {
    const auto quanta = static_cast<std::int64_t>(random.uniform(1000, 1100));
    add(sums, i, 1, { { quanta, 0, 0 } });
    estimates.add(double(quanta) * kReplicates);
  }
  EXPECT_NEAR(errorOf(sums, plan, 1, 1) / estimates.standardError(), 1, 1e-12);
}

// The expected square of the estimate is the variance, for any remainder of walks / replicates. A
// walk carries 3/4 of kPhoton or all of it. Chance exceeds 5 standard errors once in 10^6.
TEST(ErrorEstimate, IsUnbiasedWhenSharesDifferByAWalk)
{
  constexpr std::uint32_t kReplicates = 16;
  constexpr std::int64_t kPhoton = 1 << 20;
  for (const std::uint32_t walks : { 75u, 81u, 95u })
  {
    std::mt19937 random(walks);
    const WalkPlan plan(walks, walks, kReplicates);
    ReplicateMean squares;
    for (int trial = 0; trial < 20000; ++trial)
    {
      CellSums sums(strip({ 1 }), plan);
      std::vector<Deposit> deposits;
      for (std::uint32_t walk = 0; walk < walks; ++walk)
      {
        const std::int64_t quanta = kPhoton / 4 * static_cast<std::int64_t>(3 + random() % 2);
        sums.collect(sums.slotOf(walk, {}), true, { { quanta, 0, 0 } }, 1, deposits);
      }
      sums.add(deposits);
      // Photons of one quantum keep the error's lower bound out of the way.
      squares.add(std::pow(errorOf(sums, plan, 1), 2));
    }
    const double truth = walks * double(kPhoton / 4) * double(kPhoton / 4) / 4;
    EXPECT_LE(std::abs(squares.t(truth)), 5) << walks;
  }
}

TEST(ErrorEstimate, IsUnknownBelow25Photons)
{
  const WalkPlan plan(1600, 1600, 16);
  CellSums sums(strip({ 1, 1, 1 }), plan);
  add(sums, 3, 0, { { 24999, 0, 0 } });
  add(sums, 3, 1, { { 25000, 0, 0 } });
  EXPECT_TRUE(std::isnan(errorOf(sums, plan, 1000, 0)));
  EXPECT_GT(errorOf(sums, plan, 1000, 1), 0);
  EXPECT_TRUE(std::isnan(errorOf(sums, plan, 1000, 2))) << "nothing received";
}

// One replicate says nothing about the spread, nor do fewer than 25 walks, however strong they are.
TEST(ErrorEstimate, IsUnknownWithoutReplicatesOrWalks)
{
  const WalkPlan one(1600, 1600, 1), few(24, 24, 8), enough(25, 25, 8);
  for (const WalkPlan& plan : { one, few, enough })
  {
    CellSums sums(strip({ 1 }), plan);
    add(sums, 0, 0, { { 1000000, 0, 0 } });
    EXPECT_EQ(std::isnan(errorOf(sums, plan, 1000)), !(plan == enough));
  }
}

// Replicates that agree by chance do not yield a false 0.
TEST(ErrorEstimate, IsAtLeastThatOfRoundingToAPhoton)
{
  const WalkPlan plan(1600, 1600, 4);
  CellSums sums(strip({ 1 }), plan);
  for (std::uint32_t walk = 0; walk < 100; ++walk)
  {
    add(sums, walk, 0, { { 600, 0, 0 } });
  }
  EXPECT_NEAR(errorOf(sums, plan, 600), 600 * std::sqrt(4 / 12.0), 1e-9);
}

// Two cells are known to 10 % and 20 % of their sums, one is dark. The cell that completes 95 % of
// the area determines the result.
TEST(ErrorEstimate, OfMostAreaGoesByArea)
{
  constexpr std::int64_t kPhoton = 1000;
  const WalkPlan plan(1600, 1600, 2);
  const auto reached = [&](const std::vector<double>& widths, std::int64_t inDark) {
    const SceneObjects objects = strip(widths);
    CellSums sums(objects, plan);
    add(sums, 0, 0, { { 110000, 0, 0 } }); // the replicates: 10 % off their mean
    add(sums, 1, 0, { { 90000, 0, 0 } });
    add(sums, 0, 1, { { 1200000, 0, 0 } }); // 20 %
    add(sums, 1, 1, { { 800000, 0, 0 } });
    add(sums, 0, 2, { { inDark, 0, 0 } });
    return missOf(0, ErrorEstimate(sums, plan, 1, { kPhoton, 0, 0 }), objects).reached;
  };
  const double t = 12.7062047; // of one degree
  EXPECT_NEAR(reached({ 96, 3, 1 }, 0), t * 0.1, 1e-6);
  EXPECT_NEAR(reached({ 93, 6, 1 }, 0), t * 0.2, 1e-6);
  // 100 m2 receive 2.2e6 quanta, so A m2 receive 2.2e4 A on average. 3 photons are 3000 quanta.
  EXPECT_NEAR(reached({ 0.01, 0.01, 99.98 }, 0), 3 * 1000 / (2.2e6 / 100 * 99.98), 1e-9);
  EXPECT_NEAR(reached({ 86, 4, 10 }, 0), t * 0.1, 1e-6) << "a dark cell is better known";
  EXPECT_EQ(reached({ 86, 4, 10 }, 1), kInfinity) << "one photon: no longer dark, but not known";
  EXPECT_NEAR(reached({ 91, 5, 4 }, 1), t * 0.2, 1e-6);
}

TEST(ErrorEstimate, OfMostAreaTakesTheWorstBandThatShines)
{
  const WalkPlan plan(1600, 1600, 2);
  const SceneObjects objects = strip({ 1 }, 3);
  CellSums sums(objects, plan);
  add(sums, 0, 0, { { 110000, 120000, 0 } });
  add(sums, 1, 0, { { 90000, 80000, 0 } });
  const auto reached = [&](const Bands& photon) {
    return missOf(0, ErrorEstimate(sums, plan, 1, photon), objects).reached;
  };
  EXPECT_NEAR(reached({ 1000, 1000, 0 }), 12.7062047 * 0.2, 1e-6);
  EXPECT_EQ(reached({ 1000, 1000, 1000 }), kInfinity) << "the third shines but is not received";
}

/// Cells from 1 on gather; the variance of their rays is known.
class KnownRays : public PhotonShares
{
public:
  double photonShare(const CellSide& /*cell*/) const override { return 1; }
  std::optional<double> rayVariance(const CellSide& cell, int /*band*/) const override
  {
    return cell.cell == 0 ? std::nullopt : std::optional<double>(variances[cell.cell - 1]);
  }
  std::vector<double> variances;
};

// Two replicates of 110000 and 90000 quanta: the variance is twice the squared distance from their
// mean, over 1 - 1/2 (5.1 of the Theory). Of the cells that gather a quarter of it is noise of the
// rays, all, and more than all.
TEST(ErrorEstimate, TellsWhichLeverPromisesWhat)
{
  const WalkPlan plan(1600, 1600, 2);
  const SceneObjects objects = strip({ 1, 2, 3, 4 });
  CellSums sums(objects, plan);
  for (std::uint32_t cell = 0; cell < 4; ++cell)
  {
    add(sums, 0, cell, { { 110000, 0, 0 } });
    add(sums, 1, cell, { { 90000, 0, 0 } });
  }
  constexpr double kVariance = 2 * 1e4 * 1e4 / (1 - 0.5);
  KnownRays rays;
  rays.variances = { 0.25 * kVariance, kVariance, 3 * kVariance };
  const ErrorEstimate estimate(sums, plan, 1, { 1000, 0, 0 }, &rays);
  TargetMiss miss = missOf(0.1, estimate, objects);
  EXPECT_NEAR(miss.reached, 12.7062047 * 0.1, 1e-6);
  EXPECT_NEAR(miss.byWalks, (1 + 2 * 0.75) / 2, 1e-9);
  EXPECT_NEAR(miss.byRays, (2 * 0.25 + 3 + 4) / 2, 1e-9);
  EXPECT_NEAR(miss.beyondRays, 0.1, 1e-12);
  miss = missOf(1.3, estimate, objects);
  EXPECT_EQ(miss.byWalks + miss.byRays + miss.beyondRays, 0) << "all are within";
}

// The estimate of the first rounds ignores what later walks brought.
TEST(ErrorEstimate, LooksAtTheFirstRoundsAlone)
{
  const WalkPlan plan(100, 400, 2);
  CellSums sums(strip({ 1 }), plan);
  sums.setRounds(3);
  for (const std::uint32_t walk : { 0u, 1u, 100u, 200u, 201u })
  {
    add(sums, walk, 0, { { 1000, 0, 0 } });
  }
  const auto error = [&](std::size_t rounds) { return errorOf(sums, plan, 1, 0, rounds); };
  EXPECT_NEAR(error(1), std::sqrt(2 / 12.0), 1e-9) << "both have 1000";
  EXPECT_NEAR(error(2), 1000, 1e-9) << "2000 and 1000: sqrt(2 (500^2 + 500^2))";
  EXPECT_NEAR(error(3), 1000, 1e-9) << "3000 and 2000";
  sums.setRounds(2);
  EXPECT_EQ(sums.sum({ 0, 0 }, 0), 3000);
  EXPECT_NEAR(error(2), 1000, 1e-9);
}

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
