// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIrradianceProbeFilter.h"

#include "Data/ArrayNames.h"
#include "Data/NamedArray.h"
#include "Execution/SlicedPass.h"
#include "Output/EmptyPiece.h"
#include "Photons/NearestEstimate.h"
#include "Pipeline/FilterRun.h"
#include "Pipeline/PhotonRequest.h"
#include "Pipeline/PhotonSource.h"
#include "Pipeline/PieceRequest.h"
#include "Progress/InputError.h"
#include "Time/TimeKeys.h"
#include "Views/SensorDirectLight.h"

#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkIrradianceProbeFilter);

namespace
{

[[noreturn]] void Fail(vtkIdType point, const char* what, const irradiance::Vector3& value)
{
  std::ostringstream message;
  message << "the sensors, point " << point << ": the " << what << " (" << value[0] << ", "
          << value[1] << ", " << value[2] << ") is ";
  message << (value.allFinite() ? "of length 0" : "not finite");
  throw irradiance::InputError(message.str());
}

std::vector<irradiance::Sensor> ReadSensors(vtkPointSet* input)
{
  vtkDataArray* normals = input->GetPointData()->GetNormals();
  normals = normals ? normals : input->GetPointData()->GetArray("Normals");
  const vtkIdType count = input->GetNumberOfPoints();
  if (count > 0 &&
    (!normals || normals->GetNumberOfComponents() != 3 || normals->GetNumberOfTuples() != count))
  {
    throw irradiance::InputError(
      "the sensors have no point normals of three components: a sensor needs the direction from "
      "which it receives light (vtkPolyDataNormals computes normals of surfaces)");
  }
  std::vector<irradiance::Sensor> sensors(static_cast<std::size_t>(count));
  for (vtkIdType i = 0; i < count; ++i)
  {
    irradiance::Sensor& sensor = sensors[static_cast<std::size_t>(i)];
    input->GetPoint(i, sensor.position.data());
    normals->GetTuple(i, sensor.normal.data());
    if (!sensor.position.allFinite())
    {
      Fail(i, "position", sensor.position);
    }
    const double length = sensor.normal.stableNorm();
    if (!(length > 0) || !std::isfinite(length))
    {
      Fail(i, "normal", sensor.normal);
    }
    sensor.normal /= length;
  }
  return sensors;
}

/// What is known at the sensors, in point arrays of the output.
class SensorArrays
{
public:
  SensorArrays(vtkPointSet* output, int bands)
    : Irradiances(Add<vtkDoubleArray>(output, irradiance::irradianceName(), bands))
    , Counts(Add<vtkIdTypeArray>(output, irradiance::kNumberOfPhotons, 1))
    , Radii(Add<vtkDoubleArray>(output, irradiance::kSearchRadius, 1))
  {
  }

  /// `direct`: W/m2 beside that of the photons.
  void Set(vtkIdType point, const irradiance::NearestEstimate& estimate,
    const irradiance::PointDirectLight::Bands& direct, const irradiance::IrradianceEngine& engine)
  {
    for (int band = 0; band < this->Irradiances->GetNumberOfComponents(); ++band)
    {
      this->Irradiances->SetTypedComponent(point, band,
        estimate.area > 0 ? direct[static_cast<std::size_t>(band)] +
            engine.watts(estimate.power[band]) / estimate.area
                          : std::numeric_limits<double>::quiet_NaN());
    }
    this->Counts->SetTypedComponent(point, 0, static_cast<vtkIdType>(estimate.found));
    this->Radii->SetTypedComponent(point, 0, estimate.radius);
  }

private:
  template <class Array>
  static vtkSmartPointer<Array> Add(vtkPointSet* output, const std::string& name, int components)
  {
    return irradiance::addArray<Array>(
      output->GetPointData(), name, components, output->GetNumberOfPoints());
  }

  vtkSmartPointer<vtkDoubleArray> Irradiances;
  vtkSmartPointer<vtkIdTypeArray> Counts;
  vtkSmartPointer<vtkDoubleArray> Radii;
};

/// No property but 0, which stands for a default, may be other than positive.
void CheckPositive(const char* name, double value)
{
  if (!(value >= 0))
  {
    throw irradiance::InputError(std::string(name) + " is " + irradiance::text(value) +
      "; it has to be positive, or 0 for what suits the scene");
  }
}

/// Says which sensors are off all surface.
std::string TextOfLost(
  const std::vector<irradiance::Sensor>& sensors, const std::vector<char>& areLost, double distance)
{
  const auto first = static_cast<std::size_t>(
    std::find(areLost.begin(), areLost.end(), char{ 1 }) - areLost.begin());
  const irradiance::Vector3& position = sensors[first].position;
  std::ostringstream message;
  message
    << std::count(areLost.begin(), areLost.end(), char{ 1 }) << " of " << sensors.size()
    << " sensors lie farther than " << distance
    << " m from a surface that faces as they do: the first is point " << first << " at ("
    << position[0] << ", " << position[1] << ", " << position[2]
    << "). Their Irradiance is NaN, as sensors in the air cannot be measured. MaximumDistance "
       "says how far from a surface sensors may lie";
  return message.str();
}

/// Without points, see PieceRequest.h.
void WriteEmpty(vtkPointSet* input, vtkDataObject* scene, vtkPointSet* output)
{
  irradiance::copyEmptyArrays(input, output);
  SensorArrays(output, irradiance::bandsOf(scene));
  output->GetPointData()->SetActiveScalars(irradiance::irradianceName().c_str());
}

/// The executive would take the time of the sensors, which may not change with time.
void SetDataTime(vtkInformation* info, vtkPointSet* output)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  if (info->Has(Pipeline::TIME_RANGE()) && info->Has(Pipeline::UPDATE_TIME_STEP()))
  {
    output->GetInformation()->Set(
      vtkDataObject::DATA_TIME_STEP(), info->Get(Pipeline::UPDATE_TIME_STEP()));
  }
}

}

vtkIrradianceProbeFilter::vtkIrradianceProbeFilter()
{
  this->SetNumberOfInputPorts(2);
}

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
  // What follows the first type is refused by this filter itself, in words that help.
  auto* const key = vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE();
  info->Set(key, port == 0 ? "vtkPointSet" : "vtkMultiBlockDataSet");
  info->Append(key, port == 0 ? "vtkDataSet" : "vtkDataObject");
  return 1;
}

int vtkIrradianceProbeFilter::RequestDataObject(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (vtkPointSet::GetData(inputs[0]))
  {
    return this->Superclass::RequestDataObject(request, inputs, outputs);
  }
  vtkNew<vtkPolyData> output; // it stays empty, see RequestData()
  outputs->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), output);
  return 1;
}

vtkTypeBool vtkIrradianceProbeFilter::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const vtkTypeBool result = this->Superclass::ProcessRequest(request, inputs, outputs);
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_INFORMATION()) != 0)
  {
    irradiance::TimeKeys(inputs, 2).write(outputs);
  }
  if (request->Has(vtkStreamingDemandDrivenPipeline::REQUEST_UPDATE_EXTENT()) != 0)
  {
    irradiance::requestPhotons(inputs[1]->GetInformationObject(0));
    // All sensors belong to piece 0, as the whole scene does.
    irradiance::requestWhole(inputs[0]->GetInformationObject(0));
  }
  return result;
}

void vtkIrradianceProbeFilter::Compute(
  vtkPointSet* input, vtkDataObject* scene, vtkPointSet* output)
{
  if (!input)
  {
    throw irradiance::InputError(std::string("the sensors are a ") +
      this->GetInputDataObject(0, 0)->GetClassName() +
      "; vtkPolyData or another vtkPointSet is needed, with point normals (vtkGeometryFilter, in "
      "ParaView Extract Surface, and then vtkPolyDataNormals make them)");
  }
  CheckPositive("MaximumRadius", this->MaximumRadius);
  CheckPositive("MaximumDistance", this->MaximumDistance);
  const std::vector<irradiance::Sensor> sensors = ReadSensors(input);
  const irradiance::PhotonSource source(scene, "the source");
  irradiance::IrradianceEngine& engine = *source.engine();
  irradiance::SmpExecution execution = irradiance::executionOf(this);
  engine.collect<irradiance::LeafPhotons>(execution);
  engine.prepareSurfaces(execution);
  const irradiance::NearestPhotons nearest = engine.nearestPhotons();
  const auto count = static_cast<std::uint32_t>(this->NumberOfPhotons);
  const double maximumDistance =
    this->MaximumDistance > 0 ? this->MaximumDistance : irradiance::usualDistance(nearest);
  const double maximumRadius =
    this->MaximumRadius > 0 ? this->MaximumRadius : irradiance::usualRadius(nearest, count);
  output->ShallowCopy(input);
  SensorArrays arrays(output, engine.objects().staticObject.material->bands);
  const irradiance::SensorDirectLight directLight(engine);
  std::vector<char> areLost(sensors.size());
  constexpr std::size_t unitSize = 64;
  irradiance::SlicedPass pass{ (sensors.size() + unitSize - 1) / unitSize, {} };
  pass.work = [&](std::size_t unit, const irradiance::Deadline&) {
    for (std::size_t i = unit * unitSize; i < std::min((unit + 1) * unitSize, sensors.size()); ++i)
    {
      const std::optional<irradiance::Foot> foot = nearest.footOf(sensors[i], maximumDistance);
      const irradiance::NearestEstimate estimate = foot
        ? irradiance::nearestEstimate(nearest, *foot, count, maximumRadius)
        : irradiance::NearestEstimate{ {}, 0, std::numeric_limits<double>::quiet_NaN(), 0 };
      areLost[i] = foot ? 0 : 1;
      const auto direct =
        foot ? directLight.irradiance(*foot, i) : irradiance::PointDirectLight::Bands{};
      arrays.Set(static_cast<vtkIdType>(i), estimate, direct, engine);
    }
    return true;
  };
  pass.run(execution);
  output->GetPointData()->SetActiveScalars(irradiance::irradianceName().c_str());
  if (std::find(areLost.begin(), areLost.end(), char{ 1 }) != areLost.end())
  {
    vtkWarningMacro(<< TextOfLost(sensors, areLost, maximumDistance));
  }
}

int vtkIrradianceProbeFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPointSet* output = vtkPointSet::GetData(outputs);
  vtkPointSet* input = vtkPointSet::GetData(inputs[0]);
  vtkDataObject* scene = vtkDataObject::GetData(inputs[1], 0);
  vtkInformation* info = outputs->GetInformationObject(0);
  return irradiance::runFilter(this, output, [&] {
    // What could not be computed has no blocks: that is an error on all processes.
    auto* blocks = vtkMultiBlockDataSet::SafeDownCast(scene);
    const bool isComputed = blocks && blocks->GetNumberOfBlocks() > 0;
    if (input && isComputed && irradiance::isEmptyPieceRequested(info))
    {
      WriteEmpty(input, scene, output);
    }
    else
    {
      this->Compute(input, scene, output);
    }
    SetDataTime(info, output);
  });
}

void vtkIrradianceProbeFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfPhotons: " << this->NumberOfPhotons << "\n"
     << indent << "MaximumRadius: " << this->MaximumRadius << "\n"
     << indent << "MaximumDistance: " << this->MaximumDistance << "\n";
}
