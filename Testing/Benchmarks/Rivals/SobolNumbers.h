// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

/// The first points of Sobol's sequence in eight dimensions, as fractions of 2^32. With a digital
/// shift (exclusive or) at random in each dimension they are uniform.
using SobolNumbers = std::vector<std::array<std::uint32_t, 8>>;

SobolNumbers makeSobolNumbers(std::uint32_t count);
