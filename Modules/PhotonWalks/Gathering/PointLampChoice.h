// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PointLampChoice_h
#define irradiance_PointLampChoice_h

#include "Gathering/LampChoice.h"
#include "Gathering/LitPoint.h"
#include "Sampling/SphericalTriangle.h"

#include <vector>

namespace irradiance
{

/**
 * Which lamp a sample of a point asks. If there are no more lamps than samples, the weights are what each brings if
 * nothing stands between: exactly, for a point that receives from all directions or for lights in the air, else but for how
 * the cosine varies over the lamp. Of more lamps LampChoice tells roughly which bring how much.
 */
class PointLampChoice
{
public:
  /// The lamps must outlive it. `most`: weights, of groups of lamps.
  PointLampChoice(const LampPieces& lamps, const LitPoint& point, std::uint32_t samples,
    std::size_t most = LampChoice::kMost);

  /// Whether no light can come.
  bool isEmpty() const { return !isRough_ && !(sum_ > 0); }
  /// `sample`: in (0, 1). Not if it is empty.
  LampChoice::Choice choose(double sample) const;
  /// The triangle of a piece that was chosen, as seen from the point.
  SphericalTriangle seen(std::uint32_t piece) const;

  /// With which a piece is chosen; 0 if it is empty.
  double probabilityOf(std::uint32_t piece) const;

  /// W/m2 for each W of the flux of a light in the air, if nothing stands between, along a vector from it; `part`: of the
  /// beam that the point receives. 0 at its very place.
  static double perWatt(const PointLight& light, const Vector3& along, double part)
  {
    const double square = along.squaredNorm();
    return square > 0 && part > 0 ? light.density(along) * part / square : 0;
  }

private:
  /// W/m2 that the last piece that was seen brings if nothing stands between; roughly.
  double weightOf(const LampPiece& lamp) const;

  const LampPieces& lamps_;
  LitPoint point_;
  bool isRough_;
  LampChoice rough_;
  std::vector<SphericalTriangle> seen_; ///< by piece
  std::vector<double> cumulative_;      ///< weights up to and including each piece
  double sum_ = 0;
};

}

#endif
