// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_EnergySums_h
#define irradiance_EnergySums_h

#include <array>
#include <vector>

class vtkFieldData;

namespace irradiance
{

/// The powers of vtkIrradianceFilter's field data, summed up over time.
class EnergySums
{
public:
  /// Adds the powers of a time. Field data without them, or without all of them, end the sums: then
  /// nothing is known of the whole.
  void add(vtkFieldData* fields, double weight);
  /// Appends the sums over later times.
  void append(const EnergySums& next);
  /// Adds `EmittedEnergy`, `AbsorbedEnergy`, `EscapedEnergy` (J) and `PowerBalanceError`, if known.
  void write(vtkFieldData* fields) const;

private:
  bool isKnown_ = true;
  std::array<std::vector<double>, 3> energies_; ///< emitted, absorbed, escaped; J of each band
  double worstBalance_ = 0;
};

}

#endif
