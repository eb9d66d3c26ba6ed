// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_test_MovingScene_h
#define irradiance_test_MovingScene_h

#include "TestScenes.h"

#include "../RayCasting/RandomVectors.h"

namespace irradiance::test
{

/**
 * A room of 4 x 4 x 4 m with a lamp and a point light, and six dynamic objects: a rigid box, a
 * sheared sphere, a mirrored box that sticks through a wall, a sphere that leaves the room and
 * comes back, one that deforms, and one with isFlattened set. In each frame some of them rest. If
 * `isGlossy`, the walls have a wide lobe, and the objects are mirrors in part.
 */
class MovingScene
{
public:
  static constexpr int kObjects = 6;

  MovingScene(int bands, bool isClosed, unsigned seed, bool isGlossy = false)
    : bands_(bands)
    , random_(seed)
  {
    if (isGlossy)
    {
      wallLook_.specular = { 0.3, 0.2, 0.4 };
      wallLook_.exponent = 12;
      objectLook_.specular = { 0.15, 0.7, 0.2 };
    }
    ObjectBuilder room(bands);
    const Box walls = box({ 0, 0, 0 }, { 4, 4, 4 });
    for (int side = 0; side < (isClosed ? 6 : 5); ++side)
    {
      room.addSide(walls, side, 3, wallLook_, true);
    }
    room.addQuad({ 1, 1, 3.75 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1, { {}, { 3, 2, 1 } });
    room.addPointLight({ 3, 1, 2 }, 2);
    objects_.staticObject = room.build();
    for (int i = 0; i < kObjects; ++i)
    {
      objects_.dynamicObjects.push_back(i == 4 ? deformed() : shape(i));
    }
    for (int i = 0; i < kObjects; ++i)
    {
      move(i);
    }
  }

  const SceneObjects& objects() const { return objects_; }

  /// Every object moves with probability 1/2.
  void nextFrame()
  {
    for (int i = 0; i < kObjects; ++i)
    {
      if (random_.engine() % 2 == 0)
      {
        move(i);
      }
    }
  }

private:
  SceneObject shape(int i)
  {
    ObjectBuilder builder(bands_);
    if (i % 2 == 0)
    {
      builder.addBox(box({ -0.5, -0.4, -0.3 }, { 0.5, 0.4, 0.3 }), 2, objectLook_);
    }
    else
    {
      builder.addSphere({ 0, 0, 0 }, 0.5, 4, objectLook_);
    }
    return builder.build({}, i == 5);
  }

  /// The same cells with other points.
  SceneObject deformed()
  {
    if (!deformingSurface_)
    {
      deformingSurface_ = shape(1).material;
    }
    ObjectBuilder builder(bands_);
    builder.addSphere({ 0, 0, 0 }, random_.uniform(0.2, 0.6), 4, objectLook_);
    SceneObject object = builder.build();
    object.material = deformingSurface_;
    return object;
  }

  void move(int i)
  {
    SceneObject& object = objects_.dynamicObjects[static_cast<std::size_t>(i)];
    AffineMap& pose = object.worldFromObject;
    pose.linear = random_.rotation();
    pose.translation = Vector3(2, 2, 2) + 1.3 * random_.inCube();
    switch (i)
    {
      case 1:
        pose.linear(0, 1) += random_.uniform(); // shear
        pose.linear.col(2) *= random_.uniform(0.5, 1.5);
        break;
      case 2:
        pose.linear.col(0) *= -1; // mirrored
        pose.translation[1] = random_.uniform(-0.2, 0.2);
        break;
      case 3:
        pose.translation[0] += random_.engine() % 2 == 0 ? 100 : 0;
        break;
      case 4:
        object = deformed();
        object.worldFromObject = shift(Vector3(2, 2, 2) + random_.inCube());
        break;
      default:
        break;
    }
  }

  Look wallLook_{ { 0.5, 0.7, 0.3 }, {} };
  Look objectLook_{ { 0.8, 0.2, 0.6 }, {} };
  int bands_;
  RandomVectors random_;
  SceneObjects objects_;
  std::shared_ptr<const Material> deformingSurface_;
};

}

#endif
