// SPDX-License-Identifier: BSD-3-Clause
#include "RandomVectors.h"
#include "Scene/RayOrder.h"

#include <gtest/gtest.h>

#include <numeric>

namespace irradiance
{

namespace
{

Box unitBox()
{
  Box box;
  box.add(Vector3::Zero());
  box.add(Vector3::Ones());
  return box;
}

std::vector<Ray> randomRays(int count)
{
  test::RandomVectors random(1);
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i)
  {
    rays.push_back({ random.inCube(), random.direction(), {} });
  }
  return rays;
}

double meanStep(const std::vector<Ray>& rays, const std::vector<std::uint32_t>& order)
{
  double sum = 0;
  for (std::size_t i = 1; i < order.size(); ++i)
  {
    sum += (rays[order[i]].origin - rays[order[i - 1]].origin).norm();
  }
  return sum / static_cast<double>(order.size());
}

}

TEST(RayOrder, IsAPermutationThatBringsLikeRaysTogether)
{
  std::vector<Ray> rays = randomRays(20000);
  rays[17].origin[1] = std::nan("");
  rays[18].direction = { 0, 0, std::nan("") };
  const auto order = coherentOrder(rays.data(), 20000, unitBox());
  std::vector<std::uint32_t> sorted = order, all(rays.size());
  std::sort(sorted.begin(), sorted.end());
  std::iota(all.begin(), all.end(), 0u);
  EXPECT_EQ(sorted, all);
  rays = randomRays(20000);
  EXPECT_LT(
    meanStep(rays, coherentOrder(rays.data(), 20000, unitBox())), 0.5 * meanStep(rays, all));
}

TEST(RayOrder, LeavesAloneWhatIsInOrder)
{
  std::vector<Ray> rays = randomRays(1000);
  for (Ray& ray : rays)
  {
    ray.origin *= 0.1;
    ray.direction = Vector3(0, 0, 1) + 0.1 * ray.direction;
  }
  EXPECT_TRUE(coherentOrder(rays.data(), 1000, unitBox()).empty());
  EXPECT_TRUE(coherentOrder(nullptr, 0, {}).empty());
}

}
