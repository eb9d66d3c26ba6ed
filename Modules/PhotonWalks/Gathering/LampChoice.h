// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_LampChoice_h
#define irradiance_LampChoice_h

#include "Gathering/LampPieces.h"
#include "Surfaces/CellShapes.h"

#include <vector>

namespace irradiance
{

/**
 * Which lamp a sample of a cell asks. The weights follow what each would bring to the cell if nothing
 * stood between them: its flux, the cosines, with slack for the sizes of both, and the distance. A small part
 * goes by flux alone, so that no lamp that reaches the cell is left out.
 */
class LampChoice
{
public:
  /// The argument must outlive it.
  explicit LampChoice(const LampPieces& lamps);

  /// W that a cell would receive if nothing stood between; roughly.
  double expectedPower(const CellShape& cell);
  /// Not less than that, and sooner known; infinite among the lamps.
  double mostPower(const CellShape& cell) const;
  /// For this cell.
  void weigh(const CellShape& cell);

  struct Choice
  {
    std::uint32_t piece;
    double probability;
    double rest; ///< in [0, 1): what the choice left of the sample
  };
  /// `sample`: in (0, 1).
  Choice choose(double sample) const;

private:
  /// The part of the samples that goes by flux alone.
  static constexpr double kByFlux = 0.05;

  const LampPieces& lamps_;
  Box centers_;                    ///< of the pieces
  std::vector<double> weights_;    ///< by piece
  std::vector<double> cumulative_; ///< up to and including each piece
};

}

#endif
