// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_DiffusionShares_h
#define irradiance_DiffusionShares_h

#include "Estimates/DiffusingFields.h"

namespace irradiance
{

/**
 * Measures the effective part of a photon in what a cell holds after a diffusion. Of independent
 * sums S_k with the variances A_k, cell i receives the sum of W_ik S_k. The variance of that, in
 * units of A_i, is the photon's share. It is measured with some fields of random signs, which are
 * the same each time.
 */
class DiffusionShares
{
public:
  static constexpr std::uint32_t kFields = 16;

  DiffusionShares() = default;
  /// `areas`: of the cells.
  DiffusionShares(const std::vector<double>& areas, int sides);

  /// Gives each node a random sign in some of the fields.
  void fill(const CellDiffusion& diffusion, DiffusingFields& fields) const;
  /// Adds what the diffusion made of them; in any order, one at a time.
  void add(const CellDiffusion& diffusion, const DiffusingFields& fields);
  /// Of all nodes, 0..1, when all fields are added; known to within a third or so.
  std::vector<float> shares() const;

private:
  /// The standard deviation of each node, in quanta.
  std::vector<std::int64_t> sizes_, squares_;
};

}

#endif
