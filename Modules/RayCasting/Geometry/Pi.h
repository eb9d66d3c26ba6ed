// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Pi_h
#define irradiance_Pi_h

namespace irradiance
{

constexpr double kPi = 3.14159265358979323846;

}

#endif
