// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Input/InputConnection.h"
#include "LightGroups.h"

#include <string>
#include <vector>

class vtkPolyData;

namespace irradiance
{

struct ConvertedPolyData;

/// The light groups that inputs name. A lamp belongs to the group that the cell array `LightGroup`
/// says, of texts or numbers; else to the one of the field-data array `LightGroup` of its part or
/// connection; else to the default group of its connection. Groups keep their numbers.
class LampGroups
{
public:
  /// Gives each cell of a part its group, from cell `first` of the target on. Throws InputError.
  void read(const InputPart& part, std::size_t first, ConvertedPolyData& target);
  /// Reads the factors of all parts, the field-data array `LightGroupFactor`: a tuple for each
  /// group that the field-data array `LightGroup` names, or one for the default group. Throws
  /// InputError.
  void readFactors(const SceneInputs& inputs, int bands);

  /// By number; 0 is the default group of what is static.
  const std::vector<LampGroup>& groups() const { return groups_; }
  std::uint32_t numberOf(const std::string& name, bool isNamed);
  /// Of the part's cells that no cell array tells.
  std::uint32_t numberOf(const InputPart& part);

private:
  std::vector<LampGroup> groups_{ { kStaticLampGroup } };
};

}
