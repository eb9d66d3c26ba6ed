// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Scenes.h"

namespace irradiance::test
{

/// What goes through a thin sheet.
struct Through
{
  double diffuse = 0;
  std::array<double, 3> straight{};
  double index = 1, internal = 1; ///< of a pane
};

inline Through straight(double part)
{
  return { 0, { part, part, part } };
}

/// Makes sheets of the cells from `first` on.
inline void makeSheets(SceneObject& object, std::size_t first, const Through& through)
{
  Material material = *object.material;
  const auto bands = static_cast<std::size_t>(material.bands);
  const std::size_t all = material.reflectance.size();
  std::vector<double> diffuse = material.diffuseTransmittance,
                      straight = material.specularTransmittance, index = material.refractiveIndex,
                      internal = material.internalTransmittance;
  diffuse.resize(all);
  straight.resize(all);
  index.resize(material.numberOfCells, 1);
  internal.resize(all, 1);
  for (std::size_t slot = first * bands; slot < all; ++slot)
  {
    diffuse[slot] = through.diffuse;
    straight[slot] = through.straight[slot % bands];
    internal[slot] = through.internal;
    index[slot / bands] = through.index;
  }
  material.setSheets(diffuse, straight, index, internal);
  object.material = std::make_shared<Material>(std::move(material));
}

/// A level square around the origin, n x n cells.
inline SceneObject sheet(
  double size, int n, const Look& look, const Through& through, int bands = 1)
{
  ObjectBuilder builder(bands);
  builder.addQuad({ -size / 2, -size / 2, 0 }, { size, 0, 0 }, { 0, size, 0 }, n, n, look);
  SceneObject object = builder.build();
  makeSheets(object, 0, through);
  return object;
}

/// A room with a pane below its lamp and a diffusing partition; a pane, a sleeve of which one can
/// see into, and a ball can move. `specular`: what the sleeve reflects so.
inline SceneObjects glazedRoom(int bands = 1, double specular = 0.1)
{
  ObjectBuilder room = litRoom(3, bands);
  const std::size_t first = room.numberOfCells();
  room.addQuad({ 1, 1.4, 2.5 }, { 1.6, 0, 0 }, { 0, 1.2, 0 }, 2, 2, grey(0));
  const std::size_t partition = room.numberOfCells();
  room.addQuad({ 2.2, 0, 0 }, { 0, 4, 0 }, { 0, 0, 2 }, 3, 3, grey(0.2));
  SceneObject fixed = room.build();
  makeSheets(fixed, first, specular > 0 ? Through{ 0, {}, 1.5, 0.97 } : straight(0.8));
  makeSheets(fixed, partition, { 0.4, { 0.3, 0.3, 0.3 } });
  ObjectBuilder sleeve(bands);
  Look look = grey(0.1);
  look.specular = { specular, specular, specular };
  look.exponent = 20;
  sleeve.addBox(box({ -0.4, -0.4, -0.4 }, { 0.4, 0.4, 0.4 }), 1, look);
  SceneObject around = sleeve.build(shift({ 3, 1, 0.6 }));
  makeSheets(around, 0, { 0.1, { 0.6, 0.3, 0.5 } });
  SceneObject pane = sheet(1.2, 2, grey(0),
    specular > 0 ? Through{ 0, {}, 1.6, 0.9 } : Through{ 0.2, { 0.7, 0.7, 0.7 } }, bands);
  pane.worldFromObject = shift({ 1.5, 1.5, 1.2 });
  return { fixed, { pane, around, ball({ 1, 2.5, 0.6 }, 0.3, 4, grey(0.5), bands) } };
}

}
