// SPDX-License-Identifier: BSD-3-Clause
#ifndef Box_h
#define Box_h

#include <array>

namespace movingteapot
{

/** xmin, xmax, ymin, ymax, zmin, zmax in m. */
using Box = std::array<double, 6>;

}

#endif
