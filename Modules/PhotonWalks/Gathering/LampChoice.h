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
 * stood between them: its flux, the cosines, with slack for the sizes of both, and the distance. Lamps that are
 * near each other, as seen from the cell, have one weight, and share it by flux; so do those that bring least, where
 * lamps are many. A small part goes by flux alone, so that no lamp that reaches the cell is left out.
 */
class LampChoice
{
public:
  /// Weights of a cell at most.
  static constexpr std::size_t kMost = 256;

  /// The lamps must outlive it. `most`: weights of a cell.
  explicit LampChoice(const LampPieces& lamps, std::size_t most = kMost);

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
  /// With which a piece is chosen.
  double probabilityOf(std::uint32_t piece) const;

private:
  /// The part of the samples that goes by flux alone.
  static constexpr double kByFlux = 0.05;
  /// Lamps that are together within this part of their distance have one weight.
  static constexpr double kTogether = 0.125;
  /// A node of the tree that is looked at.
  struct Group
  {
    std::uint32_t node;
    double power;  ///< W that it would bring
    double spread; ///< what may be gained by looking at its halves; 0 if nothing
    friend bool operator<(const Group& a, const Group& b) { return a.spread < b.spread; }
  };
  /// Whether each lamp has a weight of its own.
  bool isFew() const { return tree_.nodes().size() <= 2 * most_; }
  Group groupOf(std::uint32_t node, const CellShape& cell) const;
  /// Groups that have all lamps together.
  void findGroups(const CellShape& cell);

  const LampTree& tree_;
  Box centers_; ///< of the lamps
  std::size_t most_;
  std::vector<Group> groups_;      ///< of the cell
  std::vector<double> cumulative_; ///< weights up to and including each group
};

}

#endif
