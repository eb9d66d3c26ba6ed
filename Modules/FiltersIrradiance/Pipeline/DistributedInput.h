// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Input/InputConnection.h"
#include "Pipeline/ControllerRanks.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <vector>

namespace irradiance
{

/// Puts the pieces that the processes hold of each part of the scene together, on each process. The
/// cells of the whole are ordered by their global ids, if they have some, and else by their places,
/// so that the order does not depend on who held what. What all processes have alike is whole
/// already, and counts once. Only a part of which a piece has changed is put together again.
class DistributedInput
{
public:
  /// Replaces the pieces of all parts by wholes, and takes the pose of each part from the first
  /// process that has cells of it. All processes call it together. Throws InputError if pieces do
  /// not fit together, and RankFailed.
  void complete(vtkAlgorithm* filter, ControllerRanks& ranks, SceneInputs& inputs);

private:
  struct Whole
  {
    vtkSmartPointer<vtkPolyData> piece; ///< held so that its address is not used again
    vtkMTimeType time = 0;              ///< when the piece was modified
    vtkSmartPointer<vtkPolyData> polyData;
    PieceCells cells; ///< of the piece
  };

  std::vector<Whole> wholes_; ///< of all parts, static ones first
};

}
