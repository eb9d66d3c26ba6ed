// SPDX-License-Identifier: BSD-3-Clause
#include "Shooting/WalkFront.h"

#include <algorithm>
#include <cassert>

namespace irradiance
{

void WalkFront::reserve(std::size_t walks, int bandsOfPower)
{
  const std::size_t room = std::max(walks, walk.room()); // of all columns, also those of powers
  bands = bandsOfPower;
  forEachColumn(
    bands, [room](auto& column) { column.reserve(room); }, *this);
  survivors.reserve(room / kGroup + 1);
}

void WalkFront::take(const WalkFront& from, std::size_t first, std::size_t count)
{
  assert(&from != this && first + count <= from.size);
  const std::size_t room = walk.room(), all = size + count;
  reserve(all > room ? std::max(all, 2 * room) : room, from.bands);
  forEachColumn(
    bands,
    [&](auto& to, const auto& column) {
      std::copy_n(column.data() + first, count, to.data() + size);
    },
    *this, from);
  size = all;
}

void WalkFront::pick(const std::array<const WalkFront*, 3>& fronts, const Rows& rows)
{
  const std::size_t all = size + rows.size();
  reserve(all, fronts[0]->bands);
  forEachColumn(
    bands,
    [&](auto& to, const auto& a, const auto& b, const auto& c) {
      const decltype(a.data()) columns[] = { a.data(), b.data(), c.data() };
      std::transform(rows.begin(), rows.end(), to.data() + size,
        [&](const auto& row) { return columns[row.first][row.second]; });
    },
    *this, *fronts[0], *fronts[1], *fronts[2]);
  size = all;
}

void WalkFront::pad()
{
  for (std::size_t i = size; i % kGroup != 0; ++i)
  {
    originX[i] = originY[i] = originZ[i] = 0;
    directionX[i] = directionY[i] = directionZ[i] = 0;
    start[i] = hit[i] = kNone;
    side[i] = hitSide[i] = 1;
    weightB[i] = weightC[i] = 0;
    walk[i] = walk[size - 1];
    bounce[i] = bounce[size - 1]; // so that the group has one
  }
}

}
