// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/TriangleNumbers.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace irradiance
{
namespace
{

void expectAll(const std::vector<std::size_t>& sizes)
{
  const TriangleNumbers numbers(sizes);
  std::uint32_t number = 0;
  for (std::uint32_t object = 0; object < sizes.size(); ++object)
  {
    EXPECT_EQ(numbers.first(object), number);
    for (std::uint32_t triangle = 0; triangle < sizes[object]; ++triangle, ++number)
    {
      const TriangleId id{ object, triangle };
      EXPECT_EQ(numbers.numberOf(id), number);
      EXPECT_EQ(numbers.idOf(number), id);
      EXPECT_EQ(numbers.objectOf(number), object);
    }
  }
  EXPECT_EQ(numbers.size(), number);
  EXPECT_EQ(numbers.objects(), sizes.size());
  EXPECT_EQ(numbers.first(numbers.objects()), number);
  EXPECT_EQ(numbers.numberOf({}), TriangleNumbers::kNone);
  EXPECT_EQ(numbers.idOf(TriangleNumbers::kNone), TriangleId());
  EXPECT_EQ(numbers.objectOf(TriangleNumbers::kNone), TriangleNumbers::kNone);
}

TEST(TriangleNumbers, RunThroughAllObjects)
{
  expectAll({});
  expectAll({ 0 });
  expectAll({ 5 });
  expectAll({ 0, 3 });
  expectAll({ 4, 0, 0, 2, 0 });
  expectAll({ 7, 1, 1, 30 });
}

TEST(TriangleNumbers, AreEqualIfAllSizesAre)
{
  const TriangleNumbers numbers({ 3, 4 });
  EXPECT_TRUE(numbers == TriangleNumbers({ 3, 4 }));
  EXPECT_TRUE(numbers != TriangleNumbers({ 3, 4, 0 }));
  EXPECT_TRUE(numbers != TriangleNumbers({ 4, 3 }));
  EXPECT_TRUE(TriangleNumbers() == TriangleNumbers(std::vector<std::size_t>{}));
}

TEST(TriangleNumbers, HaveRoomForAllButOne)
{
  const std::size_t most = TriangleNumbers::kNone - std::size_t{ 1 };
  EXPECT_EQ(TriangleNumbers({ most }).size(), most);
  EXPECT_EQ(
    TriangleNumbers({ most - 1, 1 }).idOf(TriangleNumbers::kNone - 2), TriangleId({ 1, 0 }));
  EXPECT_THROW(TriangleNumbers({ most + 1 }), std::length_error);
  EXPECT_THROW(TriangleNumbers({ most, 1 }), std::length_error);
  EXPECT_THROW(TriangleNumbers({ 1, ~std::size_t{ 0 } }), std::length_error);
}

}
}
