// SPDX-License-Identifier: BSD-3-Clause
#include "DirectLight/DirectPilot.h"

#include "DirectLight/CellSampler.h"
#include "Surfaces/ClearSheets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace irradiance
{

namespace
{

constexpr std::size_t kCells = 96;
constexpr std::uint32_t kSamples = 64; ///< of each cell, twice
constexpr double kCostOfSample = 4;    ///< in segments of walks

/// Some cells of an object, evenly by number.
SceneObject someCellsOf(const SceneObject& object)
{
  const Material& all = *object.material;
  const std::size_t count = std::min(kCells, all.numberOfCells);
  std::vector<std::uint32_t> chosen(all.numberOfCells, SceneTriangles::kNone);
  for (std::size_t i = 0; i < count; ++i)
  {
    chosen[i * all.numberOfCells / count] = static_cast<std::uint32_t>(i);
  }
  Material material;
  material.numberOfCells = count;
  material.reflectance.assign(count, 0);
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < all.cellOfTriangle.size(); ++i)
  {
    if (const std::uint32_t cell = chosen[all.cellOfTriangle[i]]; cell != SceneTriangles::kNone)
    {
      triangles.push_back(object.mesh()[i]);
      material.cellOfTriangle.push_back(cell);
    }
  }
  return { { std::make_shared<RigidObject>(TriangleMesh(triangles)) },
    std::make_shared<Material>(std::move(material)), nullptr };
}

}

DirectPilot::DirectPilot(const SceneObjects& objects, const LampPieces& lamps)
{
  Frame frame;
  frame.scene.setStatic(objects.staticObject.body);
  frame.scene.commit({});
  frame.objects = { someCellsOf(objects.staticObject), {} };
  frame.triangles = SceneTriangles(frame.objects);
  const ClearSheets sheets{ objects, frame.scene };
  const auto noTarget = [](std::size_t) { return TriangleId{}; };
  const CellShapes cells(frame, 0, 1);
  const DirectPlan plan(cells, lamps, { 1, kMostWalks, { kSamples, kSamples }, 1 });
  std::array<CellSampler, 2> samplers{ CellSampler(cells, frame, lamps, plan, 1),
    CellSampler(cells, frame, lamps, plan, 2) };
  LampChoice choice(lamps);
  double variances = 0, means = 0, asked = 0, arrived = 0;
  std::vector<DirectSample> samples;
  std::vector<Ray> rays;
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
  {
    const std::uint32_t count = plan.samplesOf(cell);
    std::array<double, 2> brought{}; // W
    for (std::size_t i = 0; i < 2 && count > 0; ++i)
    {
      samplers[i].setCell(cell);
      samples.clear();
      rays.clear();
      for (std::uint32_t number = 0; number < count; ++number)
      {
        const DirectSample sample = samplers[i].sample(number);
        const TriangleId lamp = lamps.lights()[sample.light].triangle();
        if (sample.part > 0)
        {
          samples.push_back(sample);
          rays.push_back(
            { sample.from, sample.to - sample.from, lamp.isDynamic() ? TriangleId{} : lamp });
        }
      }
      constexpr double kNear = 1 - 0x1p-20; // the cell's own triangle hides nothing
      const std::vector<ClearSheets::Way> ways =
        sheets.cast(rays.data(), rays.size(), noTarget, kNear);
      for (std::size_t ray = 0; ray < rays.size(); ++ray)
      {
        brought[i] += ways[ray].hit.distance >= kNear
          ? ways[ray].passed * samples[ray].part * lamps.lights()[samples[ray].light].totalFlux()
          : 0;
      }
    }
    const double expected = choice.expectedPower(cells[cell]);
    if (expected > 0)
    {
      const double difference = brought[0] - brought[1], area = cells[cell].area;
      variances += count * difference * difference / 2 / (expected * area);
      means += (brought[0] + brought[1]) / 2 / area;
      asked += expected;
      arrived += (brought[0] + brought[1]) / 2;
    }
  }
  if (means > 0)
  {
    variance_ = variances / means;
    asked_ = asked / arrived;
  }
}

std::pair<double, double> DirectPilot::best(
  double arrived, double returned, double powerOfStart) const
{
  constexpr double kMostReturned = 0.95;
  const double part = std::min(returned, kMostReturned);
  const double segments = 1 / (1 - part); // of a walk
  const double indirect = part * powerOfStart * segments, cost = kCostOfSample * asked_;
  const double walks =
    std::clamp(std::sqrt(indirect * cost / (std::max(variance_, 0x1p-40) * segments)), kFewestWalks,
      kMostWalks);
  const double gathered = (walks * variance_ + indirect) * (cost / walks + segments);
  const double lost = 1 / std::max(arrived, 0x1p-40) - 1; // walks for each that arrives
  return { walks, gathered / (segments * (segments + lost)) };
}

}
