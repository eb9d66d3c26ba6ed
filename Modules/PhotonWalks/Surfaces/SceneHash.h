// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Surfaces/SceneObjects.h"

#include <cstring>

namespace irradiance
{

/// A hash of numbers in their order (FNV-1a, by words of 64 bits).
class Hash
{
public:
  template <class Number>
  void add(Number number)
  {
    static_assert(std::is_arithmetic_v<Number> && sizeof(Number) <= sizeof(std::uint64_t));
    std::uint64_t word = 0;
    std::memcpy(&word, &number, sizeof(number));
    value_ = (value_ ^ word) * 0x100000001b3u;
    value_ ^= value_ >> 32;
  }
  template <class Number>
  void add(const std::vector<Number>& numbers)
  {
    add(numbers.size());
    for (const Number& number : numbers)
    {
      add(number);
    }
  }
  void add(const Vector3& vector)
  {
    for (const double coordinate : { vector[0], vector[1], vector[2] })
    {
      add(coordinate);
    }
  }

  template <class First, class Second, class... Rest>
  void add(const First& first, const Second& second, const Rest&... rest)
  {
    add(first);
    add(second);
    (add(rest), ...);
  }

  std::uint64_t value() const { return value_; }

private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

inline void addTo(Hash& hash, const TriangleMesh& mesh)
{
  hash.add(mesh.size());
  for (const Triangle& triangle : mesh.triangles())
  {
    hash.add(triangle.a, triangle.b, triangle.c);
  }
}

inline void addTo(Hash& hash, const Material& material)
{
  hash.add(material.bands, material.cellOfTriangle, material.reflectance,
    material.specularReflectance, material.phongExponent, material.diffuseTransmittance,
    material.specularTransmittance, material.refractiveIndex, material.internalTransmittance);
}

inline void addTo(Hash& hash, const Emission& emission)
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

/// Adds a frame: equal frames give equal hashes, whatever the addresses. What `known` has too, at
/// the same address, is left out; null: nothing is.
inline void addScene(const SceneObjects& objects, const SceneObjects* known, Hash& hash)
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
      addTo(hash, object.body->mesh());
    }
    if (!before || before->material != object.material)
    {
      addTo(hash, *object.material);
    }
    if (object.emission && (!before || before->emission != object.emission))
    {
      addTo(hash, *object.emission);
    }
  }
}

}
