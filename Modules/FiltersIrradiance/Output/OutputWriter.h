// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_OutputWriter_h
#define irradiance_OutputWriter_h

#include "Input/SceneReader.h"
#include "IrradianceEngine.h"

class vtkMultiBlockDataSet;

namespace irradiance
{

/// Copies the engine's sums to the output of the filter. `withErrors`: also writes standard errors.
/// `withReplicates`: also writes replicatesName() and photonName().
void writeOutput(const IrradianceEngine& engine, const SceneReader& scene,
  const SceneInputs& inputs, bool withErrors, bool withReplicates, const CancelPoint& cancelPoint,
  vtkMultiBlockDataSet* output);

/// The same blocks and arrays without cells and field data, see isEmptyPieceRequested().
void writeEmptyOutput(const SceneInputs& inputs, const EngineSettings& settings, bool withErrors,
  vtkMultiBlockDataSet* output);

}

#endif
