// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_EnergySums_h
#define irradiance_EnergySums_h

#include "Data/ArrayNames.h"
#include "Data/NamedArray.h"

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
    if (!isKnown_)
    {
      return;
    }
    const auto bands = static_cast<std::size_t>(powers[0]->GetNumberOfComponents());
    const auto power = [&](std::size_t i, std::size_t band) {
      return powers[i]->GetComponent(0, static_cast<int>(band));
    };
    for (std::size_t i = 0; i < powers.size(); ++i)
    {
      energies_[i].resize(std::max(bands, energies_[i].size()));
      for (std::size_t band = 0; band < bands; ++band)
      {
        energies_[i][band] += weight * power(i, band);
      }
    }
    for (std::size_t band = 0; band < bands; ++band)
    {
      const double off = std::abs(power(0, band) - power(1, band) - power(2, band));
      worstBalance_ = off > 0 ? std::max(worstBalance_, off / power(0, band)) : worstBalance_;
    }
  }
  /// Appends the sums over later times.
  void append(const EnergySums& next)
  {
    isKnown_ = isKnown_ && next.isKnown_;
    worstBalance_ = std::max(worstBalance_, next.worstBalance_);
    for (std::size_t i = 0; i < energies_.size(); ++i)
    {
      energies_[i].resize(std::max(energies_[i].size(), next.energies_[i].size()));
      for (std::size_t band = 0; band < next.energies_[i].size(); ++band)
      {
        energies_[i][band] += next.energies_[i][band];
      }
    }
  }
  /// Adds `EmittedEnergy`, `AbsorbedEnergy`, `EscapedEnergy` (J) and `PowerBalanceError`, if known.
  void write(vtkFieldData* fields) const
  {
    if (!isKnown_ || energies_[0].empty())
    {
      return;
    }
    for (std::size_t i = 0; i < kEnergies.size(); ++i)
    {
      addTuple<vtkDoubleArray>(fields, kEnergies[i], energies_[i]);
    }
    addTuple<vtkDoubleArray>(fields, "PowerBalanceError", { worstBalance_ });
  }

private:
  static constexpr std::array<const char*, 3> kPowers{ kEmittedPower, kAbsorbedPower,
    kEscapedPower };
  static constexpr std::array<const char*, 3> kEnergies{ "EmittedEnergy", "AbsorbedEnergy",
    "EscapedEnergy" };

  bool isKnown_ = true;
  std::array<std::vector<double>, 3> energies_; ///< emitted, absorbed, escaped; J of each band
  double worstBalance_ = 0;
};

}

#endif
