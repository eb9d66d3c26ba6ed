// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Material.h"

#include <map>
#include <utility>

namespace irradiance
{

void Material::setSpecular(std::vector<double> specular, std::vector<double> exponents)
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

}
