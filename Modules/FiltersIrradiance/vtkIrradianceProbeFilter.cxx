// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIrradianceProbeFilter.h"

#include "Output/EmptyPiece.h"
#include "Output/SensorLight.h"
#include "Pipeline/FilterRun.h"
#include "Pipeline/PhotonSource.h"
#include "Pipeline/UpstreamRequest.h"
#include "Progress/InputError.h"
#include "Time/TimeKeys.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <cmath>
#include <string>
#include <vector>

using namespace irradiance;

vtkStandardNewMacro(vtkIrradianceProbeFilter);

namespace
{

/// The active normals of the points, or else the array "Normals"; null if there are none.
vtkDataArray* NormalsOf(vtkDataSet* input)
{
  vtkDataArray* normals = input->GetPointData()->GetNormals();
  return normals ? normals : input->GetPointData()->GetArray("Normals");
}

void FailIf(bool isWrong, vtkIdType point, const char* what, const Vector3& value)
{
  throwIf(isWrong, "the sensors, point ", point, ": the ", what, " (", value[0], ", ", value[1],
    ", ", value[2], ") is ", value.allFinite() ? "of length 0" : "not finite");
}

/// All points. Without normals they receive from all directions. Throws InputError.
std::vector<Sensor> ReadSensors(
  vtkIrradianceProbeFilter* filter, vtkDataSet* input, vtkDataArray* normals)
{
  throwIf(filter->GetEstimate() == vtkIrradianceProbeFilter::Nearest && !normals &&
      input->GetNumberOfPoints() > 0,
    "the sensors have no point normals: with Estimate Nearest a sensor needs the direction from "
    "which it receives light (vtkPolyDataNormals computes normals of surfaces). Estimate "
    "Gathered finds the fluence rate, from all directions, without them");
  const int components = normals ? normals->GetNumberOfComponents() : 3;
  throwIf(components != 3, "the normals of the sensors have ", components,
    " components; three are needed");
  std::vector<Sensor> sensors(static_cast<std::size_t>(input->GetNumberOfPoints()));
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    Sensor& sensor = sensors[static_cast<std::size_t>(i)];
    input->GetPoint(i, sensor.position.data());
    FailIf(!sensor.position.allFinite(), i, "position", sensor.position);
    sensor.normal.setZero();
    if (normals)
    {
      normals->GetTuple(i, sensor.normal.data());
      const double length = sensor.normal.stableNorm();
      FailIf(!(length > 0) || !std::isfinite(length), i, "normal", sensor.normal);
      sensor.normal /= length;
    }
  }
  return sensors;
}

/// No property but 0, which stands for a default, may be other than positive.
void CheckPositive(const char* name, double value)
{
  throwIf(
    !(value >= 0), name, " is ", value, "; it has to be positive, or 0 for what suits the scene");
}

/// The executive would take the time of the sensors, which may not change with time.
void SetDataTime(vtkInformation* info, vtkDataSet* output)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  if (info->Has(Pipeline::TIME_RANGE()) && info->Has(Pipeline::UPDATE_TIME_STEP()))
  {
    output->GetInformation()->Set(
      vtkDataObject::DATA_TIME_STEP(), info->Get(Pipeline::UPDATE_TIME_STEP()));
  }
}

}

class vtkIrradianceProbeFilter::vtkInternals
{
public:
  GroupSensors Stored;
  irradiance::OldNames OldNames;
};

vtkIrradianceProbeFilter::vtkIrradianceProbeFilter()
  : Internals(new vtkInternals)
{
  this->SetNumberOfInputPorts(2);
}

vtkIrradianceProbeFilter::~vtkIrradianceProbeFilter() = default;

void vtkIrradianceProbeFilter::SetSourceConnection(vtkAlgorithmOutput* output)
{
  this->SetInputConnection(1, output);
}

void vtkIrradianceProbeFilter::SetSourceData(vtkDataObject* source)
{
  this->SetInputData(1, source);
}

vtkDataObject* vtkIrradianceProbeFilter::GetSource()
{
  return this->GetNumberOfInputConnections(1) > 0 ? this->GetInputDataObject(1, 0) : nullptr;
}

int vtkIrradianceProbeFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  port == 0 ? info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet")
            : void(setInputTypes(info, "vtkMultiBlockDataSet", "vtkDataObject"));
  return 1;
}

vtkTypeBool vtkIrradianceProbeFilter::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const vtkTypeBool result = this->Superclass::ProcessRequest(request, inputs, outputs);
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_INFORMATION()) != 0)
  {
    uniteTimes(inputs, 2, outputs);
  }
  if (request->Has(vtkStreamingDemandDrivenPipeline::REQUEST_UPDATE_EXTENT()) != 0)
  {
    irradiance::request(
      inputs[1]->GetInformationObject(0), UpstreamRequest::Photons, this->Estimate == Nearest);
    // All sensors belong to piece 0, as the whole scene does.
    requestWhole(inputs[0]->GetInformationObject(0));
  }
  return result;
}

void vtkIrradianceProbeFilter::Compute(vtkDataSet* input, vtkDataObject* scene, vtkDataSet* output)
{
  CheckPositive("MaximumRadius", this->MaximumRadius);
  CheckPositive("MaximumDistance", this->MaximumDistance);
  vtkDataArray* normals = NormalsOf(input);
  const std::vector<Sensor> sensors = ReadSensors(this, input, normals);
  const bool gathers = this->Estimate == Gathered;
  const PhotonSource source(scene, "the source", !gathers);
  SmpExecution execution = executionOf(this);
  output->ShallowCopy(input);
  const std::vector<LightGroup>& groups = source.groups()->all();
  const bool areApart = !groups.empty() && haveGroup(scene, groups.front().name);
  const SensorRun run{ sensors, *source.groups(), execution, output, areApart };
  const int bands = source.bands();
  const std::string warning = gathers
    ? gatherLight(run, addGatheredLight(output, bands, normals != nullptr, haveErrors(scene)),
        static_cast<std::uint32_t>(this->NumberOfRays), this->Internals->Stored)
    : measureNearestLight(run, static_cast<std::uint32_t>(this->NumberOfPhotons),
        this->MaximumRadius, this->MaximumDistance);
  if (!warning.empty())
  {
    vtkWarningMacro(<< warning);
  }
}

int vtkIrradianceProbeFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkDataSet* output = vtkDataSet::GetData(outputs);
  vtkDataSet* input = vtkDataSet::GetData(inputs[0]);
  vtkDataObject* scene = vtkDataObject::GetData(inputs[1], 0);
  vtkInformation* info = outputs->GetInformationObject(0);
  return runFilter(this, output, [&] {
    // What could not be computed has no blocks: that is an error on all processes.
    auto* blocks = vtkMultiBlockDataSet::SafeDownCast(scene);
    const bool isComputed = blocks && blocks->GetNumberOfBlocks() > 0;
    if (!isComputed || !isEmptyPieceRequested(info))
    {
      this->Compute(input, scene, output);
    }
    else
    {
      copyEmptyArrays(input, output);
      const int bands = bandsOf(scene);
      if (this->Estimate == Nearest)
      {
        addNearestLight(output, bands);
      }
      else
      {
        addGatheredLight(output, bands, NormalsOf(input) != nullptr, haveErrors(scene));
      }
    }
    SetDataTime(info, output);
  });
}

void vtkIrradianceProbeFilter::SetKeepRays(bool)
{
  this->Internals->OldNames.warn(this, "KeepRays", "rays are kept where there is memory for them");
}

void vtkIrradianceProbeFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Estimate: " << this->Estimate << "\n"
     << indent << "NumberOfRays: " << this->NumberOfRays << "\n"
     << indent << "NumberOfPhotons: " << this->NumberOfPhotons << "\n"
     << indent << "MaximumRadius: " << this->MaximumRadius << "\n"
     << indent << "MaximumDistance: " << this->MaximumDistance << "\n";
}
