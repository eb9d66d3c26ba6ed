// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/PieceRequest.h"

#include "vtkInformation.h"
#include "vtkInformationIntegerVectorKey.h"
#include "vtkStreamingDemandDrivenPipeline.h"

namespace irradiance
{

bool isEmptyPieceRequested(vtkInformation* output)
{
  auto* piece = vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER();
  return output->Has(piece) != 0 && output->Get(piece) > 0;
}

void requestWhole(vtkInformation* input)
{
  input->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), 0);
  input->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), 1);
  input->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  if (auto* const whole = vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(); input->Has(whole))
  {
    input->Set(
      vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), input->Get(whole), whole->Length(input));
  }
}

void requestPiece(vtkInformation* input, const Ranks& ranks)
{
  requestWhole(input);
  input->Set(
    vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), static_cast<int>(ranks.rank()));
  input->Set(
    vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), static_cast<int>(ranks.count()));
}

}
