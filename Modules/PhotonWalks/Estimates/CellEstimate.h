// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_CellEstimate_h
#define irradiance_CellEstimate_h

namespace irradiance
{

/// From which photons the irradiance of a cell is estimated.
enum class CellEstimate
{
  Sums,   ///< those that arrived in it
  Spread, ///< small cells: also those of the cells around it, see CellSpread
  Nearest ///< small cells: those nearest to their middles, see NearestCells
};

}

#endif
