// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_CellDiffusion_h
#define irradiance_CellDiffusion_h

#include "Tally/CellNeighbours.h"

#include <cstdint>
#include <vector>

namespace irradiance
{

/**
 * Lets power diffuse between the cells of an object, step by step, in whole quanta. Across an edge of
 * cells i and j flow
 *
 *   w (S_i / A_i - S_j / A_j) quanta, rounded towards 0,
 *
 * in each step, where S are the quanta before the step and A the areas. What one cell loses the
 * other gains. The w at a cell sum up to 3/4 A at most, so no sum becomes negative. Front and back
 * are nodes of their own if sides are kept apart: node = cell * sides + side.
 *
 * The estimate of a cell of an area below `width` then draws on the photons of about an area of
 * `width`; larger cells exchange power with smaller ones alone.
 */
class CellDiffusion
{
public:
  CellDiffusion() = default;
  /// `areas`: of cells, in the unit of `width`. `sides`: 1 or 2.
  CellDiffusion(const std::vector<double>& areas, const std::vector<CellNeighbours>& neighbours,
    int sides, double width);

  /// 0 if no power flows.
  int steps() const { return steps_; }
  /// Takes the quanta of the nodes one step further.
  void step(std::vector<std::int64_t>& quanta) const;

private:
  /// Two nodes, and the shares of their quanta that flow to the other in a step.
  struct Link
  {
    std::uint32_t a, b;
    double shareOfA, shareOfB;
  };

  std::vector<Link> links_;
  int steps_ = 0;
};

}

#endif
