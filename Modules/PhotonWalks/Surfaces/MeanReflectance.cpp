// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/MeanReflectance.h"

namespace irradiance
{

double meanReflectance(const SceneObject& object)
{
  const Material& material = *object.material;
  const std::vector<Triangle>& triangles = object.body->mesh().triangles();
  double area = 0, reflected = 0;
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
  {
    const double its = triangles[i].area();
    for (int band = 0; band < material.bands; ++band)
    {
      const double specular = material.isSpecular() ? material.specularOf(i, band) : 0;
      reflected += its * (material.reflectanceOf(i, band) + specular) / material.bands;
    }
    area += its;
  }
  return area > 0 ? reflected / area : 0;
}

}
