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

/// A subpath continues with the largest reflectance of all bands as its probability. So it never
/// carries more than what arrived, in any band.
PathVertex vertexOn(const SceneObjects& objects, const TriangleId& id, const SurfacePoint& point)
{
  const Material& material = *objects[id.object].material;
  const std::size_t cell = material.cellOfTriangle[id.triangle];
  PathVertex vertex = surfaceVertex(id, point);
  if (point.isFront && !material.exitance.empty())
  {
    vertex.exitance = spectrumOf(material, material.exitance, cell);
  }
  vertex.diffuse = spectrumOf(material, material.reflectance, cell);
  vertex.diffuseChance = vertex.diffuse.maxCoeff();
  return vertex;
}

}
