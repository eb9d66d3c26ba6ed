// SPDX-License-Identifier: BSD-3-Clause
#ifndef SharedReference_h
#define SharedReference_h

#include "Measuring/CellField.h"

#include <cstdint>
#include <functional>

/**
 * The right answer by two programs together: the mean of many runs of both, each with a seed of its
 * own. It favours neither, and as each half is known apart, so is its own error.
 */
class SharedReference
{
public:
  /// W/m2 of each cell.
  using Shoot = std::function<CellField(std::uint64_t seed)>;

  /// Throws std::runtime_error if the programs differ by more than their noise explains; a
  /// thousandth is allowed, which is more than floats miss at edges.
  SharedReference(const CellField& areas, const Shoot& ours, const Shoot& theirs);

  /// Of a run with another seed: the mean square difference from the truth over the area, in units
  /// of the square of the mean irradiance. The error of the reference is taken off, so it is right
  /// on the average of many runs; in one run it may be negative where the reference is poor.
  double squaredError(const CellField& field) const;

  /// Mean irradiance, ours / theirs.
  double ratio() const { return ratio_; }
  /// The RMS difference of the two means, in units of what the noise of both leads to expect.
  double overNoise() const { return overNoise_; }

private:
  double squareOf(const CellField& difference) const;

  CellField areas_, reference_;
  double ownSquaredError_, ratio_, overNoise_;
};

#endif
