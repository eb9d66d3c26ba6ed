// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PowerClasses_h
#define irradiance_PowerClasses_h

#include "Lights/LightTable.h"

#include <vector>

namespace irradiance
{

/**
 * Parts a table by how strong its lamps are, so that a weak lamp beside a strong one has walks and samples of its own: the lamp of
 * a hut while the sun shines outside. A lamp is all lights of an object that share corners, or a point. The strongest lamp
 * has all lamps in its class that are no weaker than a hundredth of it; the strongest of the rest likewise; the last of at most four
 * has all others, and so has one if the rest is no more than `leastPart` of all flux. A single class is the table itself.
 *
 * It depends on the powers and on which lights share corners, not on where they are.
 */
std::vector<LightTable> powerClassesOf(const LightTable& lights, double leastPart);

}

#endif
