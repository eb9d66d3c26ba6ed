// SPDX-License-Identifier: BSD-3-Clause
#include "vtkKeyFramedPose.h"

#include "Data/LeafData.h"
#include "Data/NamedArray.h"
#include "Input/GeometryOrigin.h"
#include "Input/KeyFrameFile.h"
#include "Input/Pose.h"
#include "Output/EmptyPiece.h"
#include "Pipeline/FilterRun.h"
#include "Progress/InputError.h"
#include "Time/TimeKeys.h"

#include "vtkDataObjectTree.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

vtkStandardNewMacro(vtkKeyFramedPose);

class vtkKeyFramedPose::vtkInternals
{
public:
  /// As it was added.
  struct Pose
  {
    double Time;
    std::array<double, 16> Matrix;
  };

  std::vector<Pose> Added;
  irradiance::KeyFrames Keys;
  std::string Error; ///< why there are no keys
  vtkMTimeType KeysTime = 0;
  bool IsAborted = false; ///< in RequestInformation

  /// Throws Interrupted.
  void Update(vtkKeyFramedPose* filter);
  irradiance::KeyFrames ReadKeys(vtkKeyFramedPose* filter) const;
  std::vector<irradiance::KeyFrame> AddedKeys(const std::function<void(double)>& report) const;
  /// None if the part is not there.
  std::optional<irradiance::AffineMap> PoseAt(vtkKeyFramedPose* filter, double time) const;
};

namespace
{

bool HasFile(vtkKeyFramedPose* filter)
{
  return filter->GetFileName() && *filter->GetFileName();
}

void SetPose(vtkPolyData* polyData, const irradiance::AffineMap& worldFromObject)
{
  const auto array = irradiance::addArray<vtkDoubleArray>(
    polyData->GetFieldData(), irradiance::kFieldPoseName, 16, 1);
  for (int i = 0; i < 16; ++i)
  {
    const int row = i / 4, column = i % 4;
    array->SetTypedComponent(0, i,
      row == 3        ? (column == 3 ? 1.0 : 0.0)
        : column == 3 ? worldFromObject.translation[row]
                      : worldFromObject.linear(row, column));
  }
}

void CopyArraysOnly(vtkPolyData* input, vtkPolyData* output)
{
  irradiance::copyEmptyArrays(input, output);
  output->GetFieldData()->ShallowCopy(input->GetFieldData());
  output->GetFieldData()->RemoveArray(irradiance::kFieldPoseName);
}

/// None: the part is not there.
using OptionalPose = std::optional<irradiance::AffineMap>;

void PassOnLeaf(const std::string& name, vtkDataObject* data, const OptionalPose& worldFromInput,
  vtkPolyData* output)
{
  auto* input = vtkPolyData::SafeDownCast(data);
  if (!input)
  {
    throw irradiance::InputError(name + " is " +
      (data ? std::string("a ") + data->GetClassName() : "null") +
      "; only vtkPolyData can have a pose (vtkGeometryFilter makes one of most data)");
  }
  if (!worldFromInput)
  {
    CopyArraysOnly(input, output);
    return;
  }
  output->ShallowCopy(input);
  irradiance::notePassedGeometry(output, input);
  SetPose(
    output, irradiance::composed(*worldFromInput, irradiance::poseOf(name, input->GetFieldData())));
}

void PassOn(vtkDataObject* input, OptionalPose worldFromInput, vtkDataObject* output)
{
  const std::string name = "the input";
  auto* tree = vtkDataObjectTree::SafeDownCast(input);
  if (!tree)
  {
    PassOnLeaf(name, input, worldFromInput, vtkPolyData::SafeDownCast(output));
    return;
  }
  if (worldFromInput)
  {
    worldFromInput =
      irradiance::composed(*worldFromInput, irradiance::poseOf(name, tree->GetFieldData()));
  }
  output->ShallowCopy(tree);
  output->GetFieldData()->RemoveArray(irradiance::kFieldPoseName);
  irradiance::forEachLeaf(tree, [&](vtkDataObjectTreeIterator* leaf) {
    vtkNew<vtkPolyData> passed;
    PassOnLeaf(name + ", " + irradiance::leafName(leaf), leaf->GetCurrentDataObject(),
      worldFromInput, passed);
    vtkDataObjectTree::SafeDownCast(output)->SetDataSet(leaf, passed);
  });
}

}

vtkKeyFramedPose::vtkKeyFramedPose()
  : Internals(new vtkInternals)
{
}

vtkKeyFramedPose::~vtkKeyFramedPose()
{
  this->SetFileName(nullptr);
}

void vtkKeyFramedPose::AddPose(
  double time, double x, double y, double z, double rx, double ry, double rz)
{
  const double position[3] = { x, y, z }, orientation[3] = { rx, ry, rz };
  this->AddPose(time, position, orientation);
}

void vtkKeyFramedPose::AddPose(double time, const double position[3], const double orientation[3])
{
  this->AddPoseMatrix(time, irradiance::propMatrix(position, orientation).data());
}

void vtkKeyFramedPose::AddPoseMatrix(double time, double m00, double m01, double m02, double m03,
  double m10, double m11, double m12, double m13, double m20, double m21, double m22, double m23,
  double m30, double m31, double m32, double m33)
{
  this->Internals->Added.push_back(
    { time, { m00, m01, m02, m03, m10, m11, m12, m13, m20, m21, m22, m23, m30, m31, m32, m33 } });
  this->Modified();
}

void vtkKeyFramedPose::AddPoseMatrix(double time, const double matrix[16])
{
  vtkInternals::Pose pose{ time, {} };
  std::copy_n(matrix, 16, pose.Matrix.begin());
  this->Internals->Added.push_back(pose);
  this->Modified();
}

void vtkKeyFramedPose::AddPoseMatrix(double time, vtkMatrix4x4* matrix)
{
  if (!matrix)
  {
    vtkErrorMacro("AddPoseMatrix at time " << time << ": the matrix is null");
    return;
  }
  this->AddPoseMatrix(time, matrix->GetData());
}

void vtkKeyFramedPose::RemoveAllPoses()
{
  if (!this->Internals->Added.empty())
  {
    this->Internals->Added.clear();
    this->Modified();
  }
}

int vtkKeyFramedPose::GetNumberOfPoses()
{
  return static_cast<int>(this->Internals->Added.size());
}

std::vector<irradiance::KeyFrame> vtkKeyFramedPose::vtkInternals::AddedKeys(
  const std::function<void(double)>& report) const
{
  std::vector<irradiance::KeyFrame> keys;
  const irradiance::CancelPoint cancelPoint = [&] {
    report(static_cast<double>(keys.size()) / static_cast<double>(this->Added.size()));
  };
  irradiance::ThrottledCancelPoint pace(cancelPoint);
  for (const Pose& pose : this->Added)
  {
    pace.step();
    const std::string name = "pose " + std::to_string(keys.size());
    keys.push_back({ name, pose.Time, irradiance::poseOf(name, pose.Matrix.data()) });
  }
  std::stable_sort(keys.begin(), keys.end(),
    [](const irradiance::KeyFrame& a, const irradiance::KeyFrame& b) { return a.time < b.time; });
  return keys;
}

irradiance::KeyFrames vtkKeyFramedPose::vtkInternals::ReadKeys(vtkKeyFramedPose* filter) const
{
  const bool hasFile = HasFile(filter);
  if (hasFile && !this->Added.empty())
  {
    throw irradiance::InputError(std::string("FileName is ") + filter->GetFileName() + ", and " +
      std::to_string(this->Added.size()) +
      " poses were added; only one of the two is possible (RemoveAllPoses)");
  }
  irradiance::SmpExecution execution = irradiance::executionOf(filter);
  const auto report = [&](double progress) {
    if (!execution.reportProgress(progress))
    {
      throw irradiance::Interrupted();
    }
  };
  std::vector<irradiance::KeyFrame> keys =
    hasFile ? irradiance::readKeyFrames(filter->GetFileName(), report) : this->AddedKeys(report);
  if (keys.size() < 2)
  {
    throw irradiance::InputError(
      (hasFile ? "the file " + std::string(filter->GetFileName()) + " has " : "there is ") +
      (keys.empty() ? "no pose" : "one pose alone") + "; two at least are needed");
  }
  return { std::move(keys),
    static_cast<irradiance::KeyInterpolation>(filter->GetInterpolationType()), [&] { report(1); } };
}

void vtkKeyFramedPose::vtkInternals::Update(vtkKeyFramedPose* filter)
{
  if (this->KeysTime == filter->GetMTime())
  {
    return;
  }
  this->KeysTime = 0; // after an abort they are to be read
  this->Keys = {};
  this->Error.clear();
  try
  {
    this->Keys = this->ReadKeys(filter);
  }
  catch (const irradiance::InputError& error)
  {
    this->Error = error.what();
  }
  this->KeysTime = filter->GetMTime();
}

std::optional<irradiance::AffineMap> vtkKeyFramedPose::vtkInternals::PoseAt(
  vtkKeyFramedPose* filter, double time) const
{
  if (time >= this->Keys.begin() && time <= this->Keys.end())
  {
    return this->Keys.at(time);
  }
  if (filter->GetOutsideOfKeys() == Leave)
  {
    return std::nullopt;
  }
  if (filter->GetOutsideOfKeys() == Hold && !std::isnan(time))
  {
    return this->Keys.at(std::clamp(time, this->Keys.begin(), this->Keys.end()));
  }
  throw irradiance::InputError("the keys are from " + irradiance::text(this->Keys.begin()) +
    " to " + irradiance::text(this->Keys.end()) + ", and the time " + irradiance::text(time) +
    " is asked for (OutsideOfKeys says what to do then)");
}

int vtkKeyFramedPose::FillInputPortInformation(int, vtkInformation* info)
{
  // Composite types first: else the executive would call the filter for each block separately,
  // without times. Other data is refused when it comes, by name.
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObjectTree");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  return 1;
}

vtkPolyData* vtkKeyFramedPose::GetOutput()
{
  return this->GetPolyDataOutput();
}

int vtkKeyFramedPose::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* output)
{
  irradiance::TimeKeys times(inputs, 1);
  this->Internals->IsAborted = false;
  try
  {
    irradiance::forgetAbort(this);
    this->Internals->Update(this); // what is wrong is said once, when the data are asked for
    const irradiance::KeyFrames& keys = this->Internals->Keys;
    times.addSteps(keys.isEmpty() ? std::vector<double>() : keys.steps(this->NumberOfTimeSteps));
  }
  catch (const irradiance::Interrupted&)
  {
    this->Internals->IsAborted = true;
  }
  times.write(output);
  return 1;
}

int vtkKeyFramedPose::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkDataObject* output = vtkDataObject::GetData(outputs);
  vtkInformation* info = outputs->GetInformationObject(0);
  return irradiance::runFilter(this, output, [&] {
    if (std::exchange(this->Internals->IsAborted, false))
    {
      throw irradiance::Interrupted();
    }
    this->Internals->Update(this);
    if (!this->Internals->Error.empty())
    {
      throw irradiance::InputError(this->Internals->Error);
    }
    auto* timeKey = vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP();
    const double time = info->Has(timeKey) ? info->Get(timeKey) : this->Internals->Keys.begin();
    PassOn(vtkDataObject::GetData(inputs[0]), this->Internals->PoseAt(this, time), output);
    output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
  });
}

void vtkKeyFramedPose::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n"
     << indent << "InterpolationType: " << this->InterpolationType << "\n"
     << indent << "OutsideOfKeys: " << this->OutsideOfKeys << "\n"
     << indent << "NumberOfTimeSteps: " << this->NumberOfTimeSteps << "\n"
     << indent << "Poses: " << this->Internals->Added.size() << "\n";
}
