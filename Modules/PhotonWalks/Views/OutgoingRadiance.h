// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Views/ViewFinalGather.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace irradiance
{

/// Who looks: from a point, or from infinitely far away (parallel projection).
struct Eye
{
  Vector3 position; ///< or the unit direction to the eye
  bool isFar = false;

  /// A unit vector; zero at the eye's own place.
  Vector3 directionFrom(const Vector3& point) const
  {
    if (isFar)
    {
      return position;
    }
    const Vector3 away = position - point;
    const double squared = away.squaredNorm();
    if (squared > 0x1p-900 && squared < 0x1p+1000)
    {
      return away / std::sqrt(squared);
    }
    const double longest = away.cwiseAbs().maxCoeff(); // its square is too large or small
    return longest > 0 ? Vector3((away / longest).normalized()) : away;
  }
};

/**
 * The radiance, W/m2/sr, that leaves cells towards an eye: emitted, reflected diffusely (from the
 * irradiance of the cell) and specularly. Means over the area of a cell, both of the light and of
 * the direction to the eye. What stands between is not looked at, nor what stands behind a sheet.
 * Where SeparateSides is off, diffuse light is the light of both sides.
 *
 * Specular light is gathered: from points spread over the cell rays leave along the lobe about the
 * mirrored direction to the eye, and read what they hit as those of sensors do, see
 * ViewFinalGather; lamps are also asked, see lobeLight(). A mirror cannot see a light without size;
 * nor does a lobe what such a light sends it by way of a mirror. Theory.md, 1.2.
 *
 * All is a pure function of the scene, the seed, the sums and the eye.
 */
class OutgoingRadiance
{
public:
  /// Prepares what does not depend on the eye, in the present frame of an engine, which must not
  /// change meanwhile. `samples`: of a specular cell; rounded up to a multiple of the replicates.
  /// Throws Interrupted.
  OutgoingRadiance(const IrradianceEngine& engine, std::uint32_t samples, Execution& execution)
    : engine_(engine)
    , errors_(engine.errorEstimate())
    , shapes_(engine.frame(), 0, engine.objects().size())
  {
    if (engine.frame().triangles.hasGlossy())
    {
      gather_.emplace(engine, shapes_, samples, true, false, execution);
    }
  }

  /// Of a cell; 0 if it has no area. What is emitted has no error; that of what is reflected is not
  /// known either where this is too little.
  using Light = ViewedLight;
  /// May be called by several threads. Throws std::runtime_error for a path that does not end.
  std::vector<Light> at(const std::vector<SceneCell>& cells, const Eye& eye) const
  {
    PathSums brought;
    if (gather_)
    {
      const FollowedPaths followed = gather_->follow([&](FinalGatherPaths& paths) {
        for (const SceneCell& cell : cells)
        {
          if (isSpecular(cell))
          {
            // By object and cell: absent cells have numbers in a frame that follows others, and none
            // in a fresh one.
            const std::uint64_t number = std::uint64_t{ cell.object } << 40 | cell.cell;
            paths.addSpecular(engine_.cells().numbers()[cell], number,
              [&](const Vector3& point) { return eye.directionFrom(point); });
          }
        }
      });
      brought = PathSums(gather_->scene(), followed);
    }
    std::vector<Light> lights;
    lights.reserve(cells.size());
    std::size_t start = 0;
    for (const SceneCell& cell : cells)
    {
      lights.push_back(lightOf(cell, eye,
        isSpecular(cell) ? gather_->replicatesOf(brought, start++, 1) : std::vector<Bands>()));
    }
    return lights;
  }
  Light at(const SceneCell& cell, const Eye& eye) const { return at(std::vector{ cell }, eye)[0]; }

private:
  /// The parts of a cell's area of which an eye sees the front and the back; 0 without an area.
  using SeenParts = std::array<double, 2>;
  /// Each triangle of the cell shows the eye one of its sides.
  SeenParts partsOf(const SceneCell& cell, const Eye& eye) const
  {
    const std::size_t number = engine_.cells().numbers()[cell];
    double front = 0, back = 0; // m2
    std::for_each(shapes_.begin(number), shapes_.end(number), [&](std::uint32_t i) {
      const Triangle triangle = triangleOf(engine_.frame().triangles, i);
      const Vector3 toEye = eye.directionFrom((triangle.a + triangle.b + triangle.c) / 3);
      (toEye.dot(triangle.areaVector()) >= 0 ? front : back) += triangle.area();
    });
    const double area = front + back;
    return { front > 0 ? front / area : 0, back > 0 ? back / area : 0 };
  }
  /// Whose irradiance a side has.
  CellSide sumsOf(const SceneCell& cell, std::size_t side) const
  {
    return { cell, engine_.settings().separateSides ? static_cast<int>(side) : CellSide::kBoth };
  }
  /// What a side sends diffusely: a part of the irradiance of this one and of the other.
  using SentParts = std::array<std::pair<CellSide, double>, 2>;
  SentParts sentBy(const SceneCell& cell, std::size_t side, std::size_t band) const
  {
    const Material& material = materialOf(cell);
    const double reflected = material.partOf(Leaving::Diffuse, cell.cell, 1)[band],
                 through = material.partOf(Leaving::DiffuseThrough, cell.cell, 1)[band];
    if (engine_.settings().separateSides)
    {
      return { { { sumsOf(cell, side), reflected }, { sumsOf(cell, 1 - side), through } } };
    }
    // Light of both sides together: of a sheet each sends half of all that leaves.
    const double part = material.transmits(cell.cell) ? (reflected + through) / 2 : reflected;
    return { { { sumsOf(cell, side), part }, { sumsOf(cell, 1 - side), 0 } } };
  }
  bool isSpecular(const SceneCell& cell) const
  {
    return engine_.cells().area(cell) > 0 && materialOf(cell).isSpecular(cell.cell);
  }
  /// `specular`: what each replicate found for a specular reflectance of pi; empty of a cell
  /// without.
  Light lightOf(const SceneCell& cell, const Eye& eye, const std::vector<Bands>& specular) const
  {
    const Material& material = materialOf(cell);
    const SeenParts parts = partsOf(cell, eye);
    const Vector3 toEye = eye.directionFrom(shapes_[engine_.cells().numbers()[cell]].center);
    Light light;
    for (int band = 0; band < material.bands && (parts[0] != 0 || parts[1] != 0); ++band)
    {
      const auto i = static_cast<std::size_t>(band);
      const std::size_t slot = cell.cell * static_cast<std::size_t>(material.bands) + i;
      double leaving = 0; // W/m2
      for (std::size_t side = 0; side < 2; ++side)
      {
        if (parts[side] != 0)
        {
          const Bands emitted =
            emittedFrom(engine_.objects()[cell.object], cell.cell, side == 0, toEye);
          leaving += parts[side] * emitted[i];
          for (const auto& [sums, part] : sentBy(cell, side, i))
          {
            leaving += parts[side] * part * engine_.irradiance(sums, band);
          }
        }
      }
      for (const Bands& replicate : specular)
      {
        leaving += material.specularReflectance[slot] * replicate[i];
      }
      light.value[i] = leaving / kPi;
      light.standardError[i] = standardErrorOf(cell, parts, i, specular) / kPi;
    }
    return light;
  }
  /// Times pi. The parts are added up in each replicate before these are compared, as both may read
  /// the same sums. It is not less than the error of the irradiance, which knows of steps.
  double standardErrorOf(const SceneCell& cell, const SeenParts& seen, std::size_t band,
    const std::vector<Bands>& specular) const
  {
    const Material& material = materialOf(cell);
    const std::size_t slot = cell.cell * static_cast<std::size_t>(material.bands) + band;
    const double diffuse =
      material.reflectance[slot] + material.partOf(Leaving::DiffuseThrough, cell.cell, 1)[band];
    const double mirrored = specular.empty() ? 0 : material.specularReflectance[slot];
    if (!(diffuse + mirrored > 0))
    {
      return 0;
    }
    const std::uint32_t replicates = errors_.replicates();
    std::vector<double> parts(replicates);
    double least = 0;
    for (std::size_t side = 0; side < 2; ++side)
    {
      for (const auto& [sums, part] : sentBy(cell, side, band))
      {
        if (!(seen[side] * part > 0))
        {
          continue;
        }
        const double perQuantum =
          part * seen[side] * engine_.watts(1.0) / engine_.cells().area(cell);
        least += perQuantum * errors_.standardError(sums, static_cast<int>(band));
        for (std::uint32_t k = 0; k < replicates; ++k)
        {
          parts[k] +=
            perQuantum * errors_.ofReplicate(sums, static_cast<int>(band), k) / replicates;
        }
      }
    }
    for (std::size_t k = 0; k < specular.size(); ++k)
    {
      parts[k] += mirrored * specular[k][band];
    }
    const double error = irradiance::standardErrorOf(parts);
    return std::isnan(error) || std::isnan(least) ? std::nan("") : std::max(error, least);
  }
  const Material& materialOf(const SceneCell& cell) const
  {
    return *engine_.objects()[cell.object].material;
  }

  const IrradianceEngine& engine_;
  ErrorEstimate errors_;
  CellShapes shapes_;
  std::optional<ViewFinalGather> gather_; ///< if there are specular cells
};

}
