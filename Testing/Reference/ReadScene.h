// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Surfaces/SceneObjects.h"

class vtkIrradianceFilter;

namespace pathtracedroom
{

/** The scene of a filter's inputs as the filter reads it: same cells, lamps and poses. Throws
    std::runtime_error for inputs that cannot be computed. */
irradiance::SceneObjects ReadScene(vtkIrradianceFilter* filter);

}
