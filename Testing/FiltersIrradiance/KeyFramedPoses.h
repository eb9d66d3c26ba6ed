// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ErrorObserver.h"
#include "TestScenes.h"

#include "vtkKeyFramedPose.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

/// What a vtkKeyFramedPose gives at a time, and what it says.
namespace KeyFramedPoses
{

using namespace TestScenes;

inline vtkSmartPointer<vtkKeyFramedPose> MakePose(vtkPolyData* input)
{
  auto pose = vtkSmartPointer<vtkKeyFramedPose>::New();
  pose->SetInputData(input);
  return pose;
}

/// The matrix at a time, row by row; empty if there is none.
inline std::vector<double> MatrixAt(vtkKeyFramedPose* pose, double time)
{
  pose->UpdateTimeStep(time);
  vtkDataArray* array = pose->GetOutput()->GetFieldData()->GetArray("ObjectToWorld");
  return array ? std::vector<double>(static_cast<double*>(array->GetVoidPointer(0)),
                   static_cast<double*>(array->GetVoidPointer(0)) + array->GetNumberOfValues())
               : std::vector<double>();
}

inline std::vector<double> MatrixOf(vtkTransform* transform)
{
  const double* data = transform->GetMatrix()->GetData();
  return { data, data + 16 };
}

inline vtkSmartPointer<vtkTransform> Turned(const Vector& position, const Vector& degrees)
{
  auto transform = vtkSmartPointer<vtkTransform>::New();
  transform->Translate(position.data());
  transform->RotateZ(degrees[2]);
  transform->RotateX(degrees[0]);
  transform->RotateY(degrees[1]);
  return transform;
}

/// The largest difference of two matrices; infinite if they are not of one size.
inline double Difference(const std::vector<double>& a, const std::vector<double>& b)
{
  double largest = a.size() == b.size() && !a.empty() ? 0 : std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; std::isfinite(largest) && i < a.size(); ++i)
  {
    largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  return largest;
}

/// Updates and returns the only error; the output must be empty.
inline std::string ErrorOf(vtkKeyFramedPose* pose, double time)
{
  pose->UpdateInformation();
  pose->GetOutputInformation(0)->Set(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(), time);
  const auto observer = ErrorObserver::Watch(pose);
  pose->Update();
  EXPECT_EQ(pose->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(observer->Errors.size(), 1u);
  return observer->Errors.empty() ? "" : observer->Errors[0];
}

}
