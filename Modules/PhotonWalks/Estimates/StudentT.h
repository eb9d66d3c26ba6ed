// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_StudentT_h
#define irradiance_StudentT_h

namespace irradiance
{

/// Probability that |T| <= t, with Student's distribution of `freedom` >= 1 degrees; t >= 0.
double studentProbability(double t, int freedom);

/// The t that |T| does not exceed with `probability`, 0 < probability < 1.
double studentQuantile(double probability, int freedom);

}

#endif
