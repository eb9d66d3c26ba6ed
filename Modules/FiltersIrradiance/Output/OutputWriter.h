// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Input/SceneReader.h"
#include "LightGroups.h"

class vtkMultiBlockDataSet;

namespace irradiance
{

/// Which arrays are written beside the irradiance.
struct OutputArrays
{
  bool errors = false;     ///< standard errors
  bool replicates = false; ///< replicatesName() and photonName()
  bool groups = false;     ///< the light of each group alone
};

/// Copies the light of all groups to the output of the filter.
void writeOutput(const LightGroups& groups, const SceneReader& scene, const SceneInputs& inputs,
  const OutputArrays& arrays, const CancelPoint& cancelPoint, vtkMultiBlockDataSet* output);

/// The same blocks and arrays without cells and field data, see isEmptyPieceRequested().
void writeEmptyOutput(const SceneInputs& inputs, const EngineSettings& settings, bool withErrors,
  vtkMultiBlockDataSet* output);

}
