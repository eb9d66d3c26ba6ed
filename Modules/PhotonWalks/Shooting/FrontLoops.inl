// SPDX-License-Identifier: BSD-3-Clause
// The loops of FrontLoops.h, compiled once for each instruction set. `Lanes`: its way to transpose
// four rows of four, and to pack what a mask chooses. All else are plain loops over a group of
// walks, which become SIMD.

namespace irradiance
{
namespace
{

constexpr unsigned kGroup = WalkFront::kGroup;
static_assert(kGroup == SampleGroup::kSize);
/// Lanes::Packing takes that many walks.
constexpr unsigned kPacked = 16;
static_assert(kPacked <= Column<float>::kRoomBehind && kGroup <= Column<float>::kRoomBehind);

/// Bisection as in LightTable::choose(), all lanes in step.
__attribute__((always_inline)) inline void chooseLights(
  const std::vector<double>& cumulative, const std::uint32_t* samples, std::uint32_t* chosen)
{
  const double* const upTo = cumulative.data();
  const double all = cumulative.back();
  double flux[kGroup];
  for (unsigned lane = 0; lane < kGroup; ++lane)
  {
    flux[lane] = SobolPoint::toUnit(samples[lane]) * all;
    chosen[lane] = 0;
  }
  for (std::size_t count = cumulative.size(); count > 1;)
  {
    const auto half = static_cast<std::uint32_t>(count / 2);
    for (unsigned lane = 0; lane < kGroup; ++lane)
    {
      chosen[lane] +=
        static_cast<std::uint32_t>(upTo[chosen[lane] + half - 1] <= flux[lane]) * half;
    }
    count -= half;
  }
}

/// Places uniform over the area of triangles, as sampleTriangle(), in float.
__attribute__((always_inline)) inline void placeOnTriangles(
  const SampleGroup& samples, float* weightB, float* weightC)
{
  alignas(64) float b[kGroup], c[kGroup];
  for (unsigned lane = 0; lane < kGroup; ++lane)
  {
    const float root = __builtin_sqrtf((static_cast<float>(samples.x[lane]) + 0.5F) * 0x1p-32F);
    const float part = (static_cast<float>(samples.y[lane]) + 0.5F) * 0x1p-32F;
    b[lane] = root * (1 - part);
    c[lane] = root * part;
  }
  std::memcpy(weightB, b, sizeof(b));
  std::memcpy(weightC, c, sizeof(c));
}

void startLoop(WalkFront& front, const SobolSequence& samples,
  const std::vector<double>& cumulativeFlux, const std::uint32_t* triangles)
{
  SampleGroup group;
  std::uint32_t chosen[kGroup], starts[kGroup];
  for (std::size_t i = 0; i < front.size; i += kGroup)
  {
    const std::uint32_t *walks = &front.walk[i], *bounces = &front.bounce[i];
    group.drawFirst(samples, SampleUse::Light, walks, bounces, 0);
    chooseLights(cumulativeFlux, group.x, chosen);
    for (unsigned lane = 0; lane < kGroup; ++lane)
    {
      starts[lane] = triangles[chosen[lane]];
    }
    std::memcpy(&front.candidate[i], chosen, sizeof(chosen));
    std::memcpy(&front.start[i], starts, sizeof(starts));
    std::memset(&front.side[i], 1, kGroup);
    group.draw(samples, SampleUse::Position, walks, bounces, 0);
    placeOnTriangles(group, &front.weightB[i], &front.weightC[i]);
  }
}

/// Asks memory for the looks of hits two groups ahead.
__attribute__((always_inline)) inline void prefetchLooks(
  const SceneRows& rows, const WalkFront& front, std::size_t i)
{
  const std::size_t ahead = i + std::size_t{ 2 } * kGroup;
  const std::uint32_t* const hits = front.hit.data() + ahead;
  for (unsigned lane = 0; lane < kGroup && ahead < front.size; ++lane)
  {
    prefetchLine(rows.lookOf(hits[lane]));
  }
}

template <class Lanes>
void surviveLoop(WalkFront& front, SceneRows rows, const SobolSequence& samples)
{
  static_assert(CellLook::kSurvivesAlways == 1u << 31);
  SampleGroup group;
  alignas(64) std::uint32_t threshold[kGroup], always[kGroup], survives[kGroup];
  for (std::size_t i = 0; i < front.size; i += kGroup)
  {
    group.drawFirst(samples, SampleUse::Survival, &front.walk[i], &front.bounce[i], 1);
    std::copy_n(group.x, kGroup, &front.candidate[i]);
    const std::uint32_t* const hits = &front.hit[i];
    for (unsigned lane = 0; lane < kGroup; ++lane) // the tally has just read the same looks
    {
      const CellLook look = *rows.lookOf(hits[lane]);
      threshold[lane] = look.threshold;
      always[lane] = look.cell >> 31;
    }
    for (unsigned lane = 0; lane < kGroup; ++lane)
    {
      survives[lane] = static_cast<std::uint32_t>(group.x[lane] < threshold[lane]) | always[lane];
    }
    front.survivors[i / kGroup] = Lanes::maskOf(survives);
  }
}

void drawLoop(WalkFront& front, const SobolSequence& samples)
{
  SampleGroup group;
  for (std::size_t i = 0; i < front.size; i += kGroup)
  {
    group.drawFirst(samples, SampleUse::Survival, &front.walk[i], &front.bounce[i], 1);
    std::copy_n(group.x, kGroup, &front.candidate[i]);
  }
}

template <class Lanes>
void packLoop(const WalkFront& from, WalkFront& to, bool hasGlossy, int bands)
{
  std::size_t kept = 0;
  for (std::size_t i = 0; i < from.size; i += kPacked)
  {
    const unsigned last = from.size - i < kPacked ? (1u << (from.size - i)) - 1 : 0xffffu;
    const unsigned mask = from.survivors[i / kGroup] >> i % kGroup & last;
    const typename Lanes::Packing pack(mask);
    alignas(64) std::uint32_t next[kPacked];
    for (unsigned lane = 0; lane < kPacked; ++lane)
    {
      next[lane] = from.bounce[i + lane] + 1;
    }
    pack(&from.hit[i], &to.start[kept]);
    pack(&from.weightB[i], &to.weightB[kept]);
    pack(&from.weightC[i], &to.weightC[kept]);
    pack(&from.walk[i], &to.walk[kept]);
    pack(next, &to.bounce[kept]);
    pack(&from.block[i], &to.block[kept]);
    pack(&from.slot[i], &to.parent[kept]);
    pack(&from.hitSide[i], &to.side[kept]);
    if (hasGlossy)
    {
      pack(&from.directionX[i], &to.directionX[kept]);
      pack(&from.directionY[i], &to.directionY[kept]);
      pack(&from.directionZ[i], &to.directionZ[kept]);
      pack(reinterpret_cast<const std::uint8_t*>(&from.leaving[i]),
        reinterpret_cast<std::uint8_t*>(&to.leaving[kept]));
      pack(&from.originX[i], &to.originX[kept]);
      pack(&from.originY[i], &to.originY[kept]);
      pack(&from.originZ[i], &to.originZ[kept]);
    }
    for (int band = 0; bands > 1 && band < bands; ++band)
    {
      pack(&from.power[band][i], &to.power[band][kept]);
    }
    kept += static_cast<unsigned>(__builtin_popcount(mask));
  }
  to.size = kept;
}

/// Rows of the table, side by side.
struct RecordLanes
{
  // Where they hold what.
  static constexpr unsigned kA = 0, kB = 3, kC = 6, kNormal = 9, kClearance = 12, kInset = 13,
                            kColumns = 16;

  alignas(64) double column[kColumns][kGroup];

  template <class Lanes>
  __attribute__((always_inline)) void load(const SceneRows& rows, const std::uint32_t* numbers)
  {
    for (unsigned lane = 0; lane < kGroup; lane += 4)
    {
      const double* row[4];
      for (unsigned i = 0; i < 4; ++i)
      {
        row[i] = reinterpret_cast<const double*>(rows.recordOf(numbers[lane + i]));
      }
      for (unsigned at = 0; at < kColumns; at += 4)
      {
        Lanes::transpose({ row[0] + at, row[1] + at, row[2] + at, row[3] + at },
          { &column[at][lane], &column[at + 1][lane], &column[at + 2][lane],
            &column[at + 3][lane] });
      }
    }
  }
};
static_assert(offsetof(SurfaceRecord, normal) == RecordLanes::kNormal * sizeof(double));
static_assert(offsetof(SurfaceRecord, inset) == RecordLanes::kInset * sizeof(double));

__attribute__((always_inline)) inline double mostOf(double a, double b)
{
  return a > b ? a : b;
}

/// The points that walks leave, with the operations of SurfaceFormula in its order. `side`: 1
/// front, -1 back. `normal`: of the side.
__attribute__((always_inline)) inline void placeOrigins(const RecordLanes& record,
  const float* weightB, const float* weightC, const double* side, double (&origin)[3][kGroup],
  float (&normal)[3][kGroup])
{
  const auto& c = record.column;
  for (unsigned lane = 0; lane < kGroup; ++lane)
  {
    const double b = weightB[lane], g = weightC[lane], a = 1 - b - g;
    const double keptA = mostOf(a, c[RecordLanes::kInset][lane]),
                 keptB = mostOf(b, c[RecordLanes::kInset + 1][lane]),
                 keptC = mostOf(g, c[RecordLanes::kInset + 2][lane]);
    const double scale = 1 / (keptA + keptB + keptC);
    for (unsigned axis = 0; axis < 3; ++axis)
    {
      const double turned = side[lane] * c[RecordLanes::kNormal + axis][lane];
      const double position =
        (keptA * c[RecordLanes::kA + axis][lane] + keptB * c[RecordLanes::kB + axis][lane] +
          keptC * c[RecordLanes::kC + axis][lane]) *
        scale;
      origin[axis][lane] = position + c[RecordLanes::kClearance][lane] * turned;
      normal[axis][lane] = static_cast<float>(turned);
    }
  }
}

/// Asks memory for the records of the next group.
__attribute__((always_inline)) inline void prefetchRecords(
  const SceneRows& rows, const WalkFront& front, std::size_t i)
{
  const std::size_t ahead = i + kGroup;
  const std::uint32_t* const starts = front.start.data() + ahead;
  for (unsigned lane = 0; lane < kGroup && ahead < front.size; ++lane)
  {
    const SurfaceRecord* const record = rows.recordOf(starts[lane]);
    prefetchLine(record);
    prefetchLine(&record->inset);
  }
}

template <class Lanes>
void leaveLoop(WalkFront& front, SceneRows rows, const SobolSequence& samples)
{
  SampleGroup group;
  RecordLanes record;
  alignas(64) double side[kGroup], origin[3][kGroup];
  alignas(64) float normal[3][kGroup], direction[3][kGroup];
  for (std::size_t i = 0; i < front.size; i += kGroup)
  {
    prefetchRecords(rows, front, i);
    record.load<Lanes>(rows, &front.start[i]);
    for (unsigned lane = 0; lane < kGroup; ++lane)
    {
      side[lane] = front.side[i + lane] != 0 ? 1.0 : -1.0;
    }
    placeOrigins(record, &front.weightB[i], &front.weightC[i], side, origin, normal);
    std::memcpy(&front.originX[i], origin[0], sizeof(origin[0]));
    std::memcpy(&front.originY[i], origin[1], sizeof(origin[1]));
    std::memcpy(&front.originZ[i], origin[2], sizeof(origin[2]));
    group.draw(samples, SampleUse::Direction, &front.walk[i], &front.bounce[i], 0);
    for (unsigned lane = 0; lane < kGroup; ++lane)
    {
      const CosineDirectionInFloat leaving(
        normal[0][lane], normal[1][lane], normal[2][lane], group.x[lane], group.y[lane]);
      direction[0][lane] = leaving.x;
      direction[1][lane] = leaving.y;
      direction[2][lane] = leaving.z;
    }
    std::memcpy(&front.directionX[i], direction[0], sizeof(direction[0]));
    std::memcpy(&front.directionY[i], direction[1], sizeof(direction[1]));
    std::memcpy(&front.directionZ[i], direction[2], sizeof(direction[2]));
  }
}

/// Of a record only the normal is read.
void sidesLoop(WalkFront& front, SceneRows rows)
{
  alignas(64) double x[kGroup], y[kGroup], z[kGroup];
  for (std::size_t i = 0; i < front.size; i += kGroup)
  {
    const std::uint32_t* const hits = &front.hit[i];
    const std::size_t ahead = i + kGroup;
    for (unsigned lane = 0; lane < kGroup && ahead < front.size; ++lane)
    {
      prefetchLine(&rows.recordOf(hits[kGroup + lane])->normal);
    }
    for (unsigned lane = 0; lane < kGroup; ++lane)
    {
      const double* const normal = rows.recordOf(hits[lane])->normal;
      x[lane] = normal[0];
      y[lane] = normal[1];
      z[lane] = normal[2];
    }
    std::uint8_t isFront[kGroup];
    for (unsigned lane = 0; lane < kGroup; ++lane)
    {
      const double with = double{ front.directionX[i + lane] } * x[lane] +
        double{ front.directionY[i + lane] } * y[lane] +
        double{ front.directionZ[i + lane] } * z[lane];
      isFront[lane] = with <= 0 || hits[lane] == WalkFront::kNone ? 1 : 0;
    }
    std::memcpy(&front.hitSide[i], isFront, sizeof(isFront));
  }
}

void slotsLoop(const SlotsLoop& loop)
{
  const WalkFront& front = loop.front;
  const SceneRows rows = loop.rows;
  const std::uint32_t perCell = loop.perCell, perReplicate = loop.perReplicate,
                      perSide = loop.perSide, escaped = loop.escaped;
  ReplicateLanes replicates{};
  alignas(64) std::uint32_t cell[kGroup], back[kGroup] = {}, slot[kGroup];
  for (std::size_t i = loop.first; i < loop.end; i += kGroup)
  {
    prefetchLooks(rows, front, i);
    const std::uint32_t* const hits = &front.hit[i];
    for (unsigned lane = 0; lane < kGroup; ++lane)
    {
      cell[lane] = rows.lookOf(hits[lane])->number();
    }
    if (loop.replicates > 1)
    {
      replicates.set(&front.walk[i], loop.firstWalk, loop.replicates);
    }
    const std::uint8_t* const hitSides = &front.hitSide[i];
    for (unsigned lane = 0; lane < kGroup; ++lane)
    {
      back[lane] = hitSides[lane] != 0 ? 0 : perSide;
    }
    for (unsigned lane = 0; lane < kGroup; ++lane)
    {
      const std::uint32_t sum =
        cell[lane] * perCell + back[lane] + replicates.replicate[lane] * perReplicate;
      slot[lane] = hits[lane] == WalkFront::kNone ? escaped : sum;
    }
    std::memcpy(loop.slots + (i - loop.first), slot, sizeof(slot));
  }
}

template <class Lanes>
constexpr FrontLoops kLoops{ startLoop, surviveLoop<Lanes>, drawLoop, packLoop<Lanes>,
  leaveLoop<Lanes>, sidesLoop, slotsLoop };

}
}
