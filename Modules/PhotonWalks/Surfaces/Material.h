// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Material_h
#define irradiance_Material_h

#include "Surfaces/PhongLobe.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace irradiance
{

/// How cells of an object reflect. Arrays hold one value per cell and band, cell-major.
struct Material
{
  int bands = 1; ///< 1 or 3
  std::size_t numberOfCells = 0;
  std::vector<std::uint32_t> cellOfTriangle;
  std::vector<double> reflectance; ///< diffuse, 0..1
  /// 0..1; with the diffuse one at most 1. Empty: none. Set by setSpecular().
  std::vector<double> specularReflectance;
  /// Of each cell, see PhongLobe: >= 0, infinite for a mirror. Empty: none. Set by setSpecular().
  std::vector<double> phongExponent;
  /// The first cell of each input, if there are several.
  std::vector<std::size_t> firstCellOfPart;

  /// All arrays before it must be complete.
  void setSpecular(std::vector<double> specular, std::vector<double> exponents)
  {
    specularReflectance = std::move(specular);
    phongExponent = std::move(exponents);
    total_.clear();
    lobes_.clear();
    lobeOfCell_.clear();
    for (std::size_t i = 0; bands == 1 && i < reflectance.size(); ++i)
    {
      total_.push_back(std::min(reflectance[i] + specularReflectance[i], 1.0));
    }
    std::map<double, std::uint32_t> known;
    for (std::size_t cell = 0; cell < phongExponent.size(); ++cell)
    {
      // A cell without a specular part needs no lobe of its own.
      const double exponent = isSpecular(cell) ? phongExponent[cell] : kInfinity;
      const auto [lobe, isNew] = known.emplace(exponent, static_cast<std::uint32_t>(lobes_.size()));
      if (isNew)
      {
        lobes_.emplace_back(exponent);
      }
      lobeOfCell_.push_back(lobe->second);
    }
  }

  bool reflectsDiffusely(std::size_t cell) const { return isPositive(reflectance, cell); }
  bool isSpecular() const { return !specularReflectance.empty(); }
  bool isSpecular(std::size_t cell) const
  {
    return isSpecular() && isPositive(specularReflectance, cell);
  }
  /// Only if isSpecular().
  const PhongLobe& lobeOf(std::size_t cell) const { return lobes_[lobeOfCell_[cell]]; }
  /// In one band, by cell: what is reflected in all.
  const std::vector<double>& totalReflectance() const
  {
    return isSpecular() ? total_ : reflectance;
  }

  double reflectanceOf(std::uint32_t triangle, int band) const
  {
    return reflectance[cellOfTriangle[triangle] * static_cast<std::size_t>(bands) +
      static_cast<std::size_t>(band)];
  }

  /// Only if isSpecular().
  double specularOf(std::uint32_t triangle, int band) const
  {
    return specularReflectance[cellOfTriangle[triangle] * static_cast<std::size_t>(bands) +
      static_cast<std::size_t>(band)];
  }

  /// Diffusely and specularly, the mean over the bands.
  double reflectedOf(std::uint32_t triangle) const
  {
    double sum = 0;
    for (int band = 0; band < bands; ++band)
    {
      sum += reflectanceOf(triangle, band) + (isSpecular() ? specularOf(triangle, band) : 0);
    }
    return sum / bands;
  }

  /// Whether another material is of the same cells, which may reflect otherwise.
  bool hasCellsOf(const Material& other) const
  {
    return this == &other ||
      (bands == other.bands && numberOfCells == other.numberOfCells &&
        cellOfTriangle == other.cellOfTriangle && firstCellOfPart == other.firstCellOfPart);
  }
  /// Whether a cell reflects as one of another material with as many bands does.
  bool reflectsAs(std::size_t cell, const Material& other, std::size_t its) const
  {
    const auto areSame = [&](const std::vector<double>& a, const std::vector<double>& b) {
      const auto first = a.begin() + static_cast<std::ptrdiff_t>(cell) * bands;
      return std::equal(first, first + bands, b.begin() + static_cast<std::ptrdiff_t>(its) * bands);
    };
    return areSame(reflectance, other.reflectance) && isSpecular(cell) == other.isSpecular(its) &&
      (!isSpecular(cell) ||
        (areSame(specularReflectance, other.specularReflectance) &&
          phongExponent[cell] == other.phongExponent[its]));
  }

  std::uint32_t partOfCell(std::size_t cell) const
  {
    return static_cast<std::uint32_t>(
      std::upper_bound(firstCellOfPart.begin(), firstCellOfPart.end(), cell) -
      firstCellOfPart.begin());
  }

  friend bool operator==(const Material& a, const Material& b)
  {
    return a.hasCellsOf(b) && a.reflectance == b.reflectance &&
      a.specularReflectance == b.specularReflectance && a.phongExponent == b.phongExponent;
  }

private:
  /// In some band.
  bool isPositive(const std::vector<double>& reflectances, std::size_t cell) const
  {
    const auto first =
      reflectances.begin() + static_cast<std::ptrdiff_t>(cell * static_cast<std::size_t>(bands));
    return std::any_of(first, first + bands, [](double rho) { return rho > 0; });
  }

  std::vector<double> total_;
  std::vector<PhongLobe> lobes_; ///< one for each exponent that occurs
  std::vector<std::uint32_t> lobeOfCell_;
};

}

#endif
