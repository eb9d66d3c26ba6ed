// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_OutgoingRadiance_h
#define irradiance_OutgoingRadiance_h

#include "Views/ViewFinalGather.h"

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
  OutgoingRadiance(const IrradianceEngine& engine, std::uint32_t samples, Execution& execution);

  /// Of a cell; 0 if it has no area. What is emitted has no error; that of what is reflected is not
  /// known either where this is too little.
  using Light = ViewedLight;
  /// May be called by several threads. Throws std::runtime_error for a path that does not end.
  std::vector<Light> at(const std::vector<SceneCell>& cells, const Eye& eye) const;
  Light at(const SceneCell& cell, const Eye& eye) const { return at(std::vector{ cell }, eye)[0]; }

private:
  /// The parts of a cell's area of which an eye sees the front and the back; 0 without an area.
  using SeenParts = std::array<double, 2>;
  SeenParts partsOf(const SceneCell& cell, const Eye& eye) const;
  /// Whose irradiance a side has.
  CellSide sumsOf(const SceneCell& cell, std::size_t side) const
  {
    return { cell, engine_.settings().separateSides ? static_cast<int>(side) : CellSide::kBoth };
  }
  /// What a side sends diffusely: a part of the irradiance of this one and of the other.
  using SentParts = std::array<std::pair<CellSide, double>, 2>;
  SentParts sentBy(const SceneCell& cell, std::size_t side, std::size_t band) const;
  bool isSpecular(const SceneCell& cell) const
  {
    return engine_.cells().area(cell) > 0 && materialOf(cell).isSpecular(cell.cell);
  }
  /// `specular`: what each replicate found for a specular reflectance of pi; empty of a cell
  /// without.
  Light lightOf(const SceneCell& cell, const Eye& eye, const std::vector<Bands>& specular) const;
  double standardErrorOf(const SceneCell& cell, const SeenParts& parts, std::size_t band,
    const std::vector<Bands>& specular) const;
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

#endif
