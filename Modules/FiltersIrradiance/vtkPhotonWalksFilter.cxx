// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPhotonWalksFilter.h"

#include "Output/WalksWriter.h"
#include "Pipeline/FilterRun.h"
#include "Pipeline/PhotonSource.h"
#include "Pipeline/UpstreamRequest.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkPhotonWalksFilter);

int vtkPhotonWalksFilter::FillInputPortInformation(int, vtkInformation* info)
{
  irradiance::setInputTypes(info, "vtkMultiBlockDataSet", "vtkDataObject");
  return 1;
}

int vtkPhotonWalksFilter::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  irradiance::request(inputs[0]->GetInformationObject(0), irradiance::UpstreamRequest::Walks);
  return 1;
}

int vtkPhotonWalksFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* output = vtkPolyData::GetData(outputs);
  vtkMultiBlockDataSet* input = vtkMultiBlockDataSet::GetData(inputs[0]);
  return irradiance::runFilter(this, output, [&] {
    if (!irradiance::isEmptyPieceRequested(outputs->GetInformationObject(0))) // each walk once
    {
      const irradiance::PhotonSource source(input, "the input", true);
      irradiance::SmpExecution execution = irradiance::executionOf(this);
      irradiance::writeWalks(
        { this->NumberOfWalks, this->CellPort, this->CellConnection, this->Cell }, source, input,
        execution, output);
    }
  });
}

void vtkPhotonWalksFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfWalks: " << this->NumberOfWalks << "\n"
     << indent << "Cell: " << this->Cell << "\n"
     << indent << "CellPort: " << this->CellPort << "\n"
     << indent << "CellConnection: " << this->CellConnection << "\n";
}
