// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/UpstreamRequest.h"

#include "vtkInformation.h"
#include "vtkInformationIntegerRequestKey.h"
#include "vtkInformationIntegerVectorKey.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <array>
#include <cstddef>

namespace irradiance
{

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

/// VTK's key manager owns it: it lives as long as the program.
class Key : public vtkInformationIntegerRequestKey
{
public:
  /// `given`: the name of a key on data objects, which says for which request they were made.
  Key(const char* name, const char* given)
    : vtkInformationIntegerRequestKey(name, kLocation)
  {
    this->DataKey = new vtkInformationIntegerKey(given, kLocation);
  }

private:
  static constexpr const char* kLocation = "vtkIrradianceFilter";
};

Key* keyOf(UpstreamRequest what)
{
  static const std::array<Key*, 4> keys{ new Key("PHOTONS_NEEDED", "PHOTONS_KEPT"),
    new Key("WALKS_NEEDED", "WALKS_KEPT"), new Key("REPLICATES_NEEDED", "REPLICATES_WRITTEN"),
    new Key("ALONE_NEEDED", "ALONE_COMPUTED") };
  return keys[static_cast<std::size_t>(what)];
}

}

void request(vtkInformation* input, UpstreamRequest what, bool isNeeded)
{
  // The key stays, with a 0: an absent one would not tell data with it from data without. Where
  // nobody ever asked there is none, and nothing executes again.
  if (isNeeded || input->Has(keyOf(what)) != 0)
  {
    input->Set(keyOf(what), isNeeded ? 1 : 0);
  }
}

bool isRequested(vtkInformation* output, UpstreamRequest what)
{
  return output->Has(keyOf(what)) != 0 && output->Get(keyOf(what)) == 1;
}

bool isEmptyPieceRequested(vtkInformation* output)
{
  auto* piece = Pipeline::UPDATE_PIECE_NUMBER();
  return output->Has(piece) != 0 && output->Get(piece) > 0;
}

void requestWhole(vtkInformation* input)
{
  input->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
  input->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
  input->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  if (auto* const whole = Pipeline::WHOLE_EXTENT(); input->Has(whole))
  {
    input->Set(Pipeline::UPDATE_EXTENT(), input->Get(whole), whole->Length(input));
  }
}

void requestPiece(vtkInformation* input, const Ranks& ranks)
{
  requestWhole(input);
  input->Set(Pipeline::UPDATE_PIECE_NUMBER(), static_cast<int>(ranks.rank()));
  input->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), static_cast<int>(ranks.count()));
}

}
