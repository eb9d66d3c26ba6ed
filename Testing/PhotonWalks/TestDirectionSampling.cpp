// SPDX-License-Identifier: BSD-3-Clause

#include "CosineHemisphere.h"
#include "Kit.h"
#include "Sampling/DirectionSampling.h"

namespace irradiance::test
{
namespace
{

constexpr int kGrid = 1000;

/// Mean of f over the midpoints of a kGrid x kGrid grid on the unit square, free of chance.
template <class Result, class Function>
Result meanOverGrid(const Result& zero, const Function& f)
{
  Result sum = zero;
  for (int i = 0; i < kGrid; ++i)
  {
    for (int j = 0; j < kGrid; ++j)
    {
      sum += f(std::array<double, 2>{ (i + 0.5) / kGrid, (j + 0.5) / kGrid });
    }
  }
  return sum / (double(kGrid) * kGrid);
}

/// The directions along the surface that a turn of 0 and a quarter turn lead to.
std::array<Vector3, 2> tangentsOf(const Vector3& normal)
{
  return { sampleCosineHemisphere(normal, { 1, 0 }), sampleCosineHemisphere(normal, { 1, 0.25 }) };
}

Matrix3 outer(const Vector3& v)
{
  return v * v.transpose();
}

TEST(DirectionSampling, FrameIsOrthonormal)
{
  RandomVectors random(1);
  double worst = 0;
  for (int i = 0; i < 300000; ++i)
  {
    Vector3 normal = random.direction();
    if (i % 3 == 0)
    {
      normal = (normal.cwiseProduct(Vector3(1, 1, 0)) * random.powerOfTwo(-60, 0) +
        Vector3(0, 0, i % 2 == 0 ? 1 : -1))
                 .normalized();
    }
    const auto [tangent, bitangent] = tangentsOf(normal);
    Matrix3 frame;
    frame << tangent, bitangent, normal;
    const double error = (frame.transpose() * frame - Matrix3::Identity()).cwiseAbs().maxCoeff();
    worst = std::max(worst, error);
    ASSERT_GT(frame.determinant(), 0) << normal.transpose();
  }
  EXPECT_LE(worst, 1e-15);
}

TEST(DirectionSampling, FrameTakesAxes)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double sign : { 1.0, -1.0 })
    {
      Vector3 normal = Vector3::Zero();
      normal[axis] = sign;
      const auto [tangent, bitangent] = tangentsOf(normal);
      EXPECT_EQ(tangent.cross(bitangent), normal);
    }
  }
}

// E d = 0 and E d d^T = I / 3.
TEST(DirectionSampling, MomentsOfTheSphere)
{
  const Vector3 first = meanOverGrid<Vector3>(Vector3::Zero(), sampleSphere);
  const Matrix3 second = meanOverGrid<Matrix3>(
    Matrix3::Zero(), [](const std::array<double, 2>& u) { return outer(sampleSphere(u)); });
  EXPECT_LT(first.norm(), 1e-12);
  EXPECT_LT((second - Matrix3::Identity() / 3).norm(), 1e-5);
}

// E w_i = 1/3, E w_i^2 = 1/6, E w_i w_j = 1/12.
TEST(DirectionSampling, MomentsOfTheTriangle)
{
  const Vector3 first = meanOverGrid<Vector3>(Vector3::Zero(), sampleTriangle);
  const Matrix3 second = meanOverGrid<Matrix3>(
    Matrix3::Zero(), [](const std::array<double, 2>& u) { return outer(sampleTriangle(u)); });
  EXPECT_LT((first - Vector3::Constant(1.0 / 3.0)).norm(), 1e-5);
  EXPECT_LT((second - (Matrix3::Identity() + Matrix3::Ones()) / 12).norm(), 1e-5);
}

// Each of 16 congruent parts of the triangle gets a 16th of the points. The edges of the parts cut
// the grid, so about 2 kGrid points of a part may fall to its neighbours.
TEST(DirectionSampling, TriangleIsFilledUniformly)
{
  std::array<int, 64> counts{};
  meanOverGrid<double>(0.0, [&](const std::array<double, 2>& u) {
    const Vector3 w = 4 * sampleTriangle(u);
    ++counts[static_cast<std::size_t>(w[0]) * 16 + static_cast<std::size_t>(w[1]) * 4 +
      static_cast<std::size_t>(w[2])];
    return 0.0;
  });
  int parts = 0;
  for (const int count : counts)
  {
    parts += count > 0 ? 1 : 0;
    EXPECT_TRUE(count == 0 || std::abs(count - kGrid * kGrid / 16) < 2 * kGrid) << count;
  }
  EXPECT_EQ(parts, 16);
}

constexpr double kBound = 0x1p-20;

Vector3 directionOf(const Vector3& normal, std::uint32_t u, std::uint32_t v)
{
  const CosineDirectionInFloat direction(static_cast<float>(normal[0]),
    static_cast<float>(normal[1]), static_cast<float>(normal[2]), u, v);
  return { direction.x, direction.y, direction.z };
}

/// Normals of all kinds: any, near an axis, along an axis, and with a zero of either sign.
Vector3 normalOf(int kind, RandomVectors& random)
{
  Vector3 normal = random.direction();
  const int axis = kind / 4 % 3;
  switch (kind % 4)
  {
    case 1:
    {
      const double off = random.powerOfTwo(-60, -1);
      normal *= off;
      normal[axis] = kind % 8 < 4 ? 1 : -1;
      return normal.normalized();
    }
    case 2:
      return (kind % 8 < 4 ? 1 : -1) * Vector3::Unit(axis);
    case 3:
      normal[axis] = kind % 8 < 4 ? 0.0 : -0.0;
      return normal.normalized();
    default:
      return normal;
  }
}

std::uint32_t sampleOf(int kind, RandomVectors& random)
{
  const std::uint32_t any = static_cast<std::uint32_t>(random.engine());
  const std::uint32_t few = any >> (random.engine() % 32);
  return kind % 3 == 0 ? any : kind % 3 == 1 ? few : ~few;
}

// Against the unit normal in double, from which the float normal was rounded.
TEST(CosineDirectionInFloat, IsOfUnitLengthAndOnTheSideOfTheNormal)
{
  RandomVectors random(1);
  double worstLength = 0, worstHeight = 0, least = 1;
  for (int i = 0; i < 5000000; ++i)
  {
    const Vector3 normal = normalOf(i, random);
    std::uint32_t u = sampleOf(i / 24, random);
    u = i % 5 == 0 ? 0xffffffffu : i % 5 == 1 ? 0 : u;
    const std::uint32_t v = sampleOf(i / 72, random);
    const Vector3 direction = directionOf(normal, u, v);
    const double height = std::sqrt((~u + 0.5) * 0x1p-32);
    worstLength = std::max(worstLength, std::abs(direction.norm() - 1));
    worstHeight = std::max(worstHeight, std::abs(direction.dot(normal) - height));
    least = std::min(least, direction.dot(normal));
  }
  EXPECT_GT(least, 0);
  EXPECT_LE(worstLength, kBound);
  EXPECT_LE(worstHeight, kBound);
}

TEST(CosineDirectionInFloat, IsThatOfDoublesToTheBound)
{
  RandomVectors random(2);
  for (int i = 0; i < 300000; ++i)
  {
    const Vector3 normal = normalOf(i, random).cast<float>().cast<double>();
    const std::uint32_t u = sampleOf(i / 24, random), v = sampleOf(i / 72, random);
    const Vector3 expected =
      sampleCosineHemisphere(normal, { (u + 0.5) * 0x1p-32, (v + 0.5) * 0x1p-32 });
    ASSERT_LE((directionOf(normal, u, v) - expected).norm(), 2 * kBound);
  }
}

// 32 x 32 cells of the unit disk of equal area, by Malley's projection: the part of the square of
// samples that each stands for is as large. Chi-square of 1,023 degrees with random samples: a
// false alarm in 1 of 10,000 seeds.
TEST(CosineDirectionInFloat, FillsTheProjectedDiskUniformly)
{
  constexpr int kSide = 32, kDraws = 1 << 21;
  RandomVectors random(3);
  for (const Vector3& normal :
    { Vector3(0, 0, 1), Vector3(0.6, 0, -0.8), Vector3(0.48, -0.6, 0.64) })
  {
    const Vector3 tangent = directionOf(normal, 0xffffffffu, 0).normalized();
    const Vector3 bitangent = normal.cross(tangent);
    std::vector<double> counts(kSide * kSide);
    for (int i = 0; i < kDraws; ++i)
    {
      const Vector3 d = directionOf(normal, static_cast<std::uint32_t>(random.engine()),
        static_cast<std::uint32_t>(random.engine()));
      const double x = d.dot(tangent), y = d.dot(bitangent);
      const double turns = std::atan2(y, x) / (2 * M_PI);
      const int ring = std::min(kSide - 1, static_cast<int>(kSide * (x * x + y * y)));
      const int sector =
        std::min(kSide - 1, static_cast<int>(kSide * (turns < 0 ? turns + 1 : turns)));
      ++counts[static_cast<std::size_t>(ring * kSide + sector)];
    }
    const double expected = double(kDraws) / (kSide * kSide);
    double chiSquare = 0;
    for (const double count : counts)
    {
      chiSquare += (count - expected) * (count - expected) / expected;
    }
    EXPECT_LE(chiSquare, chiSquareLimit(kSide * kSide - 1, 3.72));
  }
}

// E d = 2/3 n and E d d^T = (I + n n^T) / 4, in double and from samples as integers.
TEST(CosineDirectionInFloat, HasTheMomentsOfTheCosineAsInDouble)
{
  for (const Vector3& normal :
    { Vector3(0, 0, 1), Vector3(0, 0, -1), Vector3(0.6, 0, -0.8), Vector3(0, -1, 0) })
  {
    const auto inDouble = [&](const std::array<double, 2>& u) {
      return sampleCosineHemisphere(normal, u);
    };
    const auto inFloat = [&](const std::array<double, 2>& u) {
      return directionOf(normal, static_cast<std::uint32_t>(u[0] * 0x1p32),
        static_cast<std::uint32_t>(u[1] * 0x1p32));
    };
    const auto expectMoments = [&](const auto& sample) {
      const Vector3 first = meanOverGrid<Vector3>(Vector3::Zero(), sample);
      const Matrix3 second = meanOverGrid<Matrix3>(
        Matrix3::Zero(), [&](const std::array<double, 2>& u) { return outer(sample(u)); });
      EXPECT_LT((first - normal * (2.0 / 3.0)).norm(), 1e-5);
      EXPECT_LT((second - 0.25 * (Matrix3::Identity() + outer(normal))).norm(), 1e-5);
    };
    expectMoments(inDouble);
    expectMoments(inFloat);
  }
}

}
}
