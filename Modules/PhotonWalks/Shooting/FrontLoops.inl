// SPDX-License-Identifier: BSD-3-Clause
// The loops of FrontLoops.h, compiled once for each instruction set. `Lanes`: its way to transpose rows and
// to pack what a mask chooses. All else are plain loops over a group of walks, which become SIMD.

namespace irradiance
{
namespace
{

constexpr unsigned kGroup = WalkFront::kGroup;
static_assert(kGroup == SampleGroup::kSize);

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
      chosen[lane] += upTo[chosen[lane] + half - 1] <= flux[lane] ? half : 0u;
    }
    count -= half;
  }
}

/// Uniform over the area of a triangle, as sampleTriangle(), in float.
__attribute__((always_inline)) inline void placeOnTriangles(
  const SampleGroup& samples, float* weightB, float* weightC)
{
  for (unsigned lane = 0; lane < kGroup; ++lane)
  {
    const float root = __builtin_sqrtf((static_cast<float>(samples.x[lane]) + 0.5F) * 0x1p-32F);
    const float part = (static_cast<float>(samples.y[lane]) + 0.5F) * 0x1p-32F;
    weightB[lane] = root * (1 - part);
    weightC[lane] = root * part;
  }
}

template <class Lanes>
void runStartLoop(const StartLoop& loop)
{
  WalkFront& front = loop.front;
  SampleGroup samples;
  for (std::size_t i = 0; i < front.size; i += kGroup)
  {
    const std::uint32_t *walks = &front.walk[i], *bounces = &front.bounce[i];
    samples.drawFirst(loop.lights, walks, bounces, 0);
    chooseLights(loop.cumulativeFlux, samples.x, loop.chosen + i);
    for (unsigned lane = 0; lane < kGroup; ++lane)
    {
      front.start[i + lane] = loop.triangles[loop.chosen[i + lane]];
      front.side[i + lane] = 1;
    }
    samples.draw(loop.positions, walks, bounces, 0);
    placeOnTriangles(samples, &front.weightB[i], &front.weightC[i]);
  }
}

template <class Lanes>
void runSurviveLoop(const SurviveLoop& loop)
{
  constexpr std::size_t kAhead = 2 * kGroup;
  WalkFront& front = loop.front;
  SampleGroup samples;
  for (std::size_t i = 0; i < front.size; i += kGroup)
  {
    for (unsigned lane = 0; i + kAhead < front.size && lane < kGroup; ++lane)
    {
      prefetchLine(loop.rows.lookOf(front.hit[i + kAhead + lane]));
    }
    samples.drawFirst(loop.keys, &front.walk[i], &front.bounce[i], 1);
    alignas(64) std::uint32_t survives[kGroup];
    for (unsigned lane = 0; lane < kGroup; ++lane)
    {
      const CellLook& look = *loop.rows.lookOf(front.hit[i + lane]);
      survives[lane] = (samples.x[lane] < look.threshold ? 1u : 0u) | look.cell >> 31;
    }
    static_assert(CellLook::kSurvivesAlways == 1u << 31);
    front.survivors[i / kGroup] = static_cast<std::uint16_t>(Lanes::maskOf(survives));
  }
}

template <class Lanes>
void runDrawLoop(const DrawLoop& loop)
{
  SampleGroup samples;
  for (std::size_t i = 0; i < loop.front.size; i += kGroup)
  {
    samples.drawFirst(loop.keys, &loop.front.walk[i], &loop.front.bounce[i], 1);
    std::copy_n(samples.x, kGroup, loop.samples + i);
  }
}

template <class Lanes>
void runPackLoop(const PackLoop& loop)
{
  const WalkFront& from = loop.from;
  WalkFront& to = loop.to;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < from.size; i += kGroup)
  {
    const unsigned last = from.size - i < kGroup ? (1u << (from.size - i)) - 1 : 0xffffu;
    const unsigned mask = from.survivors[i / kGroup] & last;
    const typename Lanes::Packing pack(mask);
    alignas(64) std::uint32_t next[kGroup];
    for (unsigned lane = 0; lane < kGroup; ++lane)
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
    if (!loop.areSidesKnown || loop.hasGlossy)
    {
      pack(&from.directionX[i], &to.directionX[kept]);
      pack(&from.directionY[i], &to.directionY[kept]);
      pack(&from.directionZ[i], &to.directionZ[kept]);
    }
    if (loop.areSidesKnown)
    {
      pack(&from.hitSide[i], &to.side[kept]);
    }
    if (loop.hasGlossy)
    {
      pack(&from.isSpecular[i], &to.isSpecular[kept]);
      pack(&from.originX[i], &to.originX[kept]);
      pack(&from.originY[i], &to.originY[kept]);
      pack(&from.originZ[i], &to.originZ[kept]);
    }
    for (int band = 0; loop.bands > 1 && band < loop.bands; ++band)
    {
      pack(&from.power[band][i], &to.power[band][kept]);
    }
    kept += static_cast<unsigned>(__builtin_popcount(mask));
  }
  to.size = kept;
}

/// Eight rows of the table, side by side.
struct RecordLanes
{
  static constexpr unsigned kSize = 8;
  enum Column
  {
    A = 0,
    B = 3,
    C = 6,
    Normal = 9,
    Clearance = 12,
    Inset = 13,
    Columns = 16
  };

  alignas(64) double column[Columns][kSize];

  template <class Lanes>
  __attribute__((always_inline)) void load(const SceneRows& rows, const std::uint32_t* numbers)
  {
    const double* row[kSize];
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      row[lane] = reinterpret_cast<const double*>(rows.recordOf(numbers[lane]));
    }
    Lanes::transpose(row, column);
  }
};
static_assert(offsetof(SurfaceRecord, normal) == RecordLanes::Normal * sizeof(double));
static_assert(offsetof(SurfaceRecord, inset) == RecordLanes::Inset * sizeof(double));

__attribute__((always_inline)) inline double mostOf(double a, double b)
{
  return a > b ? a : b;
}

/// The points that eight walks leave, with the operations of SurfaceFormula in its order.
struct PointLanes
{
  static constexpr unsigned kSize = RecordLanes::kSize;

  alignas(64) double direction[3][kSize]; ///< of arrival
  alignas(64) double side[kSize];         ///< 1 front, -1 back
  alignas(64) double origin[3][kSize];
  alignas(64) float normal[3][kSize]; ///< of the side

  __attribute__((always_inline)) void findSides(const RecordLanes& record)
  {
    const auto& c = record.column;
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      const double with = direction[0][lane] * c[RecordLanes::Normal][lane] +
        direction[1][lane] * c[RecordLanes::Normal + 1][lane] +
        direction[2][lane] * c[RecordLanes::Normal + 2][lane];
      side[lane] = with <= 0 ? 1.0 : -1.0;
    }
  }

  __attribute__((always_inline)) void place(
    const RecordLanes& record, const float* weightB, const float* weightC)
  {
    const auto& c = record.column;
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      const double b = weightB[lane], g = weightC[lane], a = 1 - b - g;
      const double keptA = mostOf(a, c[RecordLanes::Inset][lane]),
                   keptB = mostOf(b, c[RecordLanes::Inset + 1][lane]),
                   keptC = mostOf(g, c[RecordLanes::Inset + 2][lane]);
      const double scale = 1 / (keptA + keptB + keptC);
      for (unsigned axis = 0; axis < 3; ++axis)
      {
        const double turned = side[lane] * c[RecordLanes::Normal + axis][lane];
        const double position =
          (keptA * c[RecordLanes::A + axis][lane] + keptB * c[RecordLanes::B + axis][lane] +
            keptC * c[RecordLanes::C + axis][lane]) *
          scale;
        origin[axis][lane] = position + c[RecordLanes::Clearance][lane] * turned;
        normal[axis][lane] = static_cast<float>(turned);
      }
    }
  }
};

template <class Lanes>
__attribute__((always_inline)) inline void leavePoints(
  const LeaveLoop& loop, std::size_t i, float (*normals)[kGroup], unsigned firstLane)
{
  WalkFront& front = loop.front;
  RecordLanes record;
  record.load<Lanes>(loop.rows, &front.start[i]);
  PointLanes points;
  if (loop.areSidesKnown)
  {
    for (unsigned lane = 0; lane < PointLanes::kSize; ++lane)
    {
      points.side[lane] = front.side[i + lane] != 0 ? 1.0 : -1.0;
    }
  }
  else
  {
    for (unsigned lane = 0; lane < PointLanes::kSize; ++lane)
    {
      points.direction[0][lane] = front.directionX[i + lane];
      points.direction[1][lane] = front.directionY[i + lane];
      points.direction[2][lane] = front.directionZ[i + lane];
    }
    points.findSides(record);
    for (unsigned lane = 0; lane < PointLanes::kSize; ++lane)
    {
      front.side[i + lane] = points.side[lane] > 0 ? 1 : 0;
    }
  }
  points.place(record, &front.weightB[i], &front.weightC[i]);
  FrontColumn<double>* const origins[3] = { &front.originX, &front.originY, &front.originZ };
  for (unsigned axis = 0; axis < 3; ++axis)
  {
    std::memcpy(&(*origins[axis])[i], points.origin[axis], sizeof(points.origin[axis]));
    std::memcpy(&normals[axis][firstLane], points.normal[axis], sizeof(points.normal[axis]));
  }
}

template <class Lanes>
void runLeaveLoop(const LeaveLoop& loop)
{
  WalkFront& front = loop.front;
  SampleGroup samples;
  alignas(64) float normal[3][kGroup], direction[3][kGroup];
  for (std::size_t i = 0; i < front.size; i += kGroup)
  {
    for (unsigned lane = 0; i + kGroup < front.size && lane < kGroup; ++lane)
    {
      const SurfaceRecord* next = loop.rows.recordOf(front.start[i + kGroup + lane]);
      prefetchLine(next);
      prefetchLine(&next->normal);
    }
    for (unsigned half = 0; half < kGroup; half += PointLanes::kSize)
    {
      leavePoints<Lanes>(loop, i + half, normal, half);
    }
    samples.draw(loop.keys, &front.walk[i], &front.bounce[i], 0);
    for (unsigned lane = 0; lane < kGroup; ++lane)
    {
      const CosineDirectionInFloat leaving(
        normal[0][lane], normal[1][lane], normal[2][lane], samples.x[lane], samples.y[lane]);
      direction[0][lane] = leaving.x;
      direction[1][lane] = leaving.y;
      direction[2][lane] = leaving.z;
    }
    std::memcpy(&front.directionX[i], direction[0], sizeof(direction[0]));
    std::memcpy(&front.directionY[i], direction[1], sizeof(direction[1]));
    std::memcpy(&front.directionZ[i], direction[2], sizeof(direction[2]));
  }
}

template <class Lanes>
void runSidesLoop(const SidesLoop& loop)
{
  WalkFront& front = loop.front;
  for (std::size_t i = 0; i < front.size; i += PointLanes::kSize)
  {
    RecordLanes record;
    record.load<Lanes>(loop.rows, &front.hit[i]);
    PointLanes points;
    for (unsigned lane = 0; lane < PointLanes::kSize; ++lane)
    {
      points.direction[0][lane] = front.directionX[i + lane];
      points.direction[1][lane] = front.directionY[i + lane];
      points.direction[2][lane] = front.directionZ[i + lane];
    }
    points.findSides(record);
    for (unsigned lane = 0; lane < PointLanes::kSize; ++lane)
    {
      // What escapes is on the front, as in WalkBatch.
      front.hitSide[i + lane] =
        points.side[lane] > 0 || front.hit[i + lane] == WalkFront::kNone ? 1 : 0;
    }
  }
}

template <class Lanes>
void runSlotsLoop(const SlotsLoop& loop)
{
  constexpr std::size_t kAhead = 2 * kGroup;
  const WalkFront& front = loop.front;
  ReplicateLanes replicates{};
  for (std::size_t i = loop.first; i < loop.end; i += kGroup)
  {
    for (unsigned lane = 0; i + kAhead < front.size && lane < kGroup; ++lane)
    {
      prefetchLine(loop.rows.lookOf(front.hit[i + kAhead + lane]));
    }
    if (loop.replicates > 1)
    {
      replicates.set(&front.walk[i], loop.firstWalk, loop.replicates);
    }
    std::uint32_t* const slots = loop.slots + (i - loop.first);
    alignas(64) std::uint32_t slot[kGroup];
    for (unsigned lane = 0; lane < kGroup; ++lane)
    {
      const std::uint32_t hit = front.hit[i + lane];
      const std::uint32_t cell = loop.rows.lookOf(hit)->cell & CellLook::kNumber;
      const std::uint32_t sum =
        cell * loop.perCell + replicates.replicate[lane] * loop.perReplicate;
      slot[lane] = hit == WalkFront::kNone ? loop.escaped : sum;
    }
    if (loop.perSide > 0)
    {
      for (unsigned lane = 0; lane < kGroup; ++lane)
      {
        slot[lane] += front.hitSide[i + lane] != 0 ? 0 : loop.perSide;
      }
    }
    std::memcpy(slots, slot, sizeof(slot));
  }
}

}
}
