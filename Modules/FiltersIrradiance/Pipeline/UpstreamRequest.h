// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Execution/Ranks.h"

#include "vtkInformation.h"
#include "vtkInformationIntegerRequestKey.h"
#include "vtkInformationIntegerVectorKey.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <array>
#include <cstddef>

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

/// VTK's key manager owns it: it lives as long as the program.
class UpstreamKey : public vtkInformationIntegerRequestKey
{
public:
  /// `given`: the name of a key on data objects, which says for which request they were made.
  UpstreamKey(const char* name, const char* given)
    : vtkInformationIntegerRequestKey(name, kLocation)
  {
    this->DataKey = new vtkInformationIntegerKey(given, kLocation);
  }

private:
  static constexpr const char* kLocation = "vtkIrradianceFilter";
};

inline UpstreamKey* keyOf(UpstreamRequest what)
{
  static const std::array<UpstreamKey*, 4> keys{ new UpstreamKey("PHOTONS_NEEDED", "PHOTONS_KEPT"),
    new UpstreamKey("WALKS_NEEDED", "WALKS_KEPT"),
    new UpstreamKey("REPLICATES_NEEDED", "REPLICATES_WRITTEN"),
    new UpstreamKey("ALONE_NEEDED", "ALONE_COMPUTED") };
  return keys[static_cast<std::size_t>(what)];
}

/// Asks an input for it, or no longer.
inline void request(vtkInformation* input, UpstreamRequest what, bool isNeeded = true)
{
  // The key stays, with a 0: an absent one would not tell data with it from data without. Where
  // nobody ever asked there is none, and nothing executes again.
  if (isNeeded || input->Has(keyOf(what)) != 0)
  {
    input->Set(keyOf(what), isNeeded ? 1 : 0);
  }
}

/// Whether somebody has asked an output for it.
inline bool isRequested(vtkInformation* output, UpstreamRequest what)
{
  return output->Has(keyOf(what)) != 0 && output->Get(keyOf(what)) == 1;
}

/// When n processes share a pipeline, each asks for its piece of n. Light needs the whole scene, so
/// the filters give all of the result as piece 0. Other pieces have the same blocks and arrays
/// without cells: together the pieces have every cell once.
inline bool isEmptyPieceRequested(vtkInformation* output)
{
  auto* piece = vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER();
  return output->Has(piece) != 0 && output->Get(piece) > 0;
}

/// Asks for all of an input, whatever piece the output is of.
inline void requestWhole(vtkInformation* input)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  input->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
  input->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
  input->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  if (auto* const whole = Pipeline::WHOLE_EXTENT(); input->Has(whole))
  {
    input->Set(Pipeline::UPDATE_EXTENT(), input->Get(whole), whole->Length(input));
  }
}

/// Asks for this rank's piece of an input.
inline void requestPiece(vtkInformation* input, const Ranks& ranks)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  requestWhole(input);
  input->Set(Pipeline::UPDATE_PIECE_NUMBER(), static_cast<int>(ranks.rank()));
  input->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), static_cast<int>(ranks.count()));
}

}
