// SPDX-License-Identifier: BSD-3-Clause

#include "CosineHemisphere.h"
#include "Kit.h"

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

// E cos = 2/3, E cos^2 = 1/2, and 1/4 along each tangent.
TEST(DirectionSampling, MomentsOfTheCosineHemisphere)
{
  for (const Vector3& normal : { Vector3(0, 0, 1), Vector3(0.6, 0, -0.8), Vector3(0, -1, 0) })
  {
    const Vector3 first = meanOverGrid<Vector3>(Vector3::Zero(),
      [&](const std::array<double, 2>& u) { return sampleCosineHemisphere(normal, u); });
    const Matrix3 second = meanOverGrid<Matrix3>(Matrix3::Zero(),
      [&](const std::array<double, 2>& u) { return outer(sampleCosineHemisphere(normal, u)); });
    EXPECT_LT((first - normal * (2.0 / 3.0)).norm(), 1e-5);
    EXPECT_LT((second - 0.25 * (Matrix3::Identity() + outer(normal))).norm(), 1e-5);
  }
}

TEST(DirectionSampling, HemisphereIsAroundItsNormalAndOfUnitLength)
{
  RandomVectors random(2);
  for (int i = 0; i < 100000; ++i)
  {
    const Vector3 normal = random.direction();
    const double extreme = i % 2 == 0 ? random.uniform(0, 1) : 1 - 0x1p-33;
    const Vector3 v = sampleCosineHemisphere(normal, { extreme, random.uniform(0, 1) });
    ASSERT_GT(v.dot(normal), 0);
    ASSERT_NEAR(v.norm(), 1, 1e-15);
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

}
}
