// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_OldNames_h
#define irradiance_OldNames_h

#include "vtkObject.h"

#include <set>
#include <string>

namespace irradiance
{

/// Names of a filter's public face that work for one more release. Each filter warns once of each
/// name that is used.
class OldNames
{
public:
  /// `what` to do instead: "set Method".
  void warn(vtkObject* filter, const std::string& name, const std::string& what)
  {
    if (warned_.insert(name).second)
    {
      vtkWarningWithObjectMacro(filter, << name << " will go: " << what);
    }
  }

private:
  std::set<std::string> warned_;
};

}

#endif
