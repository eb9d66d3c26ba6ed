// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "DirectLight/LampPieces.h"
#include "Surfaces/CellShapes.h"

#include <vector>

namespace irradiance
{

/**
 * Which lamp a sample of a cell asks. The weights follow what each would bring to the cell if
 * nothing stood between them: its flux, the cosines, with slack for the sizes of both, and the
 * distance. Few nodes of the tree of lamps have a weight each, in the order of the tree; below them
 * a sample goes down to lamps that are alike, at each node to the half that would bring more, more
 * often. A small part goes by flux alone, so that no lamp that reaches the cell is left out.
 */
class LampChoice
{
public:
  /// Weights of a cell at most: more of them take longer than they save. Of a point that asks many
  /// samples; it is one of few.
  static constexpr std::size_t kMost = 32, kMostOfPoint = 256;

  /// The lamps must outlive it. `most`: weights.
  explicit LampChoice(const LampPieces& lamps, std::size_t most = kMost);

  /// W that a cell would receive if nothing stood between; roughly.
  double expectedPower(const CellShape& cell);
  /// Not less than that, and sooner known; infinite among the lamps.
  double mostPower(const CellShape& cell) const;
  /// Of what the last cell would receive, W that come from lamps within a distance of its middle,
  /// m, and are no larger.
  double powerFromWithin(double distance) const;
  /// Not more than the distance, m, of the middle of a cell from the middle of any lamp.
  double distance(const CellShape& cell) const;
  /// For this cell.
  void weigh(const CellShape& cell);

  /// A piece, with its probability. `sample`: in (0, 1).
  WeightChoice choose(double sample) const;
  /// With which a piece is chosen.
  double probabilityOf(std::uint32_t piece) const;

private:
  /// The part of the samples that goes by flux alone; and likewise at each node below.
  static constexpr double kByFlux = 0.05, kByFluxBelow = 0.005;
  /// Lamps that are together within this part of their distance have one weight, if the cosine of
  /// their cone is no less.
  static constexpr double kTogether = 0.125, kAlike = 0.9;
  /// A node of the tree that is looked at.
  struct Group
  {
    std::uint32_t node;
    double power;  ///< W that it would bring
    double spread; ///< what may be gained by looking at its halves; 0 if nothing
    friend bool operator<(const Group& a, const Group& b) { return a.spread < b.spread; }
  };
  Group groupOf(std::uint32_t node) const;
  /// With groups that have all lamps together.
  void setCell(const CellShape& cell);
  /// Whether what is below a node brings about as much to the cell for its flux.
  bool isAlike(const LampPieces::Node& node) const;
  /// The probability of the first half of a node.
  double probabilityOfFirst(const LampPieces::Node& node) const;

  const LampPieces& lamps_;
  std::size_t most_;
  CellShape cell_;
  double curved_ = 0;              ///< the part of the cell that has normals in all directions
  std::vector<Group> groups_;      ///< of the cell
  std::vector<double> cumulative_; ///< weights up to and including each group
};

}
