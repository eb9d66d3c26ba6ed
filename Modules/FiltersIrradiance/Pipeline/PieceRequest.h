// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PieceRequest_h
#define irradiance_PieceRequest_h

#include "Execution/Ranks.h"

class vtkInformation;

namespace irradiance
{

/**
 * When n processes share a pipeline, each asks for its piece of n. Light needs the whole scene, so
 * the filters give all of the result as piece 0. Other pieces have the same blocks and arrays
 * without cells: together the pieces have every cell once.
 */
bool isEmptyPieceRequested(vtkInformation* output);

/// Asks for all of an input, whatever piece the output is of.
void requestWhole(vtkInformation* input);
/// Asks for this rank's piece of an input.
void requestPiece(vtkInformation* input, const Ranks& ranks);

}

#endif
