// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_InputWarning_h
#define irradiance_InputWarning_h

#include "vtkType.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace irradiance
{

/// About an input that can be computed all the same.
struct InputWarning
{
  std::string input; ///< its name
  std::string what;  ///< follows the name, the same for all such inputs
  /// If it is about some of its cells: `what` follows their number, and this their first.
  std::string consequence{};
  vtkIdType cells = 0, firstCell = -1;
};

/// Says once what is the same for many inputs, naming the first and how many there are.
class InputWarnings
{
public:
  /// Of an input that is read again, the same warning counts once.
  void add(const InputWarning& warning);
  /// A text for each kind of warning since the last call.
  std::vector<std::string> take();

private:
  /// The first of each kind, and how many cells it is about, by input.
  std::vector<std::pair<InputWarning, std::map<std::string, vtkIdType>>> kinds_;
};

}

#endif
