// SPDX-License-Identifier: BSD-3-Clause
#include "Rivals/PlainTracer.h"

#include "Rivals/PlainPackets.h"
#include "Rivals/XorShift.h"

#include <algorithm>
#include <cmath>
#include <memory>

/// Walks side by side, from their lights to where they end. `Packet`: RTCRayHit8 or RTCRayHit16.
template <class Packet>
class PlainWavefront
{
public:
  static constexpr int kWidth = kWidthOf<Packet>;
  using Lanes = ::Lanes<kWidth>;
  using Column = LaneColumn<kWidth>;

  PlainWavefront(const PlainTracer& tracer, std::uint64_t seed)
    : tracer_(tracer)
    , context_(incoherentRays())
    , random_(seed)
  {
    initialize(packet_.ray);
    std::fill_n(packet_.hit.instID[0], kWidth, RTC_INVALID_GEOMETRY_ID);
  }

  /// `count`: at most Column::kBatch.
  void run(std::size_t count, PlainTracer::Tally& tally)
  {
    start(count);
    while (count > 0)
    {
      tally.segments += static_cast<std::int64_t>(count);
      count = bounce(count, tally.hits.data());
    }
  }

private:
  void start(std::size_t count)
  {
    for (std::size_t first = 0; first < count; first += kWidth)
    {
      Lanes origins, normals;
      drawOrigins(origins, normals);
      const Lanes directions = drawDirections(normals);
      origins_.store(origins, first);
      directions_.store(directions, first);
    }
  }

  void drawOrigins(Lanes& origins, Lanes& normals)
  {
    alignas(64) float place[kWidth], choice[kWidth], u[kWidth], v[kWidth];
    for (float* numbers : { place, choice, u, v })
    {
      random_.next(numbers);
    }
    for (int k = 0; k < kWidth; ++k)
    {
      u[k] = std::sqrt(u[k]); // so that the points are even over a triangle
      v[k] *= u[k];
    }
    for (int k = 0; k < kWidth; ++k)
    {
      const PlainSource& source = tracer_.sources_[tracer_.choice_.draw(place[k], choice[k])];
      const auto coordinate = [&](int i) {
        return source.origin[i] + u[k] * source.u[i] + v[k] * source.v[i];
      };
      origins.x[k] = coordinate(0);
      origins.y[k] = coordinate(1);
      origins.z[k] = coordinate(2);
      normals.x[k] = source.normal[0];
      normals.y[k] = source.normal[1];
      normals.z[k] = source.normal[2];
    }
  }

  Lanes drawDirections(const Lanes& normals)
  {
    alignas(64) float height[kWidth], turn[kWidth];
    random_.next(height);
    random_.next(turn);
    return cosineDirections(normals, height, turn);
  }

  /// One segment of each walk; the walks that survive move up. Returns how many they are.
  std::size_t bounce(std::size_t count, double* hits)
  {
    std::size_t kept = 0;
    for (std::size_t first = 0; first < count; first += kWidth)
    {
      cast(first, count - first);
      alignas(64) float chance[kWidth];
      random_.next(chance);
      bool survives[kWidth];
      for (int k = 0; k < kWidth; ++k)
      {
        const PlainScene::Surface surface = tracer_.surfaces_[packet_.hit.primID[k]];
        hits[surface.cell] += 1;
        survives[k] = chance[k] < surface.reflectance;
      }
      Lanes origins, normals;
      findPoints(packet_, tracer_.offset_, origins, normals);
      const Lanes directions = drawDirections(normals);
      // Without a branch: what does not survive is overwritten by the next walk.
      for (int k = 0; k < kWidth; ++k)
      {
        origins_.set(kept, origins, k);
        directions_.set(kept, directions, k);
        kept += survives[k];
      }
    }
    return kept;
  }

  /// `left`: walks from `first` on. Lanes past them, and rays that escape, hit the extra surface.
  void cast(std::size_t first, std::size_t left)
  {
    origins_.load(first, packet_.ray.org_x, packet_.ray.org_y, packet_.ray.org_z);
    directions_.load(first, packet_.ray.dir_x, packet_.ray.dir_y, packet_.ray.dir_z);
    const auto escaped = static_cast<unsigned>(tracer_.surfaces_.size() - 1);
    ::cast(tracer_.embree_.scene(), context_, left, escaped, packet_);
  }

  const PlainTracer& tracer_;
  RTCIntersectContext context_;
  Packet packet_{};
  XorShift<kWidth> random_;
  Column origins_{}, directions_{};
};

namespace
{

template <class Packet>
void shootWide(
  const PlainTracer& tracer, std::uint32_t walks, std::uint64_t seed, PlainTracer::Tally& tally)
{
  constexpr std::size_t kBatch = PlainWavefront<Packet>::Column::kBatch;
  const auto wavefront = std::make_unique<PlainWavefront<Packet>>(tracer, seed);
  for (std::size_t first = 0; first < walks; first += kBatch)
  {
    wavefront->run(std::min(kBatch, walks - first), tally);
  }
}

}

PlainTracer::PlainTracer(const PlainScene& scene, Packets packets)
  : surfaces_(scene.surfaces)
  , numberOfCells_(scene.numberOfCells)
  , sources_(makeSources(scene))
  , choice_(fluxesOf(scene))
  , offset_(scene.offset())
  , embree_(scene)
  , width_(packets == Packets::Best && embree_.hasPacketsOf16() ? 16 : 8)
{
  surfaces_.push_back({ 0, static_cast<std::uint32_t>(numberOfCells_) });
}

PlainTracer::Tally PlainTracer::shoot(std::uint32_t walks, std::uint64_t seed) const
{
  Tally tally{ std::vector<double>(numberOfCells_ + 1, 0.0), 0 };
  (width_ == 16 ? shootWide<RTCRayHit16> : shootWide<RTCRayHit8>)(*this, walks, seed, tally);
  tally.hits.pop_back(); // what escaped
  return tally;
}
