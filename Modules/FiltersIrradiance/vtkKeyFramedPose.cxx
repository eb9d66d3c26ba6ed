// SPDX-License-Identifier: BSD-3-Clause
#include "vtkKeyFramedPose.h"

#include "Data/LeafData.h"
#include "Data/NamedArray.h"
#include "Input/InputConnection.h"
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

using namespace irradiance;

vtkStandardNewMacro(vtkKeyFramedPose);

namespace
{

/// None: the part is not there.
using OptionalPose = std::optional<AffineMap>;

void PassOnLeaf(const std::string& name, vtkDataObject* data, const OptionalPose& worldFromInput,
  vtkPolyData* output)
{
  auto* input = vtkPolyData::SafeDownCast(data);
  throwIf(!input, name, " is ", data ? "a " : "null", data ? data->GetClassName() : "",
    "; only vtkPolyData can have a pose (vtkGeometryFilter makes one of most data)");
  if (!worldFromInput)
  {
    copyEmptyArrays(input, output);
    output->GetFieldData()->ShallowCopy(input->GetFieldData());
    output->GetFieldData()->RemoveArray(kFieldPoseName);
    return;
  }
  output->ShallowCopy(input);
  notePassedGeometry(output, input);
  const AffineMap pose = composed(*worldFromInput, poseOf(name, input->GetFieldData()));
  addArray<vtkDoubleArray>(output->GetFieldData(), kFieldPoseName, 16, 1)
    ->SetTypedTuple(0, matrixOf(pose).data());
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
    worldFromInput = composed(*worldFromInput, poseOf(name, tree->GetFieldData()));
  }
  output->ShallowCopy(tree);
  output->GetFieldData()->RemoveArray(kFieldPoseName);
  forEachLeaf(tree, [&](vtkDataObjectTreeIterator* leaf) {
    vtkNew<vtkPolyData> passed;
    PassOnLeaf(name + ", " + leafName(leaf), leaf->GetCurrentDataObject(), worldFromInput, passed);
    vtkDataObjectTree::SafeDownCast(output)->SetDataSet(leaf, passed);
  });
}

}

class vtkKeyFramedPose::vtkInternals
{
public:
  explicit vtkInternals(vtkKeyFramedPose* filter)
    : Filter(filter)
  {
  }

  /// Throws Interrupted.
  void Update()
  {
    if (this->KeysTime == this->Filter->GetMTime())
    {
      return;
    }
    this->KeysTime = 0; // after an abort they are to be read
    this->Keys = {};
    this->Error.clear();
    try
    {
      this->Keys = this->ReadKeys();
    }
    catch (const InputError& error)
    {
      this->Error = error.what();
    }
    this->KeysTime = this->Filter->GetMTime();
  }

  /// None if the part is not there.
  OptionalPose PoseAt(double time) const
  {
    const bool isOutside = !(time >= this->Keys.begin() && time <= this->Keys.end());
    if (isOutside && this->Filter->GetOutsideOfKeys() == Leave)
    {
      return std::nullopt;
    }
    throwIf(isOutside && (this->Filter->GetOutsideOfKeys() != Hold || std::isnan(time)),
      "the keys are from ", this->Keys.begin(), " to ", this->Keys.end(), ", and the time ", time,
      " is asked for (OutsideOfKeys says what to do then)");
    return this->Keys.at(std::clamp(time, this->Keys.begin(), this->Keys.end()));
  }

  /// Times and matrices, as they were added.
  std::vector<std::pair<double, std::array<double, 16>>> Added;
  KeyFrames Keys;
  std::string Error;      ///< why there are no keys
  bool IsAborted = false; ///< in RequestInformation

private:
  std::vector<KeyFrame> AddedKeys(const std::function<void(double)>& report) const
  {
    std::vector<KeyFrame> keys;
    const CancelPoint cancelPoint = [&] {
      report(static_cast<double>(keys.size()) / static_cast<double>(this->Added.size()));
    };
    ThrottledCancelPoint pace(cancelPoint);
    for (const auto& [time, matrix] : this->Added)
    {
      pace.step();
      const std::string name = "pose " + std::to_string(keys.size());
      keys.push_back({ name, time, poseOf(name, matrix.data()) });
    }
    std::stable_sort(keys.begin(), keys.end(),
      [](const KeyFrame& a, const KeyFrame& b) { return a.time < b.time; });
    return keys;
  }

  KeyFrames ReadKeys() const
  {
    const char* const file = this->Filter->GetFileName();
    const bool hasFile = file && *file;
    throwIf(hasFile && !this->Added.empty(), "FileName is ", file, ", and ", this->Added.size(),
      " poses were added; only one of the two is possible (RemoveAllPoses)");
    SmpExecution execution = executionOf(this->Filter);
    const auto report = [&](double progress) {
      if (!execution.reportProgress(progress))
      {
        throw Interrupted();
      }
    };
    std::vector<KeyFrame> keys = hasFile ? readKeyFrames(file, report) : this->AddedKeys(report);
    throwIf(keys.size() < 2, hasFile ? joined("the file ", file, " has ") : "there is ",
      keys.empty() ? "no pose" : "one pose alone", "; two at least are needed");
    return { std::move(keys), static_cast<KeyInterpolation>(this->Filter->GetInterpolationType()),
      [&] { report(1); } };
  }

  vtkKeyFramedPose* Filter;
  vtkMTimeType KeysTime = 0;
};

vtkKeyFramedPose::vtkKeyFramedPose()
  : Internals(new vtkInternals(this))
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
  this->AddPoseMatrix(time, propMatrix(position, orientation).data());
}

void vtkKeyFramedPose::AddPoseMatrix(double time, double m00, double m01, double m02, double m03,
  double m10, double m11, double m12, double m13, double m20, double m21, double m22, double m23,
  double m30, double m31, double m32, double m33)
{
  const double matrix[16] = { m00, m01, m02, m03, m10, m11, m12, m13, m20, m21, m22, m23, m30, m31,
    m32, m33 };
  this->AddPoseMatrix(time, matrix);
}

void vtkKeyFramedPose::AddPoseMatrix(double time, const double matrix[16])
{
  std::copy_n(matrix, 16, this->Internals->Added.emplace_back().second.begin());
  this->Internals->Added.back().first = time;
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

int vtkKeyFramedPose::FillInputPortInformation(int, vtkInformation* info)
{
  return setInputTypes(info, "vtkDataObjectTree", "vtkDataObject");
}

vtkPolyData* vtkKeyFramedPose::GetOutput()
{
  return this->GetPolyDataOutput();
}

int vtkKeyFramedPose::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* output)
{
  std::vector<double> steps;
  this->Internals->IsAborted = false;
  try
  {
    forgetAbort(this);
    this->Internals->Update(); // what is wrong is said once, when the data are asked for
    const KeyFrames& keys = this->Internals->Keys;
    steps = keys.isEmpty() ? steps : keys.steps(this->NumberOfTimeSteps);
  }
  catch (const Interrupted&)
  {
    this->Internals->IsAborted = true;
  }
  uniteTimes(inputs, 1, output, steps);
  return 1;
}

int vtkKeyFramedPose::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkDataObject* output = vtkDataObject::GetData(outputs);
  vtkInformation* info = outputs->GetInformationObject(0);
  return runFilter(this, output, [&] {
    if (std::exchange(this->Internals->IsAborted, false))
    {
      throw Interrupted();
    }
    this->Internals->Update();
    throwIf(!this->Internals->Error.empty(), this->Internals->Error);
    auto* timeKey = vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP();
    const double time = info->Has(timeKey) ? info->Get(timeKey) : this->Internals->Keys.begin();
    PassOn(vtkDataObject::GetData(inputs[0]), this->Internals->PoseAt(time), output);
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
