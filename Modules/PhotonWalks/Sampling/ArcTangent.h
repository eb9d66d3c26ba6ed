// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_ArcTangent_h
#define irradiance_ArcTangent_h

#include <algorithm>
#include <cmath>

namespace irradiance
{

/**
 * The angle in [0, pi], in radians, between (x, y), y >= 0, and the x axis; 0 of (0, 0). Our own,
 * like SinCos: the libraries of different systems differ in the last bits. Without branches. The
 * error is below 2^-51 of the angle.
 *
 * The addition theorem takes the angle of the nearest of 0, 1/8 and 1/4 half turns off, which
 * leaves tangents of at most tan(pi / 16); Gregory's series does the rest.
 */
inline double arcTangent(double y, double x)
{
  constexpr double kTan16th = 0.198912367379658, kTan3_16ths = 0.6681786379192989;
  constexpr double kTan8th = 0.41421356237309503; // a double: the angle is the one of its bits
  constexpr double kEighth = 0.39269908169872414, kQuarter = 0.7853981633974483;
  constexpr double kHalf = 1.5707963267948966, kWhole = 3.141592653589793;
  const double across = std::abs(x);
  const double less = std::min(y, across), more = std::max(y, across);
  const bool isOverFirst = less > kTan16th * more, isOverSecond = less > kTan3_16ths * more;
  const double tangent = isOverSecond ? 1 : isOverFirst ? kTan8th : 0;
  const double base = isOverSecond ? kQuarter : isOverFirst ? kEighth : 0;
  const double below = more + tangent * less;
  const double z = below > 0 ? (less - tangent * more) / below : 0;
  // What is left out of the series is below tan(pi / 16)^22 / 23 = 2^-56 of it.
  const double zz = z * z, z4 = zz * zz;
  // Sums of even and of odd powers, as half as long chains take half as long.
  const double odd = 1 / 3.0 + z4 * (1 / 7.0 + z4 * (1 / 11.0 + z4 * (1 / 15.0 + z4 * (1 / 19.0))));
  const double even =
    1 / 5.0 + z4 * (1 / 9.0 + z4 * (1 / 13.0 + z4 * (1 / 17.0 + z4 * (1 / 21.0))));
  const double angle = base + (z - z * zz * (odd - zz * even));
  const double fromX = y > across ? kHalf - angle : angle;
  return x < 0 ? kWhole - fromX : fromX;
}

}

#endif
