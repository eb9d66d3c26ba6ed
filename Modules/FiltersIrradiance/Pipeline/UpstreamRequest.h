// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_UpstreamRequest_h
#define irradiance_UpstreamRequest_h

#include "Execution/Ranks.h"

class vtkInformation;

namespace irradiance
{

/// What a filter downstream may need beyond the usual. The request travels up the pipeline to
/// vtkIrradianceFilter; if that has not computed it, it executes again.
enum class UpstreamRequest
{
  Photons,    ///< stored walks, from which photons are read
  Walks,      ///< likewise, and which of them a repair shot again
  Replicates, ///< the arrays replicatesName() and photonName()
  Alone       ///< this process computes alone: other work is shared over processes
};

/// Asks an input for it, or no longer.
void request(vtkInformation* input, UpstreamRequest what, bool isNeeded = true);

/// Whether somebody has asked an output for it.
bool isRequested(vtkInformation* output, UpstreamRequest what);

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
