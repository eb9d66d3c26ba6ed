// SPDX-License-Identifier: BSD-3-Clause
#ifndef ErrorObserver_h
#define ErrorObserver_h

#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkExecutive.h"
#include "vtkIrradianceFilter.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

/// Collects the texts of the errors and warnings of a filter.
class ErrorObserver : public vtkCommand
{
public:
  static ErrorObserver* New() { return new ErrorObserver; }

  static vtkSmartPointer<ErrorObserver> Watch(vtkAlgorithm* filter)
  {
    auto observer = vtkSmartPointer<ErrorObserver>::New();
    for (const auto event : { vtkCommand::ErrorEvent, vtkCommand::WarningEvent })
    {
      filter->AddObserver(event, observer);
      filter->GetExecutive()->AddObserver(event, observer);
    }
    return observer;
  }

  void Execute(vtkObject* caller, unsigned long event, void* data) override
  {
    const std::string text = static_cast<const char*>(data);
    if (caller->IsA("vtkExecutive") && text.find("returned failure") != std::string::npos)
    {
      ++this->Failures; // the pipeline's own report of a filter that gave up
      return;
    }
    (event == vtkCommand::ErrorEvent ? this->Errors : this->Warnings).push_back(text);
  }

  void Clear()
  {
    this->Errors.clear();
    this->Warnings.clear();
    this->Failures = 0;
  }

  std::vector<std::string> Errors;
  std::vector<std::string> Warnings;
  int Failures = 0; ///< executions reported to the pipeline as failed
};

/// Updates a filter and returns its only error; the output must be empty.
inline std::string OnlyErrorOf(vtkIrradianceFilter* filter)
{
  const auto observer = ErrorObserver::Watch(filter);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfBlocks(), 0u);
  EXPECT_EQ(observer->Errors.size(), 1u);
  EXPECT_EQ(observer->Failures, 1);
  return observer->Errors.empty() ? "" : observer->Errors[0];
}

#endif
