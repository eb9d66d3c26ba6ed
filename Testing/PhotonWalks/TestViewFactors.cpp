// SPDX-License-Identifier: BSD-3-Clause
#include "EngineRun.h"
#include "TestScenes.h"

#include <gtest/gtest.h>

namespace irradiance
{

namespace
{

using test::grey;
using test::ReplicateMean;

// 16 seeds of 65,536 walks: 10^6 in all. |t| > 3 with 15 degrees of freedom happens by chance in
// 0.9 % of the comparisons; seeds are fixed, so a test that passed once always passes.
constexpr int kSeeds = 16;
constexpr std::uint32_t kWalks = test::scaled(65536);

/// A diffuse emitter of unit exitance (object 0) and a black receiver (object 1): view factors from
/// the emitter to itself and to the receiver.
std::array<ReplicateMean, 2> viewFactors(const SceneObjects& objects, double emitterArea)
{
  std::array<ReplicateMean, 2> estimates;
  for (int seed = 1; seed <= kSeeds; ++seed)
  {
    EngineSettings settings;
    settings.numberOfWalks = kWalks;
    settings.seed = static_cast<std::uint64_t>(seed);
    settings.verify = false;
    IrradianceEngine engine;
    Execution execution;
    engine.update(objects, settings, execution);
    for (std::uint32_t object = 0; object < 2; ++object)
    {
      const std::size_t cells = objects[object].material->numberOfCells;
      estimates[object].add(test::wattsOn(engine, object, 0, cells) / emitterArea);
    }
  }
  return estimates;
}

/// Within 1 %, or, where so few walks hit the receiver that chance alone exceeds that, within three
/// standard errors of plain Monte Carlo.
void expectWithinBounds(const ReplicateMean& estimate, double truth, const char* name)
{
  estimate.print(name, truth);
  EXPECT_LE(std::abs(estimate.t(truth)), 3) << name;
  if (!test::kIsSanitized)
  {
    const double plain = std::sqrt(truth * (1 - truth) / kSeeds / kWalks);
    EXPECT_NEAR(estimate.mean(), truth, std::max(0.01 * truth, 3 * plain)) << name;
  }
}

/// C-11 of Howell's catalogue: aligned parallel rectangles a x b at distance c.
double aligned(double a, double b, double c)
{
  const double x = a / c, y = b / c, x1 = 1 + x * x, y1 = 1 + y * y;
  return 2 / (M_PI * x * y) *
    (0.5 * std::log(x1 * y1 / (x1 + y1 - 1)) + x * std::sqrt(y1) * std::atan(x / std::sqrt(y1)) +
      y * std::sqrt(x1) * std::atan(y / std::sqrt(x1)) - x * std::atan(x) - y * std::atan(y));
}

/// C-14: from w x l to h x l, perpendicular, with the edge l in common.
double perpendicular(double h, double w, double l)
{
  const double h1 = h / l, w1 = w / l, hh = h1 * h1, ww = w1 * w1, a = hh + ww;
  return 1 / (M_PI * w1) *
    (w1 * std::atan(1 / w1) + h1 * std::atan(1 / h1) - std::sqrt(a) * std::atan(1 / std::sqrt(a)) +
      0.25 *
        (std::log((1 + ww) * (1 + hh) / (1 + a)) + ww * std::log(ww * (1 + a) / ((1 + ww) * a)) +
          hh * std::log(hh * (1 + a) / ((1 + hh) * a))));
}

SceneObject quad(const Vector3& corner, const Vector3& u, const Vector3& v, double exitance)
{
  test::ObjectBuilder builder;
  builder.addQuad(corner, u, v, 2, 2, grey(0, exitance));
  return builder.build();
}

}

TEST(ViewFactors, AlignedRectangles)
{
  const struct
  {
    double a, b, c, published;
  } rows[] = { { 1, 1, 1, 0.19982490 }, { 1, 2, 0.5, 0.50898867 }, { 1, 1, 10, 3.16205684e-3 },
    { 1, 1, 0.1, 0.82699452 }, { 1, 1, 0.01, 0.98041660 } };
  for (const auto& [a, b, c, published] : rows)
  {
    EXPECT_NEAR(aligned(a, b, c), published, 1e-8 * std::max(1.0, a / c * a / c * 1e-2));
    const SceneObjects objects{ quad({ 0, 0, 0 }, { a, 0, 0 }, { 0, b, 0 }, 1),
      { quad({ 0, 0, c }, { 0, b, 0 }, { a, 0, 0 }, 0) } };
    expectWithinBounds(viewFactors(objects, a * b)[1], published, "C-11");
  }
}

TEST(ViewFactors, PerpendicularRectangles)
{
  const struct
  {
    double h, w, l, published;
  } rows[] = { { 1, 1, 1, 0.20004378 }, { 1, 2, 1, 0.11642630 }, { 2, 1, 1, 0.23285260 },
    { 0.01, 1, 1, 4.89584927e-3 } };
  for (const auto& [h, w, l, published] : rows)
  {
    EXPECT_NEAR(perpendicular(h, w, l), published, 1e-8);
    const SceneObjects objects{ quad({ 0, 0, 0 }, { w, 0, 0 }, { 0, l, 0 }, 1),
      { quad({ 0, 0, 0 }, { 0, l, 0 }, { 0, 0, h }, 0) } };
    expectWithinBounds(viewFactors(objects, w * l)[1], published, "C-14");
  }
}

// A cube: a side does not see itself; the opposite one follows C-11, the four others C-14.
TEST(ViewFactors, ClosureOfACube)
{
  EXPECT_NEAR(aligned(1, 1, 1) + 4 * perpendicular(1, 1, 1), 1, 1e-12);
}

// Spheres with the same corners up to a factor: their areas have the ratio (r1 / r2)^2 exactly, the
// inner one is convex and sees only the outer one, so reciprocity gives F21 = (r1 / r2)^2.
TEST(ViewFactors, ConcentricSpheres)
{
  for (const double ratio : { 0.2, 0.5, 0.9 })
  {
    test::ObjectBuilder outer, inner;
    outer.addSphere({ 0, 0, 0 }, 2, 8, grey(0, 1), true);
    inner.addSphere({ 0, 0, 0 }, 2 * ratio, 8, grey(0));
    const SceneObjects objects{ outer.build(), { inner.build() } };
    double area = 0;
    for (const double cell : cellAreas(objects.staticObject))
    {
      area += cell;
    }
    const auto [toItself, toInner] = viewFactors(objects, area);
    expectWithinBounds(toInner, ratio * ratio, "F21");
    expectWithinBounds(toItself, 1 - ratio * ratio, "F22");
  }
}

}
