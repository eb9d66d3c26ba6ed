// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/KeyFrames.h"

#include <functional>
#include <string>
#include <vector>

namespace irradiance
{

/// The key frames in a file as vtkKeyFramedPose.h describes it. Names may have quotes, quaternions
/// any length but 0. Throws InputError, naming file, line, column and value. `report` is called now
/// and then with what was read of the file, 0..1; it may throw.
std::vector<KeyFrame> readKeyFrames(
  const std::string& fileName, const std::function<void(double)>& report);

}
