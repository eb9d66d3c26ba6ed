// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_LampChoice_h
#define irradiance_LampChoice_h

#include "Lights/LightTable.h"
#include "Surfaces/CellShapes.h"

#include <vector>

namespace irradiance
{

/// A light from afar. A light in the air has no normal and shines alike in all directions.
struct LampShape
{
  explicit LampShape(const Light& light);

  Vector3 center = Vector3::Zero();
  double radius = 0;
  Vector3 normal = Vector3::Zero(); ///< unit, or zero
  double flux = 0;                  ///< W, in all bands
};

/**
 * Which light a sample of a cell asks. The weights follow what each light would bring to the cell if nothing
 * stood between them: its flux, the cosines, with slack for the sizes of both, and the distance. A small part
 * goes by flux alone, so that no light that reaches the cell is left out.
 */
class LampChoice
{
public:
  explicit LampChoice(const LightTable& lights);

  /// For this cell.
  void weigh(const CellShape& cell);
  /// W that the cell would receive if nothing stood between; roughly.
  double expectedPower() const { return expected_; }

  struct Choice
  {
    std::uint32_t light;
    double probability;
    double rest; ///< in [0, 1): what the choice left of the sample
  };
  /// `sample`: in (0, 1).
  Choice choose(double sample) const;

private:
  /// The part of the samples that goes by flux alone.
  static constexpr double kByFlux = 0.05;

  std::vector<LampShape> lamps_;
  double flux_ = 0;
  double expected_ = 0;
  std::vector<double> weights_;    ///< by light
  std::vector<double> cumulative_; ///< up to and including each light; the last is 1
};

}

#endif
