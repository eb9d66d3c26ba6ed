// SPDX-License-Identifier: BSD-3-Clause
#ifndef Reports_h
#define Reports_h

#include "ErrorObserver.h"

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
  for (const std::string& word : words)
  {
    EXPECT_NE(reports[0].find(word), std::string::npos)
      << "no \"" << word << "\" in " << reports[0];
  }
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

#endif
