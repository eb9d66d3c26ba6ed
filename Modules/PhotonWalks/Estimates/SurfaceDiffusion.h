// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SurfaceDiffusion_h
#define irradiance_SurfaceDiffusion_h

#include "Estimates/CellDiffusion.h"
#include "Execution/Execution.h"

#include <functional>
#include <utility>
#include <vector>

namespace irradiance
{

/// The width of a CellDiffusion after which small cells draw on `photons` photons, on average, of
/// `received` that arrived on `area`; in the unit of the area. 0 if none arrived. It comes in steps
/// of an eighth, so that a diffusion serves as long as about as many arrive.
double spreadWidth(double photons, double area, double received);

/// How power flows over a surface; nothing flows if no cell is smaller than `width`. `areas`: of
/// its cells.
CellDiffusion surfaceDiffusion(const std::vector<double>& areas,
  const std::vector<Triangle>& triangles, const std::vector<std::uint32_t>& cellOfTriangle,
  int sides, double width, const CancelPoint& cancelPoint = {});

/// Some fields on their way through a diffusion, side by side.
struct DiffusingFields
{
  const CellDiffusion* diffusion;
  std::size_t object;                 ///< whose they are
  std::uint32_t first;                ///< number of the first
  unsigned count;                     ///< that are used
  std::vector<double> quanta, before; ///< see CellDiffusion::step
  int stepsDone = 0;

  unsigned width() const { return count == 1 ? 1 : CellDiffusion::kFields; }
  /// Where the quanta of a node stand, field by field.
  std::size_t placeOf(std::size_t node) const { return diffusion->placeOf(node) * width(); }
};

/// Appends the fields 0 to `count` of an object.
void addFields(const CellDiffusion& diffusion, std::size_t object, std::size_t count,
  std::vector<DiffusingFields>& all);

/// Takes fields through all steps. `begin` fills some that are empty, `end` reads them; many
/// threads call these.
void diffuse(std::vector<DiffusingFields>& all, const std::function<void(DiffusingFields&)>& begin,
  const std::function<void(const DiffusingFields&)>& end, Execution& execution);

/**
 * Measures the effective part of a photon in what a cell holds after a diffusion. Of independent
 * sums S_k with the variances A_k, cell i receives the sum of W_ik S_k. The variance of that, in
 * units of A_i, is the photon's share. It is measured with some fields of random signs, which are
 * the same each time.
 *
 * Of some surfaces, by the areas of their cells: of all nodes, 0..1, known to within a third or so.
 */
std::vector<std::vector<float>> photonShares(
  const std::vector<std::pair<const std::vector<double>*, const CellDiffusion*>>& surfaces,
  int sides, Execution& execution);

}

#endif
