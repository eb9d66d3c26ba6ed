// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Room.h"

class vtkDataArray;
class vtkMultiBlockDataSet;

namespace interactiveroom
{

/** How well the irradiance of a scene is known, from the arrays of vtkIrradianceFilter. */
class MeanError
{
public:
  explicit MeanError(const Room& room);

  /**
   * The mean standard error over the mean irradiance, both by area, where the error is known; NaN
   * where it is known nowhere.
   */
  double Of(vtkMultiBlockDataSet* scene) const;

  /** The irradiance, W/m2, below which a share (0 to 1) of the area lies that shines not itself. */
  double Quantile(vtkMultiBlockDataSet* scene, double share) const;

private:
  std::vector<vtkSmartPointer<vtkDataArray>> Areas; // m2 of each cell, mesh by mesh
  std::vector<bool> IsLamp;
};

}
