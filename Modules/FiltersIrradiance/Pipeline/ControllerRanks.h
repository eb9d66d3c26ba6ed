// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Execution/Ranks.h"

#include "vtkSmartPointer.h"

#include <vector>

class vtkDataObject;
class vtkMultiProcessController;

namespace irradiance
{

/// The processes of a controller.
class ControllerRanks : public Ranks
{
public:
  /// Null: this process alone. The controller must outlive it.
  explicit ControllerRanks(vtkMultiProcessController* controller)
    : controller_(controller)
  {
  }

  std::uint32_t rank() const override;
  std::uint32_t count() const override;

  /// What each rank has, in the order of ranks, on all of them; ranks that have nothing (null) are
  /// left out. Data sets, or trees of them: structure, names, geometry and arrays, bit for bit, but
  /// no information keys. All ranks call it. Throws RankFailed, and InputError if VTK cannot write
  /// or read it.
  std::vector<vtkSmartPointer<vtkDataObject>> dataOfAll(vtkDataObject* own);

private:
  void allReduce(std::int64_t* numbers, std::size_t size) override;

  vtkMultiProcessController* controller_;
};

}
