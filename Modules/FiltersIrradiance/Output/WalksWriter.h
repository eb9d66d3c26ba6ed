// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_WalksWriter_h
#define irradiance_WalksWriter_h

#include "Input/SceneReader.h"
#include "IrradianceEngine.h"

#include "vtkType.h"

#include <optional>

class vtkPolyData;

namespace irradiance
{

/// Which walks an output is to show: the properties of the filter.
struct WalksRequest
{
  vtkIdType count;      ///< 0: none
  int port, connection; ///< of the cell that they are to touch
  vtkIdType cell;       ///< of the connection; -1: all walks are meant
};

/// Shows stored walks as polylines.
class WalksWriter
{
public:
  /// Finds the input that is meant, before anything is computed. Throws InputError for what is not
  /// there.
  WalksWriter(const WalksRequest& request, const std::vector<InputConnection>& statics,
    const std::vector<InputConnection>& dynamics);

  /// Whether any walk is asked for; then the engine must keep the photons and list what it repairs.
  bool isAsked() const { return request_.count > 0; }
  /// Of what is asked for.
  std::uint64_t hash() const;
  /// The state of engine and scene after the update. `withStale`: also says which walks are stale.
  /// Leaves the output alone if it throws Interrupted.
  void write(const IrradianceEngine& engine, const SceneReader& scene, bool withStale,
    Execution& execution, vtkPolyData* output) const;

private:
  /// A cell of a part, which are numbered over all connections of a port.
  struct PartCell
  {
    std::size_t part, cell;
  };

  void findCell(const std::vector<InputConnection>& connections);
  std::vector<std::uint32_t> choose(
    const IrradianceEngine& engine, const SceneReader& scene, Execution& execution) const;

  WalksRequest request_;
  std::optional<PartCell> cell_; ///< none: it is not there, or all walks are meant
};

}

#endif
