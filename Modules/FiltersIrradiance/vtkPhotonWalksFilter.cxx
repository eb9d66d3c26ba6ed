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

using namespace irradiance;

vtkStandardNewMacro(vtkPhotonWalksFilter);

int vtkPhotonWalksFilter::FillInputPortInformation(int, vtkInformation* info)
{
  return setInputTypes(info, "vtkMultiBlockDataSet", "vtkDataObject");
}

int vtkPhotonWalksFilter::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  request(inputs[0]->GetInformationObject(0), UpstreamRequest::Walks);
  return 1;
}

int vtkPhotonWalksFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* output = vtkPolyData::GetData(outputs);
  vtkMultiBlockDataSet* input = vtkMultiBlockDataSet::GetData(inputs[0]);
  return runFilter(this, output, [&] {
    if (!isEmptyPieceRequested(outputs->GetInformationObject(0))) // each walk once
    {
      const PhotonSource source(input, "the input", true);
      SmpExecution execution = executionOf(this);
      writeWalks({ this->NumberOfWalks, this->CellPort, this->CellConnection, this->Cell }, source,
        input, execution, output);
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
