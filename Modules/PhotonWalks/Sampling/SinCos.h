// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SinCos_h
#define irradiance_SinCos_h

namespace irradiance
{

/**
 * Sine and cosine of an angle given in turns. Our own, as the libraries of different systems differ
 * in the last bits, and bits of directions decide which way walks go. Without branches, so that a
 * loop over many becomes SIMD.
 */
struct SinCos
{
  double sine, cosine;

  /// 0 <= `turns` <= 1. Both results are within 2^-51.
  __attribute__((always_inline)) explicit SinCos(double turns)
  {
    // The nearest quarter turn, and the angle from there, exact in turns: at most an eighth of one.
    const double halfMore = 4 * turns + 0.5;
    const int quarter = static_cast<int>(halfMore);
    const double x = (turns - 0.25 * quarter) * 6.283185307179586;
    const double z = x * x;
    // Taylor's series: what is left out is below (pi / 4)^17 / 17!.
    const double s = x +
      x * z *
        (-1 / 6.0 +
          z *
            (1 / 120.0 +
              z *
                (-1 / 5040.0 +
                  z *
                    (1 / 362880.0 +
                      z *
                        (-1 / 39916800.0 + z * (1 / 6227020800.0 + z * (-1 / 1307674368000.0)))))));
    const double c = 1 -
      z *
        (1 / 2.0 -
          z *
            (1 / 24.0 -
              z *
                (1 / 720.0 -
                  z *
                    (1 / 40320.0 -
                      z *
                        (1 / 3628800.0 -
                          z *
                            (1 / 479001600.0 -
                              z * (1 / 87178291200.0 - z * (1 / 20922789888000.0))))))));
    const double swapped = quarter & 1; // 0 or 1: one of the two products is exact, the other 0
    const double signOfSine = 1 - (quarter & 2), signOfCosine = 1 - (quarter + 1 & 2);
    sine = signOfSine * ((1 - swapped) * s + swapped * c);
    cosine = signOfCosine * ((1 - swapped) * c + swapped * s);
  }
};

}

#endif
