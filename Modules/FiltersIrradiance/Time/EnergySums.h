// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Data/ArrayNames.h"
#include "Data/NamedArray.h"
#include "Geometry/Vector.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace irradiance
{

/// The powers of vtkIrradianceFilter's field data, summed up over time.
class EnergySums
{
public:
  /// Adds the powers of a time. Field data without them, or without all of them, end the sums: then
  /// nothing is known of the whole.
  void add(vtkFieldData* fields, double weight)
  {
    std::array<vtkDataArray*, 3> powers{};
    for (std::size_t i = 0; i < powers.size(); ++i)
    {
      powers[i] = fields->GetArray(kPowers[i]);
      isKnown_ = isKnown_ && powers[i] && powers[i]->GetNumberOfTuples() == 1 &&
        powers[i]->GetNumberOfComponents() == powers[0]->GetNumberOfComponents();
    }
    const int bands = isKnown_ ? powers[0]->GetNumberOfComponents() : 0;
    makeRoomFor(static_cast<std::size_t>(bands));
    for (int band = 0; band < bands; ++band)
    {
      const auto power = [&](std::size_t i) { return powers[i]->GetComponent(0, band); };
      const Vector3 watts(power(0), power(1), power(2));
      energies_[static_cast<std::size_t>(band)] += weight * watts;
      const double off = std::abs(watts[0] - watts[1] - watts[2]);
      worstBalance_ = off > 0 ? std::max(worstBalance_, off / watts[0]) : worstBalance_;
    }
  }
  /// Appends the sums over later times.
  void append(const EnergySums& next)
  {
    isKnown_ = isKnown_ && next.isKnown_;
    worstBalance_ = std::max(worstBalance_, next.worstBalance_);
    makeRoomFor(next.energies_.size());
    for (std::size_t band = 0; band < next.energies_.size(); ++band)
    {
      energies_[band] += next.energies_[band];
    }
  }
  /// Adds `EmittedEnergy`, `AbsorbedEnergy`, `EscapedEnergy` (J) and `PowerBalanceError`, if known.
  void write(vtkFieldData* fields) const
  {
    if (!isKnown_ || energies_.empty())
    {
      return;
    }
    for (int i = 0; i < 3; ++i)
    {
      std::vector<double> energy;
      for (const Vector3& ofBand : energies_)
      {
        energy.push_back(ofBand[i]);
      }
      addTuple<vtkDoubleArray>(fields, kEnergies[static_cast<std::size_t>(i)], energy);
    }
    addTuple<vtkDoubleArray>(fields, "PowerBalanceError", { worstBalance_ });
  }

private:
  static constexpr std::array<const char*, 3> kPowers{ kEmittedPower, kAbsorbedPower,
    kEscapedPower };
  static constexpr std::array<const char*, 3> kEnergies{ "EmittedEnergy", "AbsorbedEnergy",
    "EscapedEnergy" };

  void makeRoomFor(std::size_t bands)
  {
    energies_.resize(std::max(bands, energies_.size()), Vector3::Zero());
  }

  bool isKnown_ = true;
  std::vector<Vector3> energies_; ///< emitted, absorbed, escaped; J of each band
  double worstBalance_ = 0;
};

}
