// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ErrorObserver.h"
#include "TestScenes.h"

#include "vtkIrradianceProbeFilter.h"

#include <gtest/gtest.h>

/// Sensors in a scene, and what they measure.
struct SensorPipeline
{
  vtkSmartPointer<vtkIrradianceFilter> Irradiance;
  vtkNew<vtkIrradianceProbeFilter> Probe;
  vtkSmartPointer<ErrorObserver> Reports = ErrorObserver::Watch(Probe);

  SensorPipeline(const TestScenes::Scene& scene, vtkIdType walks, vtkDataSet* sensors)
    : Irradiance(TestScenes::MakeFilter(scene, walks))
  {
    this->Probe->SetInputData(sensors);
    this->Probe->SetSourceConnection(this->Irradiance->GetOutputPort());
    this->Probe->SetNumberOfRays(16);
  }
  vtkDataArray* Array(const char* name)
  {
    return this->Probe->GetOutput()->GetPointData()->GetArray(name);
  }
  double Value(const char* name, vtkIdType point)
  {
    return this->Array(name)->GetComponent(point, 0);
  }
  std::vector<double> Update(const char* name)
  {
    this->Probe->Update();
    return TestScenes::ValuesOf(this->Array(name));
  }
  /// Updates without an error or a warning.
  void ExpectNothingSaid()
  {
    this->Reports->Clear();
    this->Probe->Update();
    EXPECT_TRUE(this->Reports->Errors.empty() && this->Reports->Warnings.empty());
  }
  void ExpectError(const std::string& words)
  {
    this->Reports->Clear();
    this->Probe->Update();
    ExpectOne(this->Reports->Errors, { words });
    EXPECT_EQ(this->Probe->GetOutput()->GetNumberOfPoints(), 0);
  }
};
