// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/SphericalTriangle.h"

#include "Kit.h"

#include "LambertContour.h"

namespace irradiance::test
{
namespace
{

Vector3 pointOf(const Triangle& triangle, const Vector3& weights)
{
  return weights[0] * triangle.a + weights[1] * triangle.b + weights[2] * triangle.c;
}

/// How many times larger than that of the coordinates the relative error of the solid angle may be:
/// where the place is near the plane or an edge for the triangle's size, or the triangle a needle.
double conditionOf(const Triangle& triangle, const Vector3& from)
{
  const Vector3 a = triangle.a - from, b = triangle.b - from, c = triangle.c - from;
  const Vector3 toB = triangle.b - triangle.a, toC = triangle.c - triangle.a;
  const auto slimness = [](const Vector3& v, const Vector3& w) {
    return v.norm() * w.norm() / v.cross(w).norm();
  };
  return a.norm() * toB.norm() * toC.norm() / std::abs(a.dot(toB.cross(toC))) + slimness(a, toB) +
    slimness(a, toC) + slimness(b, c);
}

Triangle randomTriangle(RandomVectors& random)
{
  return { random.inCube(), random.inCube(), random.inCube() };
}

bool areWeights(const Vector3& w)
{
  return w.minCoeff() >= 0 && std::abs(w.sum() - 1) <= 4e-16;
}

struct Sight
{
  const char* name;
  Triangle triangle;
  Vector3 from;
};

/// Triangles of all shapes and sizes on the sphere.
std::vector<Sight> sights()
{
  const Triangle plain{ { 0, 0, 0 }, { 1, 0, 0 }, { 0.2, 0.9, 0 } };
  const Triangle needle{ { 0, 0, 0 }, { 1, 0, 0 }, { 0.5, 1e-5, 0 } };
  const Vector3 away(1e6, -1e6, 1e6);
  return { { "octant", { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }, { 0, 0, 0 } },
    { "in front", plain, { 0.3, 0.3, 1 } }, { "near", plain, { 0.3, 0.3, 0.01 } },
    { "very near", plain, { 0.4, 0.3, 1e-9 } }, { "beside", plain, { 2, 1, 0.05 } },
    { "near an edge", plain, { 0.5, -1e-3, 1e-3 } }, { "near b", plain, { 1, 1e-3, 1e-3 } },
    { "far", plain, { 3e7, 2e7, 1e7 } }, { "needle", needle, { 0.4, 0.1, 0.2 } },
    { "along a needle", needle, { -0.1, 0.001, 0.002 } },
    { "far from the origin", { away, away + Vector3(1, 0, 0), away + Vector3(0.25, 1, 0) },
      away + Vector3(0.5, 0.5, 0.25) } };
}

constexpr int kParts = 8;

/// The corner (i, j) of the triangle's division into kParts^2 like itself.
Vector3 gridPoint(const Triangle& triangle, int i, int j)
{
  return triangle.a + (triangle.b - triangle.a) * (double(i) / kParts) +
    (triangle.c - triangle.a) * (double(j) / kParts);
}

/// Chi-square of points in the parts of the triangle, against the parts' solid angles.
double chiSquareOf(const Sight& sight, int points, unsigned seed)
{
  const auto& [name, triangle, from] = sight;
  // By (i, j) and which of the two halves of the parallelogram.
  std::array<int, 2 * kParts * kParts> counts{};
  const SphericalTriangle seen(triangle, from);
  RandomVectors random(seed);
  for (int k = 0; k < points; ++k)
  {
    const double x = random.uniform(0, 1);
    const Vector3 w = seen.sample({ x, random.uniform(0, 1) });
    EXPECT_TRUE(areWeights(w)) << name;
    const int i = std::min(int(w[1] * kParts), kParts - 1);
    const int j = std::min(int(w[2] * kParts), kParts - 1 - i);
    const bool isUpper = w[1] * kParts - i + w[2] * kParts - j > 1 && i + j < kParts - 1;
    ++counts[2 * (i * kParts + j) + isUpper];
  }
  const double whole = solidAngleOf(triangle, from);
  double chiSquare = 0;
  for (int i = 0; i < kParts; ++i)
  {
    for (int j = 0; i + j < kParts; ++j)
    {
      for (int upper = 0; upper < (i + j < kParts - 1 ? 2 : 1); ++upper)
      {
        const Triangle part{ gridPoint(triangle, i + upper, j + upper),
          gridPoint(triangle, i + 1, j), gridPoint(triangle, i, j + 1) };
        const double expected = points * solidAngleOf(part, from) / whole;
        // Less than a point is expected of parts that few see: their deviation counts as one's.
        const double deviation = counts[2 * (i * kParts + j) + upper] - expected;
        chiSquare += deviation * deviation / std::max(expected, 1.0);
      }
    }
  }
  return chiSquare;
}

TEST(SphericalTriangle, AgreesWithVanOosteromAndStrackee)
{
  RandomVectors random(1);
  double worst = 0, smallest = 1, largest = 0;
  for (int i = 0; i < 100000; ++i)
  {
    const double scale = random.powerOfTwo(-40, 40);
    Triangle triangle = randomTriangle(random);
    if (i % 3 == 1) // a needle
    {
      triangle.c = triangle.a + random.uniform(0, 1) * (triangle.b - triangle.a) +
        random.powerOfTwo(-30, 0) * random.inCube();
    }
    Vector3 from = random.inCube() * random.powerOfTwo(0, 30);
    if (i % 3 == 2) // near
    {
      const Vector3 on =
        (triangle.a + triangle.b + triangle.c) / 3 + random.uniform() * (triangle.b - triangle.a);
      from = on + random.powerOfTwo(-30, 0) * triangle.areaVector().normalized();
    }
    const Vector3 offset = i % 2 ? Vector3(random.inCube() * 1e6) : Vector3(0, 0, 0);
    triangle = { scale * (triangle.a + offset), scale * (triangle.b + offset),
      scale * (triangle.c + offset) };
    from = scale * (from + offset);
    const double expected = solidAngleOf(triangle, from);
    const double error = std::abs(SphericalTriangle(triangle, from).solidAngle() / expected - 1);
    worst = std::max(worst, error / conditionOf(triangle, from));
    smallest = std::min(smallest, expected);
    largest = std::max(largest, expected);
  }
  EXPECT_LE(worst, 1e-15);
  EXPECT_LT(smallest, 1e-20);
  EXPECT_GT(largest, 2 * M_PI - 1e-6);
}

// 22 chi-squares, each beyond its limit by chance once in 3.5 million times.
TEST(SphericalTriangle, ChoosesEvenlyBySolidAngle)
{
  constexpr int kPoints = 200000;
  const double limit = chiSquareLimit(kParts * kParts - 1, 5);
  for (const Sight& sight : sights())
  {
    const Triangle turned{ sight.triangle.a, sight.triangle.c, sight.triangle.b };
    for (const Sight& each : { sight, Sight{ sight.name, turned, sight.from } })
    {
      EXPECT_LT(chiSquareOf(each, kPoints, 3), limit) << sight.name;
    }
  }
}

// Free of chance: on a grid the error shrinks with the square of its step, as sample is smooth.
TEST(SphericalTriangle, MeanCosineIsLambertsFormFactor)
{
  RandomVectors random(4);
  double worst = 0;
  for (int i = 0; i < 200; ++i)
  {
    const Vector3 from = random.inCube(), normal = random.direction();
    Triangle triangle = randomTriangle(random);
    for (Vector3* corner : { &triangle.a, &triangle.b, &triangle.c }) // above the horizon
    {
      *corner += normal * (0.1 - std::min(0.0, normal.dot(*corner - from)));
    }
    const SphericalTriangle seen(triangle, from);
    constexpr int kGrid = 128;
    const double cosine =
      meanOverRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, kGrid, [&](const Vector3& u) {
        return normal.dot((pointOf(triangle, seen.sample({ u[0], u[1] })) - from).normalized());
      });
    const double expected = lambertIrradiance(from, normal, { triangle.a, triangle.b, triangle.c });
    worst = std::max(worst, std::abs(cosine * seen.solidAngle() / M_PI - expected));
  }
  EXPECT_LE(worst, 2e-4);
}

TEST(SphericalTriangle, CornersOfTheSquareAreCornersOfTheTriangle)
{
  for (const auto& [name, triangle, from] : sights())
  {
    const SphericalTriangle seen(triangle, from);
    EXPECT_EQ(seen.sample({ 0.3, 0 }), Vector3(0, 1, 0)) << name;
    EXPECT_LE((seen.sample({ 0, 1 }) - Vector3(1, 0, 0)).norm(), 1e-5) << name;
    EXPECT_LE((seen.sample({ 1, 1 }) - Vector3(0, 0, 1)).norm(), 1e-5) << name;
  }
}

// So small that solid angle and area are the same but for 1e-9 and, respectively, seen edge-on.
TEST(SphericalTriangle, TinyAndFlatOnesAreChosenFromByArea)
{
  RandomVectors random(5);
  for (int i = 0; i < 10000; ++i)
  {
    const double u = random.uniform(0, 1), v = random.uniform(0, 1), s = std::sqrt(v);
    const Vector3 expected(s * (1 - u), 1 - s, s * u);
    const double size = random.powerOfTwo(-90, -32);
    const Vector3 from = random.direction();
    const Triangle tiny{ size * Vector3(1, 0.5, 0), size * Vector3(0, 1, 0.5), { 0, 0, 0 } };
    if (conditionOf(tiny, from) < 20)
    {
      const Vector3 found = SphericalTriangle(tiny, from).sample({ u, v });
      ASSERT_LE((found - expected).norm(), 1e-8) << size << " from " << from.transpose();
    }
    const Triangle flat{ { 1, 0, 0 }, { 0, 1, 0 }, { random.uniform(), random.uniform(), 0 } };
    const SphericalTriangle edgeOn(flat, { random.uniform(), random.uniform(), 0 });
    EXPECT_EQ(edgeOn.solidAngle(), 0);
    EXPECT_EQ(edgeOn.sample({ u, v }), expected);
  }
}

TEST(SphericalTriangle, FromItsCornersNothingIsSeen)
{
  RandomVectors random(8);
  for (int i = 0; i < 1000; ++i)
  {
    const Triangle triangle = randomTriangle(random);
    for (const Vector3& corner : { triangle.a, triangle.b, triangle.c })
    {
      const SphericalTriangle seen(triangle, corner);
      ASSERT_EQ(seen.solidAngle(), 0);
      ASSERT_TRUE(areWeights(seen.sample({ 0.3, 0.6 })));
    }
  }
}

// On and by corners, edges and the plane, of all sizes and far from the origin.
TEST(SphericalTriangle, WeightsAreValidEverywhere)
{
  RandomVectors random(6);
  for (int i = 0; i < 300000; ++i)
  {
    const double scale = random.powerOfTwo(-100, 100);
    const Vector3 offset = i % 2 ? Vector3(random.inCube() * 1e6) : Vector3(0, 0, 0);
    const Triangle unit = randomTriangle(random);
    const Triangle triangle{ scale * (unit.a + offset), scale * (unit.b + offset),
      i % 7 ? Vector3(scale * (unit.c + offset)) : Vector3(scale * (unit.a + offset)) };
    const double s = random.uniform() < 0 ? std::round(random.uniform()) : random.uniform(-1, 2);
    const double t = random.uniform() < 0 ? std::round(random.uniform()) : random.uniform(-1, 2);
    Vector3 from = triangle.a + s * (triangle.b - triangle.a) + t * (triangle.c - triangle.a);
    if (i % 3 == 0)
    {
      from += scale * random.powerOfTwo(-60, 0) * random.inCube();
    }
    const SphericalTriangle seen(triangle, from);
    ASSERT_GE(seen.solidAngle(), 0);
    ASSERT_LE(seen.solidAngle(), 2 * M_PI);
    const std::array<double, 2> u{ i % 5 ? random.uniform(0, 1) : i % 2,
      i % 11 ? random.uniform(0, 1) : i % 3 > 0 };
    ASSERT_TRUE(areWeights(seen.sample(u))) << i << ": " << seen.sample(u).transpose();
  }
}

TEST(SphericalTriangle, ScalingByPowersOfTwoChangesNoBit)
{
  RandomVectors random(7);
  for (int i = 0; i < 20000; ++i)
  {
    const auto [a, b, c] = randomTriangle(random);
    const Vector3 from = random.inCube() * random.powerOfTwo(-30, 30);
    const std::array<double, 2> u{ random.uniform(0, 1), random.uniform(0, 1) };
    const double scale = std::exp2(std::round(random.uniform(-400, 400)));
    const SphericalTriangle one({ a, b, c }, from);
    const SphericalTriangle other({ scale * a, scale * b, scale * c }, scale * from);
    ASSERT_EQ(one.solidAngle(), other.solidAngle());
    ASSERT_EQ(one.sample(u), other.sample(u));
  }
}

}
}
