// SPDX-License-Identifier: BSD-3-Clause
#include "Estimates/StudentT.h"

#include "Geometry/Vector.h"

#include <cmath>

namespace irradiance
{

/// The finite sums of Abramowitz and Stegun 26.7.3 (odd) and 26.7.4 (even degrees of freedom).
double studentProbability(double t, int freedom)
{
  const double angle = std::atan(t / std::sqrt(static_cast<double>(freedom)));
  const double sine = std::sin(angle), cosine = std::cos(angle);
  const bool isOdd = freedom % 2 != 0;
  double term = isOdd ? cosine : 1, sum = 0;
  for (int i = isOdd ? 1 : 0; i <= freedom - 2; i += 2)
  {
    sum += term;
    term *= cosine * cosine * (i + 1) / (i + 2);
  }
  return isOdd ? 2 / kPi * (angle + sine * sum) : sine * sum;
}

double studentQuantile(double probability, int freedom)
{
  double below = 0, above = 1;
  while (studentProbability(above, freedom) < probability)
  {
    above *= 2;
  }
  double middle = 0.5 * above;
  while (below < middle && middle < above)
  {
    (studentProbability(middle, freedom) < probability ? below : above) = middle;
    middle = 0.5 * (below + above);
  }
  return above;
}

}
