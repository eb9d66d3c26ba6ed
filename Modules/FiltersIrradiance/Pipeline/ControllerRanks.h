// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_ControllerRanks_h
#define irradiance_ControllerRanks_h

#include "Execution/Ranks.h"

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

private:
  void allReduce(std::int64_t* numbers, std::size_t size) override;

  vtkMultiProcessController* controller_;
};

}

#endif
