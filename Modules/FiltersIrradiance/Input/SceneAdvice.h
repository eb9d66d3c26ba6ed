// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Input/SceneReader.h"
#include "LightGroups.h"

#include <string>
#include <vector>

namespace irradiance
{

/// Says where more light arrived than there is; empty if that may be noise. W in a band; `error`:
/// the standard error of what escaped.
std::string excessWarning(double emitted, double escaped, double error);

/// Finds scenes that can be computed but are hardly meant, and says what was probably meant: lamps
/// that shine away from everything or on the backs of others, millimetres where metres are read,
/// and so few walks that rays find nothing to read. Documentation/Extremes.md has the limits and
/// says what is legitimate beyond them. After an update of `groups` with `scene`, which has read
/// the inputs. Warnings, a sentence or two each.
std::vector<std::string> sceneAdvice(const SceneInputs& inputs, const SceneReader& scene,
  const LightGroups& groups, const CancelPoint& cancelPoint);

}
