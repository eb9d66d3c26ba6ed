// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Surfaces/Power.h"
#include "Surfaces/SceneObjects.h"

#include <memory>
#include <vector>

namespace irradiance
{

/// What the objects of a scene emit, by group of lamps, see Emission::groups. What does not change
/// keeps its address.
class SceneLamps
{
public:
  void update(const SceneObjects& objects);

  /// The largest exitance or flux of a group in each band; 0 if it has no lamps that are there.
  Bands brightest(std::uint32_t group) const
  {
    Bands most{};
    for (const OfObject& object : objects_)
    {
      if (object.isPresent && group < object.brightest.size())
      {
        most = larger(most, object.brightest[group]);
      }
    }
    return most;
  }
  /// See SceneObject::lampCells.
  const std::shared_ptr<const std::vector<bool>>& lampCellsOf(std::uint32_t object) const
  {
    return objects_[object].lampCells;
  }

private:
  struct OfObject
  {
    std::shared_ptr<const Emission> emission; ///< of which the rest is known
    bool isPresent = false;
    std::vector<Bands> brightest; ///< by group
    std::shared_ptr<const std::vector<bool>> lampCells;
  };

  std::vector<OfObject> objects_;
};

/// The lamps of one group in a scene.
class GroupLamps
{
public:
  /// All objects, but no other lamps shine, and these are divided by `scale` in each band. What is
  /// the same as before keeps its address. `scene`: all lamps; null: there are no others. `hasSky`:
  /// the group has the sky.
  SceneObjects only(const SceneObjects& objects, const SceneLamps* scene, std::uint32_t group,
    const Bands& scale, bool hasSky);

private:
  struct Part
  {
    std::shared_ptr<const Emission> whole, part;
    Bands scale{};
  };

  std::vector<Part> parts_; ///< by object
};

}
