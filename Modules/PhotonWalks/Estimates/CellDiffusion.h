// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Estimates/CellNeighbours.h"

#include <cstdint>
#include <vector>

namespace irradiance
{

/**
 * Lets power diffuse between the cells of an object, step by step, in whole quanta. Across an edge
 * of cells i and j flow
 *
 *   w (S_i / A_i - S_j / A_j) quanta, rounded towards 0,
 *
 * in a step, where S are the quanta before the step and A the areas. What one cell loses the
 * other gains. The w at a cell sum up to 3/4 A at most, so no sum becomes negative. Front and back
 * are nodes of their own if sides are kept apart: node = cell * sides + side.
 *
 * The estimate of a cell of an area below `width` then draws on the photons of about an area of
 * `width`; larger cells exchange power with smaller ones alone. An edge that needs few steps takes
 * part in every second, fourth, ... one, with a w as many times as large.
 *
 * Fields are independent sums at the same nodes. Several go side by side, as SIMD.
 */
class CellDiffusion
{
public:
  /// How many fields go side by side.
  static constexpr unsigned kFields = 8;
  /// Two nodes, by their places, and the shares of their quanta that flow to the other in a step.
  struct Link
  {
    std::uint32_t a, b;
    double shareOfA, shareOfB;
  };

  CellDiffusion() = default;
  /// `areas`: of cells, in the unit of `width`. `sides`: 1 or 2.
  CellDiffusion(const std::vector<double>& areas, const std::vector<CellNeighbours>& neighbours,
    int sides, double width);

  /// 0 if no power flows.
  int steps() const { return steps_; }
  /// Where the quanta of a node stand. Nodes that take part in all steps come first.
  std::size_t placeOf(std::size_t node) const { return places_.empty() ? node : places_[node]; }
  /// Takes step `number`, from 0 on, of `fields` fields, 1 or kFields. `quanta`: whole numbers, of
  /// field k at place * fields + k; in a field, they sum up to less than 2^53, so that all are
  /// exact. `before`: room for the same.
  void step(
    int number, unsigned fields, std::vector<double>& quanta, std::vector<double>& before) const;

private:
  struct Flow;
  static std::vector<Flow> flowsBetween(
    const std::vector<double>& areas, const std::vector<CellNeighbours>& neighbours, double width);
  void place(std::vector<Link> links, const std::vector<int>& periods, std::size_t nodes);

  int steps_ = 0;
  std::vector<std::uint32_t> places_; ///< of the nodes; empty if all keep their numbers
  std::vector<Link> links_;           ///< links of short periods first
  /// Of those that take part in every 2^i-th step: what comes before the end.
  std::vector<std::size_t> linkEnds_, placeEnds_;
};

/// Lets quanta flow across links, see CellDiffusion::step; the same bits as without AVX2.
void flowAvx2(const CellDiffusion::Link* links, std::size_t count, unsigned fields,
  const double* before, double* quanta);

}
