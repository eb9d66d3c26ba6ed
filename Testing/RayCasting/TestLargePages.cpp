// SPDX-License-Identifier: BSD-3-Clause
#include "Simd/LargePages.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace irradiance
{

namespace
{

struct alignas(64) Line
{
  std::uint32_t number;
};
using Lines = std::vector<Line, LargePages<Line>>;

constexpr std::uintptr_t kPage = std::uintptr_t{ 1 } << 21;
constexpr std::size_t kMany = 3 * kPage / sizeof(Line) + 1;

std::uintptr_t placeOf(const Lines& lines)
{
  return reinterpret_cast<std::uintptr_t>(lines.data());
}

}

TEST(LargePages, AreWholeForLargeVectors)
{
  EXPECT_EQ(placeOf(Lines(kMany)) % kPage, 0u);
}

TEST(LargePages, LeaveSmallVectorsAlignedAsTheirValues)
{
  for (std::size_t size = 1; size < 40; ++size)
  {
    EXPECT_EQ(placeOf(Lines(size)) % alignof(Line), 0u) << size;
  }
}

TEST(LargePages, KeepWhatAVectorHoldsAsItGrowsShrinksAndIsCopied)
{
  Lines lines;
  for (std::uint32_t i = 0; i < kMany; ++i)
  {
    lines.push_back({ i });
  }
  lines.resize(kMany / 2);
  lines.shrink_to_fit();
  const Lines copy = lines;
  lines.clear();
  ASSERT_EQ(copy.size(), kMany / 2);
  std::uint64_t wrong = 0;
  for (std::uint32_t i = 0; i < copy.size(); ++i)
  {
    wrong += copy[i].number != i ? 1 : 0;
  }
  EXPECT_EQ(wrong, 0u);
}

TEST(LargePages, SetWhatAVectorIsGiven)
{
  const Lines lines(kMany, Line{ 7 });
  EXPECT_EQ(lines.front().number, 7u);
  EXPECT_EQ(lines.back().number, 7u);
}

}
