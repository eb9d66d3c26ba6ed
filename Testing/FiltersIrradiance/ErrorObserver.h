// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

inline void ExpectWords(const std::string& text, const std::vector<std::string>& words)
{
  for (const std::string& word : words)
  {
    EXPECT_NE(text.find(word), std::string::npos) << "\"" << word << "\" is not in: " << text;
  }
}

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

/// What a filter says in one update.
struct Reports
{
  std::vector<std::string> Errors, Warnings;
};

inline Reports Update(vtkAlgorithm* filter)
{
  const auto observer = ErrorObserver::Watch(filter);
  filter->Update();
  filter->RemoveObserver(observer);
  filter->GetExecutive()->RemoveObserver(observer);
  return { observer->Errors, observer->Warnings };
}

inline void ExpectOne(
  const std::vector<std::string>& reports, const std::vector<std::string>& words)
{
  ASSERT_EQ(reports.size(), 1u) << testing::PrintToString(reports);
  ExpectWords(reports[0], words);
}

inline void ExpectNothing(const Reports& reports)
{
  EXPECT_TRUE(reports.Errors.empty()) << testing::PrintToString(reports.Errors);
  EXPECT_TRUE(reports.Warnings.empty()) << testing::PrintToString(reports.Warnings);
}

inline void ExpectOnlyError(vtkIrradianceFilter* filter, const std::vector<std::string>& words)
{
  const Reports reports = Update(filter);
  ExpectOne(reports.Errors, words);
  EXPECT_TRUE(reports.Warnings.empty());
  EXPECT_EQ(filter->GetOutput()->GetNumberOfBlocks(), 0u);
}

inline void ExpectOnlyWarning(vtkIrradianceFilter* filter, const std::vector<std::string>& words)
{
  const Reports reports = Update(filter);
  EXPECT_TRUE(reports.Errors.empty());
  ExpectOne(reports.Warnings, words);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfBlocks(), 2u);
}
