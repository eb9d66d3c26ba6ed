// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Pipeline/PhotonSource.h"

#include "vtkType.h"

#include <cstdint>

class vtkMultiBlockDataSet;
class vtkPolyData;

namespace irradiance
{

/// Which walks are to be shown.
struct WalksRequest
{
  vtkIdType count;
  int port, connection; ///< of the cell that they are to touch
  vtkIdType cell;       ///< of the connection; -1: all walks are meant

  std::uint64_t hash() const;
};

/// Shows stored walks as polylines. `scene`: the output of vtkIrradianceFilter to which the source
/// belongs. Throws InputError for a cell that is not there. Leaves the output alone if it throws
/// Interrupted.
void writeWalks(const WalksRequest& request, const PhotonSource& source,
  vtkMultiBlockDataSet* scene, Execution& execution, vtkPolyData* output);

}
