// SPDX-License-Identifier: BSD-3-Clause
#include "Lights/IntensityDistribution.h"

#include "DirectionBins.h"
#include "Kit.h"

namespace irradiance::test
{
namespace
{

/// With the faces of what was built.
Luminaire lampOf(ObjectBuilder& body, const Luminaire& lamp)
{
  body.addOpening(0, lamp);
  return body.emission().luminaires.back();
}

Luminaire boxLamp()
{
  ObjectBuilder body;
  body.addBox(box({ 0, 0, 0 }, { 0.6, 0.4, 0.1 }), 2, {});
  return lampOf(body, lopsidedLamp({ 1 }, true));
}

Luminaire roundLamp()
{
  ObjectBuilder body;
  body.addSphere({ 0, 0, 0 }, 0.3, 6, {});
  return lampOf(body, lopsidedLamp({ 1 }, true));
}

Luminaire flatLamp()
{
  ObjectBuilder body;
  addPanel(body, { 0, 0, 0 }, 0.6, 0.6, 0);
  return lampOf(body, lopsidedLamp({ 1 }));
}

double seenAreaOf(const std::vector<Vector3>& faces, const Vector3& direction)
{
  return std::accumulate(faces.begin(), faces.end(), 0.0,
    [&](double sum, const Vector3& face) { return sum + std::max(0.0, face.dot(direction)); });
}

TEST(IntensityDistribution, HasTheTableInTheAxesOfTheLamp)
{
  RandomVectors random(3);
  Luminaire lamp = boxLamp();
  for (int i = 0; i < 50; ++i)
  {
    const Matrix3 axes = random.rotation();
    lamp.axis = axes.col(0);
    lamp.reference = axes.col(1);
    const IntensityDistribution distribution(lamp, {}, false);
    const Vector3 d = random.direction();
    const Vector3 local(
      d.dot(lamp.reference), d.dot(lamp.reference.cross(lamp.axis)), d.dot(lamp.axis));
    const double expected = lamp.intensity->value(local) / lamp.intensity->integral();
    EXPECT_NEAR(distribution.intensity(d), expected, 1e-12 * expected);
    EXPECT_NEAR(distribution.radiance(d) * seenAreaOf(lamp.faces, d), expected, 1e-12 * expected);
  }
  double sum = 0;
  const IntensityDistribution usual(boxLamp(), {});
  forEachDirection([&](const Vector3& d, double angle) { sum += usual.intensity(d) * angle; });
  EXPECT_NEAR(sum, 1, 1e-4);
  EXPECT_EQ(IntensityDistribution(flatLamp(), {}).radiance({ 0.6, 0, 0.8 }), 0) << "behind";
  EXPECT_EQ(IntensityDistribution(lopsidedLamp({ 1 }), {}).radiance({ 0, 0, -1 }), 0) << "a point";
}

TEST(IntensityDistribution, SharesOfFacesAreThoseOfAFineQuadrature)
{
  for (const Luminaire& lamp : { boxLamp(), roundLamp(), flatLamp() })
  {
    const IntensityDistribution distribution(lamp, {});
    std::vector<double> expected(lamp.faces.size());
    forEachDirection([&](const Vector3& d, double angle) {
      const double perArea = distribution.intensity(d) / seenAreaOf(lamp.faces, d) * angle;
      for (std::size_t i = 0; i < expected.size() && std::isfinite(perArea); ++i)
      {
        expected[i] += std::max(0.0, lamp.faces[i].dot(d)) * perArea;
      }
    });
    double sum = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      const double area = lamp.faces[i].norm();
      const double share = distribution.faceOf(lamp.faces[i] / area).shareOf(area);
      EXPECT_NEAR(share, expected[i], 2e-4 * expected[i] + 1e-5) << "face " << i;
      EXPECT_NEAR(distribution.faceOf(lamp.faces[i] / area).shareOf(area / 4), share / 4, 1e-15);
      sum += share;
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    const Vector3 rounded = (lamp.faces[0].normalized() + Vector3(1e-3, 1e-3, 0)).normalized();
    EXPECT_GT(distribution.faceOf(rounded).shareOf(1), 0)
      << "a triangle with coordinates in floats";
    EXPECT_EQ(distribution.faceOf(Vector3(0.1, 0.2, 0.3).normalized()).shareOf(1), 0) << "no face";
  }
}

// A pose turns and mirrors, but does not scale: radiance and area go together.
TEST(IntensityDistribution, FollowsPoses)
{
  RandomVectors random(4);
  const Luminaire lamp = boxLamp();
  const IntensityDistribution before(lamp, {});
  for (int i = 0; i < 12; ++i)
  {
    Matrix3 turned = random.rotation();
    turned.col(1) *= i % 2 == 0 ? 1 : -1; // mirrored
    const double scale = std::exp2(i % 5 - 2);
    const IntensityDistribution after(lamp, { scale * turned, random.inCube() });
    const Vector3 stretch(0.5, 3, 1.2);
    const IntensityDistribution stretched(lamp, { turned * stretch.asDiagonal(), {} });
    const Vector3 d = random.direction(), to = turned * d;
    EXPECT_NEAR(after.intensity(to), before.intensity(d), 1e-12);
    EXPECT_NEAR(after.radiance(to) * scale * scale, before.radiance(d), 1e-11);
    EXPECT_NEAR(stretched.intensity(to), before.intensity(d), 1e-12);
    std::vector<Vector3> faces = lamp.faces;
    for (Vector3& face : faces)
    {
      const double area = face.norm();
      EXPECT_NEAR(after.faceOf(turned * face / area).shareOf(area * scale * scale),
        before.faceOf(face / area).shareOf(area), 1e-9);
      face = turned * stretch.prod() * face.cwiseQuotient(stretch);
    }
    EXPECT_NEAR(stretched.radiance(to) * seenAreaOf(faces, to), before.intensity(d), 1e-12);
  }
  const IntensityDistribution twice(lamp, { 2 * Matrix3::Identity(), {} });
  EXPECT_EQ(twice.radiance({ 0.6, 0, -0.8 }), before.radiance({ 0.6, 0, -0.8 }) / 4);
  // Sheared, its axes are still at right angles.
  Matrix3 shear = Matrix3::Identity();
  shear(0, 1) = 0.7;
  shear(1, 2) = -0.4;
  double sum = 0;
  const IntensityDistribution sheared(lamp, { shear, {} }, false);
  forEachDirection([&](const Vector3& d, double angle) { sum += sheared.intensity(d) * angle; });
  EXPECT_NEAR(sum, 1, 1e-3);
}

TEST(IntensityDistribution, SamplesOfAFaceHaveItsDensity)
{
  for (const Luminaire& lamp : { boxLamp(), flatLamp() })
  {
    for (const Vector3& face : lamp.faces)
    {
      SCOPED_TRACE(face.transpose());
      const IntensityDistribution distribution(lamp, {});
      const Vector3 normal = face.normalized();
      expectDensity(
        [&](const Vector3& d) { return distribution.radiance(d) * std::max(0.0, normal.dot(d)); },
        [&](const std::array<double, 2>& u) {
          return distribution.sample(u, normal, distribution.faceOf(normal));
        });
    }
  }
}

}
}
