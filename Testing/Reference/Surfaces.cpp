// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces.h"

#include <algorithm>

namespace pathtracedroom
{

using namespace irradiance;

Spectrum spectrumOf(const Material& material, const std::vector<double>& values, std::size_t cell)
{
  Spectrum spectrum = Spectrum::Zero();
  const auto bands = static_cast<std::size_t>(material.bands);
  std::copy_n(values.data() + cell * bands, bands, spectrum.begin());
  return spectrum;
}

Spectrum exitanceOf(const SceneObject& object, std::size_t cell)
{
  Spectrum spectrum = Spectrum::Zero();
  if (const double* const exitance = object.exitanceOf(cell))
  {
    std::copy_n(exitance, object.emission->bands, spectrum.begin());
  }
  return spectrum;
}

namespace
{

/**
 * A subpath continues with the largest reflectance of all bands as its probability, so that it
 * carries no more than what arrived, in any band. But where one band is reflected diffusely,
 * another one specularly, the two may make up more than 1; and between white walls it would never
 * end.
 */
void limitChances(PathVertex& vertex)
{
  constexpr double kMost = 0.99;
  const double sum = vertex.diffuseChance + vertex.specularChance;
  if (sum > kMost)
  {
    vertex.diffuseChance *= kMost / sum;
    vertex.specularChance *= kMost / sum;
  }
}

}

PathVertex vertexOn(const SceneObjects& objects, const TriangleId& id, const SurfacePoint& point)
{
  const Material& material = *objects[id.object].material;
  const std::size_t cell = material.cellOfTriangle[id.triangle];
  PathVertex vertex = surfaceVertex(id, point);
  if (point.isFront)
  {
    vertex.exitance = exitanceOf(objects[id.object], cell);
  }
  vertex.diffuse = spectrumOf(material, material.reflectance, cell);
  vertex.diffuseChance = vertex.diffuse.maxCoeff();
  if (material.isSpecular(cell))
  {
    vertex.specular = spectrumOf(material, material.specularReflectance, cell);
    vertex.specularChance = vertex.specular.maxCoeff();
    vertex.lobe = &material.lobeOf(cell);
  }
  limitChances(vertex);
  return vertex;
}

}
