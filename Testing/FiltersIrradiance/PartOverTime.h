// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "TestScenes.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <functional>
#include <limits>
#include <vector>

/// A source of polydata that a function changes over time.
class PartOverTime : public vtkPolyDataAlgorithm
{
public:
  static PartOverTime* New() { VTK_STANDARD_NEW_BODY(PartOverTime); }
  vtkTypeMacro(PartOverTime, vtkPolyDataAlgorithm);

  /// Times: TIME_STEPS, whose ends are the TIME_RANGE.
  static vtkSmartPointer<PartOverTime> Make(const TestScenes::Mesh& model,
    const std::vector<double>& times, const std::function<void(vtkPolyData*, double)>& change)
  {
    auto part = vtkSmartPointer<PartOverTime>::New();
    part->Model = model;
    part->Times = times;
    part->Change = change;
    return part;
  }

  TestScenes::Mesh Model;
  std::vector<double> Times;
  std::function<void(vtkPolyData*, double)> Change;
  bool TellsRange = true;
  double FailsAt = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> Visits; ///< the times of all executions

protected:
  PartOverTime() { this->SetNumberOfInputPorts(0); }

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* output) override
  {
    if (!this->Times.empty())
    {
      const double range[2] = { this->Times.front(), this->Times.back() };
      vtkInformation* info = output->GetInformationObject(0);
      info->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), this->Times.data(),
        static_cast<int>(this->Times.size()));
      if (this->TellsRange)
      {
        info->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
      }
    }
    return 1;
  }

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* output) override
  {
    vtkInformation* info = output->GetInformationObject(0);
    auto* key = vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP();
    const double time = info->Has(key) ? info->Get(key) : 0;
    this->Visits.push_back(time);
    if (time == this->FailsAt)
    {
      vtkErrorMacro("fails on purpose at time " << time);
      return 0;
    }
    vtkPolyData* polyData = vtkPolyData::GetData(output);
    polyData->ShallowCopy(this->Model);
    this->Change(polyData, time);
    return 1;
  }
};

/// Sets the pose of a part: a translation.
inline void MoveTo(vtkPolyData* part, const TestScenes::Vector& position)
{
  const auto& [x, y, z] = position;
  TestScenes::SetField(part, "ObjectToWorld", { 1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z, 0, 0, 0, 1 });
}
