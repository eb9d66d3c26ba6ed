// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PointLampChoice_h
#define irradiance_PointLampChoice_h

#include "DirectLight/LampChoice.h"
#include "Lights/SeenLight.h"

#include <optional>
#include <vector>

namespace irradiance
{

/**
 * Which lamp a sample of a point asks, and what it sees of that. If there are no more lamps than
 * samples, the weights are what each brings if nothing stands between: exactly, for a point that
 * receives from all directions or for lights in the air, else but for how the cosine varies over
 * the lamp. Of more lamps LampChoice tells roughly which bring how much.
 */
class PointLampChoice
{
public:
  /// The lamps must outlive it. `by`: see SeenLight. `most`: weights, see LampChoice.
  PointLampChoice(const LampPieces& lamps, const LitPoint& point, SeenLight::By by,
    std::uint32_t samples, std::size_t most);

  /// Whether no light can come.
  bool isEmpty() const { return !isRough_ && !(sum_ > 0); }
  struct Choice
  {
    std::uint32_t light;
    double probability;
    double rest;                   ///< in [0, 1): what the choice left of the sample
    std::optional<SeenLight> seen; ///< none if all of the piece is below the horizon
  };
  /// `sample`: in (0, 1). Not if it is empty.
  Choice choose(double sample) const;
  /// By solid angle, the probability of a piece over its solid angle, 1/sr; 0 if it is empty.
  double densityOf(std::uint32_t piece) const;

private:
  /// What the point sees of a piece.
  void addParts(std::uint32_t piece, std::vector<SeenLight>& parts) const;
  Choice chooseRoughly(double sample) const;

  const LampPieces& lamps_;
  LitPoint point_;
  SeenLight::By by_;
  bool isRough_;
  LampChoice rough_;
  std::vector<SeenLight> targets_;
  std::vector<double> cumulative_; ///< weights up to and including each target
  double sum_ = 0;
};

}

#endif
