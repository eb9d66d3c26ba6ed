// SPDX-License-Identifier: BSD-3-Clause
#include "Ellipsoids/EnclosingEllipsoid.h"

#include "RandomVectors.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace irradiance
{
namespace
{

__extension__ typedef __float128 Quad;
using test::RandomVectors;
using Points = std::vector<Vector3>;

double volume(const EnclosingEllipsoid& e)
{
  return 4.0 / 3.0 * kPi / std::abs(e.shape.determinant());
}

/// max |shape * (p - center)|^2 - 1, computed with 113 bits.
double excess(const EnclosingEllipsoid& e, const Points& points)
{
  Quad largest = 0;
  for (const Vector3& p : points)
  {
    Quad square = 0;
    for (int i = 0; i < 3; ++i)
    {
      Quad y = 0;
      for (int j = 0; j < 3; ++j)
      {
        y += Quad(e.shape(i, j)) * (Quad(p[j]) - Quad(e.center[j]));
      }
      square += y * y;
    }
    largest = std::max(largest, square);
  }
  return static_cast<double>(largest - 1);
}

/// A lower bound of the volume of any ellipsoid around the points. For weights u >= 0 of sum 1 with
/// second central moment C, the dual problem gives the bound 4/3 pi sqrt(27 det C). Titterington's
/// multiplicative step improves the weights, in the frame of `guess`.
double smallestPossibleVolume(const Points& points, const EnclosingEllipsoid& guess)
{
  Points y;
  for (const Vector3& p : points)
  {
    y.push_back(guess.shape * (p - guess.center));
  }
  std::vector<double> weight(y.size(), 1.0 / static_cast<double>(y.size()));
  double best = 0.0;
  for (int iteration = 0; iteration < 400; ++iteration)
  {
    Vector3 mean = Vector3::Zero();
    double sum = 0.0;
    for (std::size_t i = 0; i < y.size(); ++i)
    {
      mean += weight[i] * y[i];
      sum += weight[i];
    }
    mean /= sum;
    Matrix3 moment = Matrix3::Zero();
    for (std::size_t i = 0; i < y.size(); ++i)
    {
      moment += weight[i] / sum * (y[i] - mean) * (y[i] - mean).transpose();
    }
    best = std::max(best, 27.0 * moment.determinant());
    const Matrix3 inverse = moment.inverse();
    for (std::size_t i = 0; i < y.size(); ++i)
    {
      weight[i] *= ((y[i] - mean).dot(inverse * (y[i] - mean)) + 1.0) / 4.0 / sum;
    }
  }
  return volume(guess) * std::sqrt(best);
}

EnclosingEllipsoid checked(const std::string& name, const Points& points)
{
  const EnclosingEllipsoid e = encloseByEllipsoid(points);
  EXPECT_TRUE(e.center.allFinite() && e.shape.allFinite()) << name;
  EXPECT_LE(excess(e, points), 0.0) << name << " is not contained";
  return e;
}

Points grid(const Vector3& halfWidth, int n)
{
  Points points;
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j < n; ++j)
    {
      for (int k = 0; k < n; ++k)
      {
        const Vector3 x = Vector3(i, j, k) * (2.0 / (n - 1)) - Vector3::Ones();
        points.push_back(x.cwiseProduct(halfWidth));
      }
    }
  }
  return points;
}

Points cloud(RandomVectors& random, int n, const Vector3& halfWidth)
{
  Points points;
  for (int i = 0; i < n; ++i)
  {
    points.push_back(random.inCube().cwiseProduct(halfWidth));
  }
  return points;
}

Points transformed(Points points, const Matrix3& linear, const Vector3& translation)
{
  for (Vector3& p : points)
  {
    p = linear * p + translation;
  }
  return points;
}

void expectThickness(
  const std::string& name, const EnclosingEllipsoid& e, double longest, double thinnest)
{
  // The longest axis comes first.
  EXPECT_LE(1.0 / e.shape.row(0).norm(), longest) << name;
  EXPECT_LE(1.0 / e.shape.row(2).norm(), thinnest) << name;
}

}

TEST(EnclosingEllipsoid, RefusesWhatItCannotEnclose)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(encloseByEllipsoid({}), std::invalid_argument);
  for (const double bad : { nan, kInfinity, -kInfinity, 1.01e38, -1e200 })
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      RandomVectors random(1);
      Points points = cloud(random, 50, Vector3::Ones());
      points[17][axis] = bad;
      EXPECT_THROW(encloseByEllipsoid(points), std::invalid_argument) << bad;
      EXPECT_THROW(encloseByEllipsoid({ points[17] }), std::invalid_argument) << bad;
    }
  }
}

TEST(EnclosingEllipsoid, ContainsFewPoints)
{
  const Points corners = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  for (std::size_t n = 1; n <= 4; ++n)
  {
    checked(std::to_string(n) + " points", { corners.begin(), corners.begin() + n });
  }
  const Vector3 x(0.1, -7.3, 1e5);
  expectThickness("all equal", checked("all equal", Points(100, x)), 1e-6, 1e-6);
  checked("the origin", { Vector3::Zero() });
  checked("the origin often", Points(300, Vector3::Zero()));
  checked("next to the origin", { Vector3::Constant(1e-300), Vector3::Constant(-1e-310) });

  // A regular tetrahedron: its smallest ellipsoid is its circumsphere.
  const Points regular = { { 1, 1, 1 }, { 1, -1, -1 }, { -1, 1, -1 }, { -1, -1, 1 } };
  const double optimum = 4.0 / 3.0 * kPi * std::pow(3.0, 1.5);
  EXPECT_LE(volume(checked("tetrahedron", regular)), 1.05 * optimum);
}

TEST(EnclosingEllipsoid, ContainsLinesAndDoors)
{
  RandomVectors random(2);
  for (int repeat = 0; repeat < 20; ++repeat)
  {
    const Matrix3 tilt = random.rotation();
    const Vector3 offset = repeat % 2 == 0 ? Vector3::Zero() : Vector3(random.inCube() * 100.0);
    const Points line = cloud(random, 200, { 1, 0, 0 });
    const Points door = cloud(random, 200, { 1, 2, 0 });
    const Points doorCorners = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 2, 0 }, { 0, 2, 0 } };
    expectThickness("line", checked("line", transformed(line, tilt, offset)), 1.01, 2.6e-6);
    expectThickness("door", checked("door", transformed(door, tilt, offset)), 2.9, 7.5e-6);
    checked("4 corners", transformed(doorCorners, tilt, offset));
    checked("door z = c", transformed(door, Matrix3::Identity(), offset));
    checked("line x", transformed(line, Matrix3::Identity(), offset));
  }
}

TEST(EnclosingEllipsoid, ContainsNeedlesPlatesAndOffsets)
{
  RandomVectors random(3);
  for (const double thin : { 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9 })
  {
    const Matrix3 tilt = random.rotation();
    for (const Vector3& size :
      { Vector3(1, thin, thin), Vector3(1, 1, thin), Vector3(1, std::sqrt(thin), thin) })
    {
      const std::string name = "aspect " + std::to_string(std::log10(thin));
      const Points box = grid(size, 5);
      const double optimum = 4.0 / 3.0 * kPi * std::pow(3.0, 1.5) * size.prod();
      const double aligned = volume(checked(name, box));
      const double tilted = volume(checked(name, transformed(box, tilt, Vector3::Zero())));
      if (thin > 0x1p-20) // thinner axes are thickened on purpose
      {
        EXPECT_LE(aligned, 1.05 * optimum) << name;
        EXPECT_LE(tilted, 1.05 * optimum) << name;
      }
    }
  }
  for (const double distance : { 1e2, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9 })
  {
    const Vector3 offset = distance * Vector3(1, -0.7, 0.3);
    const Points box = grid({ 1, 1, 1 }, 5);
    const double optimum = 4.0 / 3.0 * kPi * std::pow(3.0, 1.5);
    const std::string name = "offset " + std::to_string(distance);
    EXPECT_LE(volume(checked(name, transformed(box, random.rotation(), offset))), 1.05 * optimum);
    checked(name, transformed(grid({ 1, 1, 0 }, 5), random.rotation(), offset));
  }
}

TEST(EnclosingEllipsoid, IsCloseToTheSmallest)
{
  RandomVectors random(4);
  const auto expectSmall = [&](const std::string& name, const Points& points) {
    const EnclosingEllipsoid e = checked(name, points);
    EXPECT_LE(volume(e) / smallestPossibleVolume(points, e), 1.05) << name;
  };
  for (const int n :
    { 5, 20, 256, 257, 1000, test::kFewer > 1 ? 1500 : 3000, test::kFewer > 1 ? 2000 : 20000 })
  {
    Points sphere;
    Points ball;
    Points lathe; // the outline of a vase: dense, curved, with a handle that sticks out
    for (int i = 0; i < n; ++i)
    {
      sphere.push_back(random.direction());
      ball.push_back(random.direction() * std::cbrt(random.uniform(0, 1)));
      const double height = random.uniform(-1, 1);
      const double angle = random.uniform(-kPi, kPi);
      const double radius = 0.6 + 0.3 * std::cos(3.0 * height);
      lathe.push_back(
        { radius * std::cos(angle) + (angle > 3.0 ? 0.5 : 0.0), radius * std::sin(angle), height });
    }
    const Matrix3 stretch =
      random.rotation() * Vector3(1, 1e-3, 20).asDiagonal() * random.rotation();
    for (const Points& points : { sphere, ball, lathe, cloud(random, n, { 1, 1, 1 }) })
    {
      expectSmall(std::to_string(n) + " points", points);
      expectSmall(std::to_string(n) + " stretched", transformed(points, stretch, { 1, 2, 3 }));
    }
  }
}

TEST(EnclosingEllipsoid, KnowsTheBoxAndTheBall)
{
  const Points box = grid({ 3, 2, 1 }, 2);
  const double boxOptimum = 4.0 / 3.0 * kPi * std::pow(3.0, 1.5) * 6.0;
  EXPECT_LE(volume(checked("box", box)), 1.01 * boxOptimum);
  EXPECT_GE(volume(checked("box", box)), boxOptimum);

  RandomVectors random(5);
  Points sphere;
  for (int i = 0; i < 200000; ++i)
  {
    sphere.push_back(random.direction());
  }
  const EnclosingEllipsoid e = encloseByEllipsoid(sphere);
  EXPECT_LE(excess(e, sphere), 0.0);
  EXPECT_LE(volume(e), 1.02 * 4.0 / 3.0 * kPi);
}

TEST(EnclosingEllipsoid, ScalesExactlyWithPowersOfTwo)
{
  RandomVectors random(6);
  const std::vector<Points> sets = { cloud(random, 5, { 1, 1, 1 }),
    cloud(random, 1000, { 3, 1, 2 }), cloud(random, 100, { 1, 2, 0 }),
    cloud(random, 100, { 1, 1e-9, 1e-6 }), { { 1, 2, 3 } },
    transformed(cloud(random, 100, { 1, 1, 1 }), random.rotation(), { 1e6, -1e6, 3e5 }) };
  for (const Points& points : sets)
  {
    const EnclosingEllipsoid unit = encloseByEllipsoid(points);
    for (const int exponent : { -120, -60, -20, -1, 1, 3, 20, 60, 100 })
    {
      const double scale = std::ldexp(1.0, exponent);
      const EnclosingEllipsoid scaled =
        encloseByEllipsoid(transformed(points, scale * Matrix3::Identity(), Vector3::Zero()));
      EXPECT_TRUE(scaled.center == unit.center * scale) << exponent;
      EXPECT_TRUE(scaled.shape == unit.shape / scale) << exponent;
    }
  }
}

TEST(EnclosingEllipsoid, WorksAtAllScales)
{
  RandomVectors random(7);
  for (int exponent = -38; exponent <= 37; ++exponent)
  {
    const double scale = std::pow(10.0, exponent);
    const Points box = grid(Vector3(3, 2, 1) * scale, 3);
    const double unitVolume = volume(checked("scale", box)) / scale / scale / scale;
    EXPECT_LE(unitVolume, 1.01 * 4.0 / 3.0 * kPi * std::pow(3.0, 1.5) * 6.0) << exponent;
  }
  checked("largest", grid(Vector3::Constant(1e38), 3));
}

TEST(EnclosingEllipsoid, ContainsRandomSets)
{
  constexpr int kSets = 10000;
  RandomVectors random(8);
  for (int i = 0; i < kSets && !testing::Test::HasFailure(); ++i)
  {
    const int n = 1 + static_cast<int>(std::pow(10.0, random.uniform(0, i % 100 == 0 ? 3.5 : 2)));
    Vector3 size;
    for (int axis = 0; axis < 3; ++axis)
    {
      size[axis] = random.uniform() < -0.7 ? 0.0 : std::pow(10.0, random.uniform(-9, 0));
    }
    const double scale = std::pow(10.0, random.uniform(-20, 20));
    const Vector3 offset = random.inCube() * std::pow(10.0, random.uniform(-9, 7));
    Points points = transformed(cloud(random, n, size), scale * random.rotation(), scale * offset);
    if (i % 3 == 0)
    {
      points.insert(points.end(), points.begin(), points.begin() + points.size() / 2);
    }
    checked("seed 8, set " + std::to_string(i), points);
  }
}

}
