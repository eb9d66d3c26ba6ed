// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/SceneHash.h"

namespace irradiance
{

namespace
{

void add(const TriangleMesh& mesh, Hash& hash)
{
  hash.add(mesh.size());
  for (const Triangle& triangle : mesh.triangles())
  {
    hash.add(triangle.a, triangle.b, triangle.c);
  }
}

void add(const Material& material, Hash& hash)
{
  hash.add(material.bands, material.cellOfTriangle, material.reflectance,
    material.specularReflectance, material.phongExponent, material.diffuseTransmittance,
    material.specularTransmittance, material.refractiveIndex, material.internalTransmittance);
}

void add(const Emission& emission, Hash& hash)
{
  hash.add(emission.exitance, emission.groups, emission.group, emission.luminaireOfCell);
  for (const Luminaire& lamp : emission.luminaires)
  {
    hash.add(lamp.axis, lamp.reference, lamp.flux, lamp.faces, lamp.intensity->integral());
  }
  for (const PointSource& source : emission.points)
  {
    hash.add(source.position, source.flux, source.cell);
  }
}

}

void addScene(const SceneObjects& objects, const SceneObjects* known, Hash& hash)
{
  hash.add(objects.size(), objects.sky != nullptr);
  if (const Sky* const sky = objects.sky.get(); sky && !(known && known->sky == objects.sky))
  {
    hash.add(sky->radiance, sky->polarAngles, sky->azimuths, sky->bandWeights, sky->towardsSun,
      sky->sunIrradiance, sky->sunRadius, sky->lit.lower, sky->lit.upper);
  }
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    const SceneObject& object = objects[i];
    const SceneObject* before = known && i < known->size() ? &(*known)[i] : nullptr;
    for (int row = 0; row < 3; ++row)
    {
      hash.add(Vector3(object.worldFromObject.linear.row(row)));
    }
    hash.add(object.worldFromObject.translation, object.isPresent);
    if (!before || before->body != object.body)
    {
      add(object.body->mesh(), hash);
    }
    if (!before || before->material != object.material)
    {
      add(*object.material, hash);
    }
    if (object.emission && (!before || before->emission != object.emission))
    {
      add(*object.emission, hash);
    }
  }
}

}
