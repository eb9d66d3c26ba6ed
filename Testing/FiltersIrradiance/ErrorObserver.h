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

  void Execute(vtkObject*, unsigned long event, void* text) override
  {
    auto& texts = event == vtkCommand::ErrorEvent ? this->Errors : this->Warnings;
    texts.emplace_back(static_cast<const char*>(text));
  }

  void Clear()
  {
    this->Errors.clear();
    this->Warnings.clear();
  }

  std::vector<std::string> Errors;
  std::vector<std::string> Warnings;
};

/// The only error of a filter's update, which must have left no output.
inline std::string OnlyErrorOf(vtkIrradianceFilter* filter)
{
  const auto observer = ErrorObserver::Watch(filter);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfBlocks(), 0u);
  EXPECT_EQ(observer->Errors.size(), 1u);
  return observer->Errors.empty() ? "" : observer->Errors[0];
}

#endif
