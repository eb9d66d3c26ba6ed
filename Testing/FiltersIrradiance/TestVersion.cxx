// SPDX-License-Identifier: BSD-3-Clause
// The macros of the version agree with each other.

#include "vtkIrradianceVersion.h"

#include <gtest/gtest.h>

#include <string>

#if VTKIRRADIANCE_VERSION_NUMBER < VTKIRRADIANCE_VERSION_CHECK(0, 1, 0) ||                         \
  VTKIRRADIANCE_VERSION_NUMBER >= VTKIRRADIANCE_VERSION_CHECK(100, 0, 0)
#error "the preprocessor cannot compare versions"
#endif

TEST(Version, MacrosAgree)
{
  EXPECT_EQ(VTKIRRADIANCE_VERSION,
    std::to_string(VTKIRRADIANCE_MAJOR_VERSION) + "." +
      std::to_string(VTKIRRADIANCE_MINOR_VERSION) + "." +
      std::to_string(VTKIRRADIANCE_PATCH_VERSION));
}

TEST(Version, NumbersRiseWithVersions)
{
  static_assert(VTKIRRADIANCE_VERSION_CHECK(0, 1, 1) > VTKIRRADIANCE_VERSION_CHECK(0, 1, 0));
  static_assert(VTKIRRADIANCE_VERSION_CHECK(0, 2, 0) > VTKIRRADIANCE_VERSION_CHECK(0, 1, 20261231));
  static_assert(
    VTKIRRADIANCE_VERSION_CHECK(1, 0, 0) > VTKIRRADIANCE_VERSION_CHECK(0, 99, 20261231));
}
