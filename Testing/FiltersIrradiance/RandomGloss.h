// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RandomChoices.h"

#include <algorithm>
#include <limits>

/// Specular reflectance and Phong exponents, as random as they may be.
namespace RandomModels
{

/// From the widest lobe to the narrowest, and a mirror.
inline double RandomExponent(RandomNumbers& random)
{
  static const double exponents[] = { 0, 0.5, 1, 7, 30, 1e3, 1e4, 1e30,
    std::numeric_limits<double>::infinity() };
  return exponents[random.Below(9)];
}

/// Sets the array, or cell by cell, or removes it: then all of the cells are mirrors.
inline void SetRandomExponents(RandomNumbers& random, vtkPolyData* mesh)
{
  constexpr const char* name = "PhongExponent";
  if (Chance(random, 3))
  {
    mesh->GetCellData()->RemoveArray(name);
    return;
  }
  SetCellValues(mesh, name, { RandomExponent(random) });
  vtkDataArray* array = mesh->GetCellData()->GetArray(name);
  for (vtkIdType cell = 0; Chance(random, 2) && cell < array->GetNumberOfTuples(); ++cell)
  {
    array->SetComponent(cell, 0, RandomExponent(random));
  }
}

inline double ValueOf(vtkDataArray* array, vtkIdType cell, int band)
{
  return array->GetComponent(cell, std::min(band, array->GetNumberOfComponents() - 1));
}

/// Lowers the specular reflectance to what the diffuse one leaves of `most`; whether it had to.
inline bool LimitGloss(
  vtkPolyData* mesh, const char* diffuseName, const char* specularName, double otherwise)
{
  constexpr double most = 0.97;
  vtkDataArray* specular = mesh->GetCellData()->GetArray(specularName);
  vtkDataArray* diffuse = mesh->GetCellData()->GetArray(diffuseName);
  bool isLimited = false;
  for (vtkIdType cell = 0; specular && cell < specular->GetNumberOfTuples(); ++cell)
  {
    // With more bands of the diffuse one, the band of one value has to suit all of them.
    double left[3] = { 1, 1, 1 };
    for (int band = 0; band < 3; ++band)
    {
      double& room = left[std::min(band, specular->GetNumberOfComponents() - 1)];
      room =
        std::min(room, std::max(0.0, most - (diffuse ? ValueOf(diffuse, cell, band) : otherwise)));
    }
    for (int band = 0; band < specular->GetNumberOfComponents(); ++band)
    {
      if (specular->GetComponent(cell, band) > left[band])
      {
        specular->SetComponent(cell, band, left[band]);
        isLimited = true;
      }
    }
  }
  if (isLimited)
  {
    specular->Modified();
  }
  return isLimited;
}

}
