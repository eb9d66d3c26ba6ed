// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Ray.h"
#include "Simd/Column.h"
#include "Surfaces/Power.h"
#include "Surfaces/ThinSheet.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <utility>
#include <vector>

namespace irradiance
{

/**
 * Walks that go on together, one segment of each, column by column. Triangles have numbers through
 * all objects, see SceneTriangles; kNone is none. Usually all walks are at the same bounce; after
 * repairs they are not, and stages are slower but give the same.
 *
 * The columns are raw memory: a stage says which it reads and which it writes.
 */
struct WalkFront
{
  static constexpr std::uint32_t kNone = TriangleId::kNone;
  /// Stages take that many walks at a time.
  static constexpr std::size_t kGroup = 32;
  /// Walks that are shot together: some four blocks.
  static constexpr std::size_t kUsualSize = 4096;

  std::size_t size = 0;
  int bands = 1; ///< with which it was reserved

  // The ray.
  Column<double> originX, originY, originZ;
  Column<float> directionX, directionY, directionZ; ///< of unit length to float rounding
  Column<std::uint32_t> start;                      ///< the triangle that it leaves, or kNone
  Column<std::uint8_t> side;                        ///< 1 if it leaves the front, 0 the back
  // Where it ends. Before it is cast: where the walk leaves `start`, by the weights.
  Column<double> distance;
  Column<std::uint32_t> hit;       ///< the triangle, or kNone if the walk escapes
  Column<float> weightB, weightC;  ///< of the second and third corner
  Column<std::uint8_t> hitSide;    ///< 1 the front, 0 the back; only where sides matter
  Column<std::uint32_t> candidate; ///< of whoever casts
  // Whose it is.
  Column<std::uint32_t> walk, bounce;
  Column<std::uint32_t> block; ///< that stores it
  Column<std::uint32_t> slot,
    parent;                ///< in the block: of this segment and of the one before, or kNone
  Column<Leaving> leaving; ///< how it leaves `start`; only where cells are glossy
  Column<std::int64_t> power[Power::kMaxBands]; ///< quanta; only with several bands
  /// A bit for each walk of a group that survives, see WalkStages::absorb().
  Column<std::uint32_t> survivors;

  std::size_t groups() const { return (size + kGroup - 1) / kGroup; }

  /// Room for that many walks, with powers if there are several bands. Keeps the columns; never
  /// gives room back.
  void reserve(std::size_t walks, int bandsOfPower)
  {
    const std::size_t room = std::max(walks, walk.room()); // of all columns, also those of powers
    bands = bandsOfPower;
    forEachColumn(
      bands, [room](auto& column) { column.reserve(room); }, *this);
    survivors.reserve(room / kGroup + 1);
  }
  /// Appends rows of another front. All columns go along, but for `survivors`; rows that were never
  /// written stay so.
  void take(const WalkFront& from, std::size_t first, std::size_t count)
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
  /// Likewise, rows of three fronts: which front, and the row there.
  using Rows = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
  void pick(const std::array<const WalkFront*, 3>& fronts, const Rows& rows)
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
  /// Gives the places behind the last walk, up to a whole group, values that stages can read.
  void pad()
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

  Power powerAt(std::size_t place, int count) const
  {
    Power carried;
    for (int band = 0; band < count; ++band)
    {
      carried[band] = power[band][place];
    }
    return carried;
  }
  void setPower(std::size_t place, int count, const Power& carried)
  {
    for (int band = 0; band < count; ++band)
    {
      power[band][place] = carried[band];
    }
  }

private:
  /// Calls visit(column...) with the same column of each front, for all that have a place for each
  /// walk.
  template <class Visit, class... Fronts>
  static void forEachColumn(int bandsOfPower, const Visit& visit, Fronts&... fronts)
  {
    visit(fronts.originX...);
    visit(fronts.originY...);
    visit(fronts.originZ...);
    visit(fronts.directionX...);
    visit(fronts.directionY...);
    visit(fronts.directionZ...);
    visit(fronts.start...);
    visit(fronts.side...);
    visit(fronts.distance...);
    visit(fronts.hit...);
    visit(fronts.weightB...);
    visit(fronts.weightC...);
    visit(fronts.hitSide...);
    visit(fronts.candidate...);
    visit(fronts.walk...);
    visit(fronts.bounce...);
    visit(fronts.block...);
    visit(fronts.slot...);
    visit(fronts.parent...);
    visit(fronts.leaving...);
    for (int band = 0; bandsOfPower > 1 && band < bandsOfPower; ++band)
    {
      visit(fronts.power[band]...);
    }
  }
};

}
