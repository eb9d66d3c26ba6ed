// SPDX-License-Identifier: BSD-3-Clause
#include "Kit.h"
#include "LambertContour.h"

namespace irradiance::test
{
namespace
{

// 16 seeds of 65,536 walks: 10^6 in all. |t| > 3 with 15 degrees of freedom happens by chance in
// 0.9 % of the comparisons; seeds are fixed, so a test that passed once always passes.
constexpr int kViewSeeds = 16;
constexpr std::uint32_t kViewWalks = scaled(65536);

class ViewFactors : public BothModes
{
protected:
  /// A diffuse emitter of unit exitance (object 0) and a black receiver (object 1): view factors
  /// from the emitter to itself and to the receiver.
  static std::array<ReplicateMean, 2> viewFactors(const SceneObjects& objects, double emitterArea)
  {
    std::array<ReplicateMean, 2> estimates;
    overSeeds(objects, kViewSeeds, kViewWalks, [&](const IrradianceEngine& engine) {
      for (std::uint32_t object = 0; object < 2; ++object)
      {
        const std::size_t cells = objects[object].material->numberOfCells;
        estimates[object].add(wattsOn(engine, object, 0, cells) / emitterArea);
      }
    });
    return estimates;
  }
};

/// Within 1 %, or, where so few walks hit the receiver that chance alone exceeds that, within three
/// standard errors of plain Monte Carlo; gathered, which large cells side by side do badly, within
/// 10 %.
void expectWithinBounds(
  const ReplicateMean& estimate, double truth, bool isGathered, const char* name)
{
  // With sanitizers there are few seeds, of which Student's t is wider.
  EXPECT_LE(std::abs(estimate.t(truth)), kIsSanitized ? 4 : 3) << name;
  if (!kIsSanitized)
  {
    const double plain = std::sqrt(truth * (1 - truth) / kViewSeeds / kViewWalks);
    EXPECT_NEAR(
      estimate.mean(), truth, isGathered ? 0.1 * truth : std::max(0.01 * truth, 3 * plain))
      << name;
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

SceneObject quad(
  const Vector3& corner, const Vector3& u, const Vector3& v, double exitance, int cells = 2)
{
  ObjectBuilder builder;
  builder.addQuad(corner, u, v, cells, cells, grey(0, exitance));
  return builder.build();
}

constexpr struct
{
  double a, b, c, published;
} kAligned[] = { { 1, 1, 1, 0.19982490 }, { 1, 2, 0.5, 0.50898867 }, { 1, 1, 10, 3.16205684e-3 },
  { 1, 1, 0.1, 0.82699452 }, { 1, 1, 0.01, 0.98041660 } };

constexpr struct
{
  double h, w, l, published;
} kPerpendicular[] = { { 1, 1, 1, 0.20004378 }, { 1, 2, 1, 0.11642630 }, { 2, 1, 1, 0.23285260 },
  { 0.01, 1, 1, 4.89584927e-3 } };

/// What a black square of 2 cm receives from a lamp of 1 W/m2, gathered with 64 times 1024 samples;
/// walks that nothing reflects cost nothing. |t| > 3.5 with 63 degrees of freedom happens by chance
/// in 0.09 % of the comparisons.
void expectOfASmallCell(
  const std::vector<Vector3>& lamp, const Vector3& corner, const Vector3& u, const Vector3& v)
{
  const Vector3 normal = u.cross(v).normalized();
  const double truth = meanOverRectangle(
    corner, u, v, 20, [&](const Vector3& p) { return lambertIrradiance(p, normal, lamp); });
  const SceneObjects objects{ quad(lamp[0], lamp[1] - lamp[0], lamp[3] - lamp[0], 1, 1),
    { quad(corner, u, v, 0, 1) } };
  ReplicateMean estimate;
  for (std::uint64_t seed = 1; seed <= (kIsSanitized ? 16 : 64); ++seed)
  {
    EngineSettings settings = Shoot(kIsSanitized ? 1u << 26 : 1u << 28).seeded(seed).gathered();
    UpdatedEngine engine(objects, settings);
    estimate.add(engine.irradiance({ { 1, 0 } }, 0));
  }
  // Samples have places in floats on their cells.
  constexpr double kOfFloats = 1e-6;
  EXPECT_TRUE(std::abs(estimate.t(truth)) <= (kIsSanitized ? 4 : 3.5) ||
    std::abs(estimate.mean() / truth - 1) < kOfFloats);
  EXPECT_NEAR(estimate.mean(), truth, 1e-3 * truth);
}

TEST_P(ViewFactors, AlignedRectangles)
{
  for (const auto& [a, b, c, published] : kAligned)
  {
    EXPECT_NEAR(aligned(a, b, c), published, 1e-8 * std::max(1.0, a / c * a / c * 1e-2));
    const SceneObjects objects{ quad({ 0, 0, 0 }, { a, 0, 0 }, { 0, b, 0 }, 1),
      { quad({ 0, 0, c }, { 0, b, 0 }, { a, 0, 0 }, 0) } };
    expectWithinBounds(viewFactors(objects, a * b)[1], published, isGathered(), "C-11");
  }
}

TEST_P(ViewFactors, PerpendicularRectangles)
{
  for (const auto& [h, w, l, published] : kPerpendicular)
  {
    EXPECT_NEAR(perpendicular(h, w, l), published, 1e-8);
    const SceneObjects objects{ quad({ 0, 0, 0 }, { w, 0, 0 }, { 0, l, 0 }, 1),
      { quad({ 0, 0, 0 }, { 0, l, 0 }, { 0, 0, h }, 0) } };
    expectWithinBounds(viewFactors(objects, w * l)[1], published, isGathered(), "C-14");
  }
}

// A cube: a side does not see itself; the opposite one follows C-11, the four others C-14.
TEST(ViewFactorFormulas, ClosureOfACube)
{
  EXPECT_NEAR(aligned(1, 1, 1) + 4 * perpendicular(1, 1, 1), 1, 1e-12);
}

// Spheres with the same corners up to a factor: their areas have the ratio (r1 / r2)^2 exactly, the
// inner one is convex and sees only the outer one, so reciprocity gives F21 = (r1 / r2)^2.
TEST_P(ViewFactors, ConcentricSpheres)
{
  for (const double ratio : { 0.2, 0.5, 0.9 })
  {
    ObjectBuilder outer, inner;
    outer.addSphere({ 0, 0, 0 }, 2, 8, grey(0, 1), true);
    inner.addSphere({ 0, 0, 0 }, 2 * ratio, 8, grey(0));
    const SceneObjects objects{ outer.build(), { inner.build() } };
    double area = 0;
    for (const double cell : cellAreas(objects.staticObject))
    {
      area += cell;
    }
    const auto [toItself, toInner] = viewFactors(objects, area);
    expectWithinBounds(toInner, ratio * ratio, isGathered(), "F21");
    expectWithinBounds(toItself, 1 - ratio * ratio, isGathered(), "F22");
  }
}

INSTANTIATE_TEST_SUITE_P(DirectLight, ViewFactors, testing::Bool(), nameOfMode);

// What gathering is for: one cell knows to .1 % what it receives, for which 10^10 walks would have
// to be shot. Lamp and cell as in C-11, face to face, and as in C-14, at right angles.
TEST(ViewFactorsOfASmallCell, FaceToFaceAndAtRightAngles)
{
  const std::vector<Vector3> lamp{ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
  const double size = 0.02;
  const Vector3 x(size, 0, 0), y(0, size, 0), z(0, 0, size);
  for (const double distance : { 10.0, 1.0, 0.5, 0.1 })
  {
    expectOfASmallCell(lamp, { 0.3, 0.2, distance }, y, x);
  }
  for (const double height : { 0.0, 0.1, 1.0 })
  {
    expectOfASmallCell(lamp, { 0, 0.4, height }, y, z);
  }
}

}
}
