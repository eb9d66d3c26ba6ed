// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_ExposureSpread_h
#define irradiance_ExposureSpread_h

#include "Execution/Execution.h"
#include "Exposure/ReplicateSums.h"
#include "Geometry/Triangle.h"

#include <cstdint>
#include <vector>

namespace irradiance
{

/// The cells of a body.
struct ExposedSurface
{
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> cellOfTriangle;
  std::size_t numberOfCells = 0;
};

/// The exposure of a body's cells, or of one side of them: each with all bands, cell by cell.
struct ExposedSide
{
  std::vector<double>* exposure; ///< J/m2
  ReplicateSums* replicates;     ///< two or more
};

/**
 * Spreads exposure over neighbouring cells, see CellDiffusion, so that a small cell draws on about
 * `photons` photons, on the average of the body. `sides`: both together, or front and back. Energy
 * is conserved, in each band and side, to within rounding. The result is a function of the sums
 * alone.
 *
 * A body received N = E^2 / V photons, for its energy E, J, and the sum V of its cells' variances:
 * n independent ones of equal energy give n, and what the same walk brings at several times counts
 * once. See Documentation/Theory.md, 5.5.
 */
void spreadExposure(const ExposedSurface& surface, int bands, const std::vector<ExposedSide>& sides,
  double photons, Execution& execution);

}

#endif
