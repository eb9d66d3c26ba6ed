// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_WalksWriter_h
#define irradiance_WalksWriter_h

#include "Pipeline/PhotonSource.h"

#include "vtkType.h"

#include <cstdint>
#include <optional>

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

/// Shows stored walks as polylines.
class WalksWriter
{
public:
  /// `scene`: the output of vtkIrradianceFilter to which the source belongs. Throws InputError for
  /// a cell that is not there. The source must outlive it.
  WalksWriter(const WalksRequest& request, const PhotonSource& source, vtkMultiBlockDataSet* scene);

  /// Leaves the output alone if it throws Interrupted.
  void write(Execution& execution, vtkPolyData* output) const;

private:
  void findCell(const PhotonSource& source, vtkMultiBlockDataSet* scene);
  std::vector<std::uint32_t> choose(Execution& execution) const;

  WalksRequest request_;
  const IrradianceEngine& engine_;
  std::optional<SceneCell> cell_; ///< none: it is not there, or all walks are meant
};

}

#endif
