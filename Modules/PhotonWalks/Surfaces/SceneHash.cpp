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
    hash.add(triangle.a);
    hash.add(triangle.b);
    hash.add(triangle.c);
  }
}

void add(const Material& material, Hash& hash)
{
  hash.add(material.bands);
  hash.add(material.cellOfTriangle);
  hash.add(material.reflectance);
  hash.add(material.specularReflectance);
  hash.add(material.phongExponent);
}

void add(const Emission& emission, Hash& hash)
{
  hash.add(emission.exitance);
  hash.add(emission.groups);
  for (const PointSource& source : emission.points)
  {
    hash.add(source.position);
    hash.add(source.flux);
    hash.add(source.cell);
  }
}

}

void addScene(const SceneObjects& objects, const SceneObjects* known, Hash& hash)
{
  hash.add(objects.size());
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    const SceneObject& object = objects[i];
    const SceneObject* before = known && i < known->size() ? &(*known)[i] : nullptr;
    for (int row = 0; row < 3; ++row)
    {
      hash.add(Vector3(object.worldFromObject.linear.row(row)));
    }
    hash.add(object.worldFromObject.translation);
    hash.add(object.isPresent);
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
