// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PhotonNoise_h
#define irradiance_PhotonNoise_h

#include <vector>

namespace irradiance
{

/// What became of the differences of many values: the sum of their sizes.
struct NoisyDifference
{
  double signal; ///< what the noise of photons does not explain
  double noise;  ///< the rest
};

/**
 * `variances`: what the differences would have if all photons arrived independently; 0: there is
 * no noise. Neighbours in the vectors should be neighbours in space.
 *
 * A difference is signal as far as it exceeds some standard deviations. Much light that is off by
 * little hides in the noise of single values, but not in the noise of their sums. So values are
 * also taken together, by two, four, eight, up to all; the grouping with the most signal counts.
 */
NoisyDifference splitDifference(std::vector<double> differences, std::vector<double> variances);

}

#endif
