// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Surfaces/PhongLobe.h"
#include "Surfaces/Power.h"
#include "Surfaces/ThinSheet.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace irradiance
{

/// How cells of an object reflect, and let light through. Arrays hold one value per cell and band,
/// cell-major.
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
  /// 0..1; with what is reflected at most 1. Empty: none. Set by setSheets().
  std::vector<double> diffuseTransmittance, specularTransmittance;
  /// Of each cell: one above 1 is a pane, see Pane. Empty: none is. Set by setSheets().
  std::vector<double> refractiveIndex;
  std::vector<double> internalTransmittance; ///< of panes; 1 where setSheets() is told none
  /// The first cell of each input, if there are several.
  std::vector<std::size_t> firstCellOfPart;

  /// All arrays before it must be complete.
  void setSpecular(std::vector<double> specular, std::vector<double> exponents)
  {
    specularReflectance = std::move(specular);
    phongExponent = std::move(exponents);
    derive();
  }

  /// After setSpecular(). Each may be empty. A pane needs none but the last two: what it reflects
  /// and lets through follows from them, and for light from all directions stands in the arrays.
  void setSheets(std::vector<double> diffuse, std::vector<double> specular,
    std::vector<double> index, std::vector<double> internal)
  {
    diffuseTransmittance = std::move(diffuse);
    specularTransmittance = std::move(specular);
    refractiveIndex = std::move(index);
    internalTransmittance = std::move(internal);
    internalTransmittance.resize(refractiveIndex.empty() ? 0 : reflectance.size(), 1.0);
    std::map<std::pair<double, double>, PaneLight> lights; // of what is alike
    for (std::size_t cell = 0; cell < refractiveIndex.size(); ++cell)
    {
      for (int band = 0; isPane(cell) && band < bands; ++band)
      {
        const std::size_t slot = slotOf(cell, band);
        specularReflectance.resize(reflectance.size());
        specularTransmittance.resize(reflectance.size());
        phongExponent.resize(numberOfCells, kInfinity);
        phongExponent[cell] = kInfinity;
        reflectance[slot] = 0;
        if (!diffuseTransmittance.empty())
        {
          diffuseTransmittance[slot] = 0;
        }
        const auto [known, isNew] =
          lights.try_emplace({ refractiveIndex[cell], internalTransmittance[slot] });
        PaneLight& light = known->second;
        light =
          isNew ? paneInDiffuseLight(refractiveIndex[cell], internalTransmittance[slot]) : light;
        specularReflectance[slot] = light.reflected;
        specularTransmittance[slot] = light.transmitted;
      }
    }
    derive();
  }

  bool reflectsDiffusely(std::size_t cell) const { return isPositive(reflectance, cell); }
  bool isSpecular() const { return !specularReflectance.empty(); }
  bool isSpecular(std::size_t cell) const
  {
    return isSpecular() && isPositive(specularReflectance, cell);
  }
  /// Only if isSpecular().
  const PhongLobe& lobeOf(std::size_t cell) const { return lobes_[lobeOfCell_[cell]]; }
  bool isPane(std::size_t cell) const
  {
    return !refractiveIndex.empty() && refractiveIndex[cell] > 1;
  }
  bool transmitsDiffusely(std::size_t cell) const
  {
    return !diffuseTransmittance.empty() && isPositive(diffuseTransmittance, cell);
  }
  bool transmitsStraight(std::size_t cell) const
  {
    return !specularTransmittance.empty() && isPositive(specularTransmittance, cell);
  }
  bool transmits(std::size_t cell) const
  {
    return transmitsDiffusely(cell) || transmitsStraight(cell);
  }
  /// Whether the light of all bands goes straight through alike: so rays that look for lamps do.
  bool isClear(std::size_t cell) const
  {
    if (!transmitsStraight(cell))
    {
      return false;
    }
    const auto first = specularTransmittance.begin() + static_cast<std::ptrdiff_t>(slotOf(cell, 0));
    return std::all_of(first, first + bands, [&](double value) { return value == *first; });
  }
  /// Whether cells may do more than to reflect diffusely.
  bool hasOtherWays() const { return isSpecular() || hasSheets(); }
  bool hasSheets() const { return !diffuseTransmittance.empty() || !specularTransmittance.empty(); }
  /// The parts of the light that leave in each way, by band. `cosine`: of incidence; it matters for
  /// panes.
  std::array<Bands, kLeavings> partsOf(std::size_t cell, double cosine) const
  {
    std::array<Bands, kLeavings> parts{};
    const std::vector<double>* const arrays[kLeavings] = { &reflectance, &specularReflectance,
      &diffuseTransmittance, &specularTransmittance };
    for (int band = 0; band < bands; ++band)
    {
      const auto i = static_cast<std::size_t>(band);
      const std::size_t slot = slotOf(cell, band);
      for (std::size_t way = 0; way < (hasOtherWays() ? kLeavings : 1); ++way)
      {
        parts[way][i] = arrays[way]->empty() ? 0 : (*arrays[way])[slot];
      }
      if (isPane(cell))
      {
        const PaneLight light = pane(refractiveIndex[cell], internalTransmittance[slot], cosine);
        parts[static_cast<std::size_t>(Leaving::Specular)][i] = light.reflected;
        parts[static_cast<std::size_t>(Leaving::Straight)][i] = light.transmitted;
      }
    }
    return parts;
  }
  /// The part that leaves in one way.
  Bands partOf(Leaving way, std::size_t cell, double cosine) const
  {
    return partsOf(cell, cosine)[static_cast<std::size_t>(way)];
  }

  /// In one band, by cell: what is not absorbed, of panes at most.
  const std::vector<double>& surviving() const { return hasOtherWays() ? total_ : reflectance; }

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

  /// All that is not absorbed, the mean over the bands.
  double keptOf(std::uint32_t triangle) const
  {
    double sum = 0;
    for (int band = 0; band < bands; ++band)
    {
      sum += reflectanceOf(triangle, band) + (isSpecular() ? specularOf(triangle, band) : 0);
    }
    for (const std::vector<double>* through : { &diffuseTransmittance, &specularTransmittance })
    {
      for (int band = 0; !through->empty() && band < bands; ++band)
      {
        sum += (*through)[slotOf(cellOfTriangle[triangle], band)];
      }
    }
    return sum / bands;
  }

  /// Whether another material is of the same cells, which let the same light through; they may
  /// reflect otherwise.
  bool hasCellsOf(const Material& other) const
  {
    return this == &other ||
      (bands == other.bands && numberOfCells == other.numberOfCells &&
        cellOfTriangle == other.cellOfTriangle && firstCellOfPart == other.firstCellOfPart &&
        diffuseTransmittance == other.diffuseTransmittance &&
        specularTransmittance == other.specularTransmittance &&
        refractiveIndex == other.refractiveIndex &&
        internalTransmittance == other.internalTransmittance);
  }
  /// Whether a cell does with light what one of another material with as many bands does.
  bool actsAs(std::size_t cell, const Material& other, std::size_t its) const
  {
    if (isPane(cell) || other.isPane(its))
    {
      const auto first =
        internalTransmittance.begin() + static_cast<std::ptrdiff_t>(slotOf(cell, 0));
      return isPane(cell) && other.isPane(its) &&
        refractiveIndex[cell] == other.refractiveIndex[its] &&
        std::equal(first, first + bands,
          other.internalTransmittance.begin() + static_cast<std::ptrdiff_t>(slotOf(its, 0)));
    }
    return partsOf(cell, 1) == other.partsOf(its, 1) &&
      (!isSpecular(cell) || phongExponent[cell] == other.phongExponent[its]);
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
  std::size_t slotOf(std::size_t cell, int band) const
  {
    return cell * static_cast<std::size_t>(bands) + static_cast<std::size_t>(band);
  }
  void derive()
  {
    total_.clear();
    lobes_.clear();
    lobeOfCell_.clear();
    for (std::size_t i = 0; bands == 1 && hasOtherWays() && i < reflectance.size(); ++i)
    {
      double sum = reflectance[i];
      for (const auto* more :
        { &specularReflectance, &diffuseTransmittance, &specularTransmittance })
      {
        sum += more->empty() ? 0 : (*more)[i];
      }
      total_.push_back(isPane(i) ? 1 : std::min(sum, 1.0));
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
