// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_OutgoingRadiance_h
#define irradiance_OutgoingRadiance_h

#include "IrradianceEngine.h"
#include "Views/GlossyPhotons.h"
#include "Walks/StoredWalks.h"

#include <vector>

namespace irradiance
{

/**
 * The radiance, W/m2/sr, that leaves cells towards an eye: emitted, reflected diffusely (from the
 * sums) and specularly (from the photons on the cell). Means over the area of a cell, both of the
 * light and of the direction to the eye. What stands between is not looked at.
 *
 * The specular part is the sum over photons of power times BRDF, over the area, so it is as noisy as
 * the photons in a lobe are few. What a cell gathered are photons to it: each sample that sees its light is one. Mirrors have no such sum: at some points of a mirror a ray shows
 * what is seen there. Where SeparateSides is off, diffuse light is the light of both sides.
 */
class OutgoingRadiance
{
public:
  using Bands = GlossyPhotons::Bands;

  /// Prepares what does not depend on the eye, in the present state of the engine. That must have
  /// collected its specular photons, and must not change as long as this is used. Throws Interrupted.
  OutgoingRadiance(
    const IrradianceEngine& engine, std::uint32_t mirrorSamples, Execution& execution);

  /// May be called by several threads. 0 for a cell without area.
  Bands operator()(const SceneCell& cell, const Eye& eye) const;

private:
  /// A mirror is followed by at most this many others.
  static constexpr int kMostMirrors = 64;

  /// The triangles of an object, cell by cell.
  struct Cells
  {
    std::vector<std::uint32_t> triangles;
    std::vector<std::size_t> first; ///< of each cell, and the end
  };
  void addCells(std::uint32_t object);
  void preparePhotons(Execution& execution);
  /// What walks brought to a cell, in order, and then what it gathered.
  std::vector<GlossyPhotons::Arrival> arrivalsOn(
    const SceneCell& cell, const StoredWalks& walks) const;
  void addGathered(const SceneCell& cell, const GatheredLight& light,
    std::vector<GlossyPhotons::Arrival>& arrivals) const;
  Bands wattsOf(const Power& power) const
  {
    return { engine_.watts(power[0]), engine_.watts(power[1]), engine_.watts(power[2]) };
  }
  Bands diffuse(const SceneCell& cell, const Eye& eye) const;
  /// Emitted, and reflected diffusely, by one side.
  Bands diffuseOf(const SceneCell& cell, bool isFront) const;
  Bands specular(const SceneCell& cell, const Eye& eye) const;
  Bands mirrored(const SceneCell& cell, const Eye& eye) const;
  /// Rays on their way through mirrors, with the part of what they meet that gets to the eye.
  struct Sights
  {
    std::vector<Ray> rays;
    std::vector<Bands> shares;
  };
  /// Adds what the rays show, and replaces them by those that mirrors reflect.
  void look(Sights& sights, Bands& sum) const;
  /// The ray that shows what is mirrored at a point of a cell.
  Ray mirrorRay(const SceneCell& cell, std::uint32_t sample, const Eye& eye) const;
  bool isSpecular(const SceneCell& cell) const
  {
    return materialOf(cell.object).isSpecular(cell.cell);
  }
  const PhongLobe& lobeOf(const SceneCell& cell) const
  {
    return materialOf(cell.object).lobeOf(cell.cell);
  }
  std::size_t numberOf(const SceneCell& cell) const { return engine_.cells().numbers()[cell]; }
  const Material& materialOf(std::uint32_t object) const
  {
    return *engine_.objects()[object].material;
  }

  const IrradianceEngine& engine_;
  SobolSequence mirrorPoints_;
  std::uint32_t mirrorSamples_;
  int bands_;
  std::vector<Cells> objects_;
  std::vector<GlossyPhotons> photons_; ///< of each cell
};

}

#endif
