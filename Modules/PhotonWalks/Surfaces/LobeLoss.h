// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_LobeLoss_h
#define irradiance_LobeLoss_h

#include <cstddef>
#include <vector>

namespace irradiance
{

/// The part b of the light that the first term of a PhongLobe loses, over the cosine of incidence
/// and the width of the lobe, w = 1 / sqrt(n + 1), from 0 (a mirror) to 1 (n = 0).
namespace LobeLoss
{

constexpr std::size_t kNodes = 257;

/// The cosines at which at() knows the loss, from 0 to 1: closer together at both ends, where the
/// loss of narrow lobes changes.
double cosineOf(std::size_t node);

/**
 * The losses of a lobe at all nodes, with errors below 2^-12 for n up to 10,000. Interpolated in a
 * table over widths, each row of which is computed when it is first asked for. It is rounded to
 * multiples of 2^-22, so that results do not depend on the last bits of a system's library. Several
 * threads may call it.
 */
std::vector<double> at(double width);

/// The loss for a cosine in [0, 1], by quadrature.
double integral(double cosine, double width);

}

}

#endif
