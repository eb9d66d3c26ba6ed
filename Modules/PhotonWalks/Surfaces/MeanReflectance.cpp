// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/MeanReflectance.h"

namespace irradiance
{

double meanReflectance(const SceneObject& object)
{
  const std::vector<Triangle>& triangles = object.body->mesh().triangles();
  double area = 0, reflected = 0;
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
  {
    const double its = triangles[i].area();
    reflected += its * object.material->reflectedOf(i);
    area += its;
  }
  return area > 0 ? reflected / area : 0;
}

}
