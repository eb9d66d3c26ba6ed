// SPDX-License-Identifier: BSD-3-Clause
#include "Rivals/PlainGatherer.h"

#include "Rivals/PlainPackets.h"
#include "Rivals/SobolNumbers.h"
#include "Rivals/XorShift.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <random>

namespace
{

constexpr float kPi = 3.14159265f;

void findOccluded(const int* valid, RTCScene scene, RTCIntersectContext& context, RTCRay8& rays)
{
  rtcOccluded8(valid, scene, &context, &rays);
}

void findOccluded(const int* valid, RTCScene scene, RTCIntersectContext& context, RTCRay16& rays)
{
  rtcOccluded16(valid, scene, &context, &rays);
}

/// The power heuristic.
float weightOf(float density, float other)
{
  return density * density / (density * density + other * other);
}

}

/// The paths of some cells, side by side. `Packet`: RTCRayHit8 or RTCRayHit16.
template <class Packet>
class GatherFront
{
public:
  static constexpr int kWidth = kWidthOf<Packet>;
  using Lanes = ::Lanes<kWidth>;
  using Column = LaneColumn<kWidth>;

  /// As in PlainGatherer::gather().
  GatherFront(const PlainGatherer& gatherer, std::uint32_t firstCell, std::uint32_t endCell,
    std::uint32_t pathsPerCell, std::uint64_t seed)
    : gatherer_(gatherer)
    , firstCell_(firstCell)
    , pathsPerCell_(pathsPerCell)
    , numbers_(makeSobolNumbers(pathsPerCell))
    , shifts_(endCell - firstCell)
    , context_(incoherentRays())
    , random_(seed)
  {
    std::mt19937_64 random(seed);
    for (auto& shift : shifts_)
    {
      std::generate(shift.begin(), shift.end(), [&] { return random() >> 32; });
    }
    initialize(packet_.ray);
    initialize(shadows_);
    std::fill_n(packet_.hit.instID[0], kWidth, RTC_INVALID_GEOMETRY_ID);
  }

  /// Paths are counted through all cells. `count`: at most Column::kBatch. Adds to the sums of
  /// cells.
  void run(std::size_t first, std::size_t count, PlainGatherer::Tally& tally)
  {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; i += kWidth)
    {
      start(first + i, count - i, kept, tally);
    }
    while (kept > 0)
    {
      tally.rays += static_cast<std::int64_t>(kept);
      kept = bounce(kept, tally);
    }
  }

private:
  /// Where paths are.
  struct Vertices
  {
    Lanes points, normals;              ///< on surfaces; on the side of the path, of unit length
    alignas(64) float survival[kWidth]; ///< with what probability; what does not exist has 0
    alignas(64) float sides[kWidth];    ///< to which the path may leave, 1 or 2
    alignas(64) float weight[kWidth]; ///< of a path that leaves: 2 if it began on one of two sides
    alignas(64) float reflected[kWidth];    ///< what counts of the light of lamps
    alignas(64) std::uint32_t cell[kWidth]; ///< that the path began on, from firstCell_ on
  };
  /// Uniform in [0, 1), for one light and one direction.
  struct Numbers
  {
    alignas(64) float u[kWidth], v[kWidth], place[kWidth], choice[kWidth]; ///< of the light
    alignas(64) float height[kWidth], turn[kWidth];                        ///< of the direction
  };

  void start(std::size_t first, std::size_t left, std::size_t& kept, PlainGatherer::Tally& tally)
  {
    Vertices vertices;
    Numbers numbers;
    for (int k = 0; k < kWidth; ++k)
    {
      const bool exists = static_cast<std::size_t>(k) < left;
      const std::size_t path = first + (exists ? static_cast<std::size_t>(k) : 0);
      vertices.survival[k] = vertices.reflected[k] = exists ? 1.f : 0.f;
      drawStart(static_cast<std::uint32_t>(path / pathsPerCell_), path % pathsPerCell_, k, vertices,
        numbers);
    }
    castShadows(vertices, numbers, tally);
    leave(vertices, numbers, kept);
  }

  void drawStart(
    std::uint32_t cell, std::size_t path, int k, Vertices& vertices, Numbers& numbers) const
  {
    const auto number = [&](std::size_t dimension) {
      const std::uint32_t bits = numbers_[path][dimension] ^ shifts_[cell][dimension];
      return static_cast<float>(static_cast<std::int32_t>(bits >> 8)) * 0x1p-24f;
    };
    numbers.u[k] = number(2);
    numbers.v[k] = number(3);
    numbers.place[k] = number(4);
    numbers.height[k] = number(5);
    numbers.choice[k] = number(7);
    const PlainGatherer::Cell& on = gatherer_.cells_[firstCell_ + cell];
    // Half of the turns are for the back.
    const float turn = on.isOpen ? 2 * number(6) : number(6);
    numbers.turn[k] = turn < 1 ? turn : turn - 1;
    vertices.sides[k] = vertices.weight[k] = on.isOpen ? 2 : 1;
    vertices.cell[k] = cell;
    setPoint(on, number(0), number(1), turn < 1 ? 1.f : -1.f, k, vertices);
  }

  /// `side`: 1 for the front, -1 for the back.
  void setPoint(
    const PlainGatherer::Cell& cell, float u, float v, float side, int k, Vertices& vertices) const
  {
    std::uint32_t i = cell.endPiece - 1;
    while (i > cell.firstPiece && u < gatherer_.pieces_[i].begin)
    {
      --i;
    }
    const PlainGatherer::Piece& piece = gatherer_.pieces_[i];
    const float s = std::sqrt((u - piece.begin) * piece.scale), t = v * s;
    const auto coordinate = [&](int axis) {
      return piece.origin[axis] + s * piece.u[axis] + t * piece.v[axis];
    };
    vertices.points.x[k] = coordinate(0);
    vertices.points.y[k] = coordinate(1);
    vertices.points.z[k] = coordinate(2);
    vertices.normals.x[k] = side * piece.normal[0];
    vertices.normals.y[k] = side * piece.normal[1];
    vertices.normals.z[k] = side * piece.normal[2];
  }

  /// One segment of each path, and what reaches it there; the paths that survive move up. Returns
  /// how many they are.
  std::size_t bounce(std::size_t count, PlainGatherer::Tally& tally)
  {
    std::size_t kept = 0;
    for (std::size_t first = 0; first < count; first += kWidth)
    {
      origins_.load(first, packet_.ray.org_x, packet_.ray.org_y, packet_.ray.org_z);
      directions_.load(first, packet_.ray.dir_x, packet_.ray.dir_y, packet_.ray.dir_z);
      const auto escaped = static_cast<unsigned>(gatherer_.surfaces_.size() - 1);
      cast(gatherer_.embree_.scene(), context_, count - first, escaped, packet_);
      Vertices vertices;
      findPoints(packet_, 0.f, vertices.points, vertices.normals);
      for (int k = 0; k < kWidth; ++k)
      {
        const std::size_t i = first + static_cast<std::size_t>(k);
        vertices.survival[k] = gatherer_.surfaces_[packet_.hit.primID[k]].reflectance;
        vertices.cell[k] = i < count ? cells_[i] : 0;
        vertices.sides[k] = 1;
        vertices.weight[k] = i < count ? weights_[i] : 0;
        vertices.reflected[k] = vertices.weight[k] * vertices.survival[k];
      }
      gatherer_.sky_ ? countSky(count - first, vertices, tally)
                     : countLamps(first, vertices, tally);
      Numbers numbers;
      for (float* some :
        { numbers.u, numbers.v, numbers.place, numbers.choice, numbers.height, numbers.turn })
      {
        random_.next(some);
      }
      castShadows(vertices, numbers, tally);
      leave(vertices, numbers, kept);
    }
    return kept;
  }

  /// Of the rays from `first` on, those that have hit the front of a lamp by themselves.
  void countLamps(std::size_t first, const Vertices& vertices, PlainGatherer::Tally& tally) const
  {
    for (int k = 0; k < kWidth; ++k)
    {
      const float density = gatherer_.surfaces_[packet_.hit.primID[k]].density;
      const auto& [ray, hit] = packet_;
      const float along =
        hit.Ng_x[k] * ray.dir_x[k] + hit.Ng_y[k] * ray.dir_y[k] + hit.Ng_z[k] * ray.dir_z[k];
      if (density == 0 || along >= 0)
      {
        continue;
      }
      const float square =
        ray.dir_x[k] * ray.dir_x[k] + ray.dir_y[k] * ray.dir_y[k] + ray.dir_z[k] * ray.dir_z[k];
      const float length = std::sqrt(square),
                  down =
                    -(vertices.normals.x[k] * ray.dir_x[k] + vertices.normals.y[k] * ray.dir_y[k] +
                      vertices.normals.z[k] * ray.dir_z[k]) /
        length;
      const float sides = sides_[first + static_cast<std::size_t>(k)];
      const float own = 0.5f * length / (kPi * sides); // the length is 2 x the cosine
      const float byShadow = density * ray.tfar[k] * ray.tfar[k] * square / down;
      tally.irradiance[vertices.cell[k]] +=
        vertices.weight[k] * density * gatherer_.totalFlux_ * weightOf(own, byShadow);
    }
  }

  /// Of those rays that are left, those that escape.
  void countSky(std::size_t left, const Vertices& vertices, PlainGatherer::Tally& tally) const
  {
    const auto& [ray, hit] = packet_;
    for (int k = 0; k < kWidth && static_cast<std::size_t>(k) < left; ++k)
    {
      if (hit.geomID[k] == RTC_INVALID_GEOMETRY_ID)
      {
        const float scale = 1 /
          std::sqrt(ray.dir_x[k] * ray.dir_x[k] + ray.dir_y[k] * ray.dir_y[k] +
            ray.dir_z[k] * ray.dir_z[k]);
        tally.irradiance[vertices.cell[k]] += vertices.weight[k] * kPi *
          gatherer_.sky_({ scale * ray.dir_x[k], scale * ray.dir_y[k], scale * ray.dir_z[k] });
      }
    }
  }

  /// To a point of a lamp from each vertex.
  void castShadows(const Vertices& vertices, const Numbers& numbers, PlainGatherer::Tally& tally)
  {
    if (gatherer_.sky_)
    {
      return;
    }
    alignas(64) float watts[kWidth];
    alignas(64) int valid[kWidth];
    for (int k = 0; k < kWidth; ++k)
    {
      const PlainSource& source =
        gatherer_.sources_[gatherer_.choice_.draw(numbers.place[k], numbers.choice[k])];
      watts[k] = aimShadow(vertices, k, source, numbers.u[k], numbers.v[k]);
      const bool isRay = watts[k] > 0;
      valid[k] = isRay ? -1 : 0;
      shadows_.tfar[k] = isRay ? 1.f : -1.f;
      tally.rays += isRay;
    }
    findOccluded(valid, gatherer_.embree_.scene(), context_, shadows_);
    for (int k = 0; k < kWidth; ++k)
    {
      tally.irradiance[vertices.cell[k]] += shadows_.tfar[k] > 0 ? watts[k] : 0.f;
    }
  }

  /// Sets a ray that ends where the point of the lamp lies off its surface. Returns what it brings
  /// if nothing is in its way, W/m2.
  float aimShadow(const Vertices& vertices, int k, const PlainSource& source, float u, float v)
  {
    const float s = std::sqrt(u), t = v * s;
    const auto target = [&](int axis) {
      return source.origin[axis] + s * source.u[axis] + t * source.v[axis];
    };
    const float x = target(0), y = target(1), z = target(2);
    const Lanes &points = vertices.points, &normals = vertices.normals;
    const float dx = x - points.x[k], dy = y - points.y[k], dz = z - points.z[k];
    float along = dx * normals.x[k] + dy * normals.y[k] + dz * normals.z[k];
    // What may leave to both sides goes to that of the lamp.
    const float side = vertices.sides[k] > 1 ? std::copysign(1.f, along) : 1.f;
    along *= side;
    const float offset = side * gatherer_.offset_;
    shadows_.org_x[k] = points.x[k] + offset * normals.x[k];
    shadows_.org_y[k] = points.y[k] + offset * normals.y[k];
    shadows_.org_z[k] = points.z[k] + offset * normals.z[k];
    shadows_.dir_x[k] = x - shadows_.org_x[k];
    shadows_.dir_y[k] = y - shadows_.org_y[k];
    shadows_.dir_z[k] = z - shadows_.org_z[k];

    const float down = -(dx * source.normal[0] + dy * source.normal[1] + dz * source.normal[2]);
    const float square = dx * dx + dy * dy + dz * dz, distance = std::sqrt(square);
    const bool isPoint = source.density == 0;
    if (!(along > 0 && (isPoint || down > 0)))
    {
      return 0;
    }
    const float watts = vertices.reflected[k] * gatherer_.totalFlux_ * along / kPi;
    if (isPoint)
    {
      return 0.25f * watts / (square * distance);
    }
    const float byShadow = source.density * square * distance / down;
    const float own = along / (distance * kPi * vertices.sides[k]);
    return watts * down / (square * square) * weightOf(byShadow, own);
  }

  /// Those that survive are stored as rays.
  void leave(const Vertices& vertices, const Numbers& numbers, std::size_t& kept)
  {
    alignas(64) float chance[kWidth];
    random_.next(chance);
    const Lanes directions = cosineDirections(vertices.normals, numbers.height, numbers.turn);
    const Lanes &points = vertices.points, &normals = vertices.normals;
    Lanes origins;
    for (int k = 0; k < kWidth; ++k)
    {
      origins.x[k] = points.x[k] + gatherer_.offset_ * normals.x[k];
      origins.y[k] = points.y[k] + gatherer_.offset_ * normals.y[k];
      origins.z[k] = points.z[k] + gatherer_.offset_ * normals.z[k];
    }
    // Without a branch: what does not survive is overwritten by the next path.
    for (int k = 0; k < kWidth; ++k)
    {
      origins_.set(kept, origins, k);
      directions_.set(kept, directions, k);
      cells_[kept] = vertices.cell[k];
      sides_[kept] = vertices.sides[k];
      weights_[kept] = vertices.weight[k];
      kept += chance[k] < vertices.survival[k];
    }
  }

  const PlainGatherer& gatherer_;
  std::uint32_t firstCell_, pathsPerCell_;
  SobolNumbers numbers_;
  SobolNumbers shifts_; ///< of each cell
  RTCIntersectContext context_;
  Packet packet_{};
  decltype(Packet::ray) shadows_{};
  XorShift<kWidth> random_;
  Column origins_{}, directions_{};
  std::uint32_t cells_[Column::kBatch + kWidth];
  float sides_[Column::kBatch + kWidth], weights_[Column::kBatch + kWidth];
};

namespace
{

template <class Packet>
PlainGatherer::Tally gatherWide(const PlainGatherer& gatherer, std::uint32_t firstCell,
  std::uint32_t endCell, std::uint32_t pathsPerCell, std::uint64_t seed)
{
  constexpr std::size_t kBatch = GatherFront<Packet>::Column::kBatch;
  const auto front =
    std::make_unique<GatherFront<Packet>>(gatherer, firstCell, endCell, pathsPerCell, seed);
  PlainGatherer::Tally tally;
  tally.irradiance.resize(endCell - firstCell);
  const std::size_t paths = tally.irradiance.size() * pathsPerCell;
  for (std::size_t first = 0; first < paths; first += kBatch)
  {
    front->run(first, std::min(kBatch, paths - first), tally);
  }
  for (double& sum : tally.irradiance)
  {
    sum /= pathsPerCell;
  }
  return tally;
}

}

PlainGatherer::PlainGatherer(const PlainScene& scene)
  : embree_(scene)
  , sources_(makeSources(scene))
  , choice_(scene.sky ? std::vector<double>{ 1 } : fluxesOf(scene))
  , totalFlux_(static_cast<float>(scene.totalFlux()))
  , offset_(scene.offset())
  , sky_(scene.sky)
{
  for (const PlainScene::Surface& surface : scene.surfaces)
  {
    surfaces_.push_back({ surface.reflectance, 0 });
  }
  surfaces_.push_back({ 0, 0 });
  for (std::size_t i = 0; i < scene.lights.size(); ++i)
  {
    surfaces_[scene.lights[i].triangle].density = sources_[i].density;
  }
  makeCells(scene);
}

void PlainGatherer::makeCells(const PlainScene& scene)
{
  std::vector<std::vector<std::uint32_t>> trianglesOf(scene.numberOfCells);
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i)
  {
    trianglesOf[scene.surfaces[i].cell].push_back(i);
  }
  const std::vector<char> isOpen = findOpenCells(scene, embree_);
  for (std::size_t cell = 0; cell < trianglesOf.size(); ++cell)
  {
    const auto first = static_cast<std::uint32_t>(pieces_.size());
    double whole = 0;
    for (const std::uint32_t triangle : trianglesOf[cell])
    {
      whole += areaOf(makePatch(scene.triangles[triangle], 0));
    }
    double before = 0;
    for (const std::uint32_t triangle : trianglesOf[cell])
    {
      const PlainPatch patch = makePatch(scene.triangles[triangle], 0);
      const double area = areaOf(patch);
      pieces_.push_back(
        { patch, static_cast<float>(before / whole), static_cast<float>(whole / area) });
      before += area;
    }
    cells_.push_back({ first, static_cast<std::uint32_t>(pieces_.size()), isOpen[cell] != 0 });
  }
}

PlainGatherer::Tally PlainGatherer::gather(std::uint32_t firstCell, std::uint32_t endCell,
  std::uint32_t pathsPerCell, std::uint64_t seed) const
{
  return (embree_.hasPacketsOf16() ? gatherWide<RTCRayHit16> : gatherWide<RTCRayHit8>)(*this,
    firstCell, endCell, pathsPerCell, seed);
}
