// SPDX-License-Identifier: BSD-3-Clause
#include "ErrorListener.h"

#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkObject.h>

#include <stdexcept>

namespace movingteapot
{
namespace
{

// "ERROR: In file, line 7\nvtkThing (0x1234): what is wrong\n\n" says much to few.
std::string WhatIsWrong(const std::string& text)
{
  const std::size_t speaker = text.find("): ");
  const std::string what = speaker == std::string::npos ? text : text.substr(speaker + 3);
  return what.substr(0, what.find_last_not_of(" \n") + 1);
}

void Keep(vtkObject*, unsigned long, void* firstComplaint, void* text)
{
  auto& complaint = *static_cast<std::string*>(firstComplaint);
  if (complaint.empty() && text)
  {
    complaint = WhatIsWrong(static_cast<const char*>(text));
  }
}

}

ErrorListener::ErrorListener(vtkObject* speaker)
  : Speaker(speaker)
{
  vtkNew<vtkCallbackCommand> listener;
  listener->SetClientData(&this->FirstComplaint);
  listener->SetCallback(Keep);
  this->Tag = speaker->AddObserver("ErrorEvent", listener);
}

ErrorListener::~ErrorListener()
{
  this->Speaker->RemoveObserver(this->Tag);
}

void ErrorListener::ThrowIfAny(const std::string& what) const
{
  if (!this->FirstComplaint.empty())
  {
    throw std::runtime_error(what + ": " + this->FirstComplaint);
  }
}

}
