// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <utility>
#include <vector>

/// Counts the events of a filter, and changes something or aborts the filter at one of them.
class EventObserver : public vtkCommand
{
public:
  static EventObserver* New() { return new EventObserver; }

  static vtkSmartPointer<EventObserver> Watch(
    vtkAlgorithm* filter, unsigned long event = vtkCommand::ProgressEvent)
  {
    auto observer = vtkSmartPointer<EventObserver>::New();
    filter->AddObserver(event, observer);
    return observer;
  }

  void Execute(vtkObject* caller, unsigned long event, void* data) override
  {
    ++this->Count;
    if (event == vtkCommand::ProgressEvent)
    {
      this->Progress.push_back(*static_cast<double*>(data));
    }
    if (this->Change && this->EventsToWait-- == 0)
    {
      this->EventsToWait = 0;
      std::exchange(this->Change, nullptr)();
    }
    if ((this->AbortIn > 0 && --this->AbortIn == 0) ||
      (!this->Progress.empty() && this->Progress.back() >= this->AbortFrom))
    {
      static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
    }
  }

  int Count = 0;
  std::vector<double> Progress;
  std::function<void()> Change; ///< done once
  int EventsToWait = 0;         ///< before that
  int AbortIn = 0;              ///< events; 0: never
  double AbortFrom = 2;         ///< progress; above 1: never
};
