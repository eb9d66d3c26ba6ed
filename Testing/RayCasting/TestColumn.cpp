// SPDX-License-Identifier: BSD-3-Clause
#include "Simd/Column.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace irradiance
{

TEST(Column, ReservingKeepsAllValues)
{
  Column<std::uint32_t> column;
  std::uint32_t written = 0;
  for (const std::size_t size : { 1, 7, 7, 3, 64, 10000 })
  {
    const std::size_t room = column.room();
    column.reserve(size);
    EXPECT_EQ(column.room(), std::max(room, size));
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(column.data()) % 64, 0u);
    for (std::uint32_t i = 0; i < written; ++i)
    {
      ASSERT_EQ(column[i], 5 * i);
    }
    for (; written < column.room(); ++written)
    {
      column[written] = 5 * written;
    }
  }
}

TEST(Column, HasRoomBehindForWholeVectors)
{
  Column<double> column;
  for (const std::size_t size : { 1, 100 })
  {
    column.need(size);
    EXPECT_EQ(column.room(), size);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(column.data()) % 64, 0u);
    std::fill_n(column.data(), size + Column<double>::kRoomBehind, 1.0);
  }
  const double* const before = column.data();
  column.need(50);
  EXPECT_EQ(column.data(), before);
  EXPECT_EQ(column.room(), 100u);
}

TEST(Column, WhatWasMovedFromHasNoRoom)
{
  Column<std::uint16_t> column;
  column.reserve(10);
  column[9] = 3;
  Column<std::uint16_t> other = std::move(column);
  EXPECT_EQ(column.room(), 0u); // NOLINT(bugprone-use-after-move)
  EXPECT_EQ(other[9], 3);
  column.reserve(5);
  column[4] = 4;
  std::swap(column, other);
  EXPECT_EQ(column.room(), 10u);
  EXPECT_EQ(column[9], 3);
  EXPECT_EQ(other.room(), 5u);
  EXPECT_EQ(other[4], 4);
}

}
