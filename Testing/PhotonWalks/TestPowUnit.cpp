// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/ElementaryFunctions.h"

#include "Kit.h"

namespace irradiance::test
{
namespace
{

TEST(PowUnit, IsWithinItsErrorOfTheLibrarysLongDouble)
{
  RandomVectors random(11);
  for (int trial = 0; trial < 300000; ++trial)
  {
    const double base = trial % 3 == 0 ? 1 - random.powerOfTwo(-50, -1)
                                       : std::abs(random.uniform()) * random.powerOfTwo(-32, 0);
    const double exponent = std::abs(random.uniform()) * random.powerOfTwo(-40, 20);
    if (base <= 0)
    {
      continue;
    }
    const long double exact = std::pow(static_cast<long double>(base), exponent);
    const double power = powUnit(base, exponent);
    if (exact < 0x1p-995L)
    {
      ASSERT_LE(power, 0x1p-990);
      continue;
    }
    ASSERT_LE(std::abs(power - exact), 0x1p-50L * exact * (1 - std::log(exact)))
      << base << " to the power of " << exponent;
  }
}

TEST(PowUnit, EndsAreExact)
{
  EXPECT_EQ(powUnit(1, 0), 1);
  EXPECT_EQ(powUnit(1, 1e300), 1);
  EXPECT_EQ(powUnit(0x1p-33, 0), 1);
  EXPECT_EQ(powUnit(0.5, 1e6), 0);
}

}
}
