// SPDX-License-Identifier: BSD-3-Clause
#include "History/PointGrid.h"

#include "Kit.h"

// Law: the grid of an ordinary scene holds all of it; what is far away makes no grid coarse.

namespace irradiance::test
{
namespace
{

const Vector3 kAway(600, 0, 800); ///< 1 km
const Box kRoom = box({ 0, 0, 0 }, { 4, 4, 3 });

/// A room, a lamp and a ball that may move.
struct Room
{
  ObjectBuilder still;
  std::vector<SceneObject> dynamicObjects;
  Box lights;

  explicit Room(int cells = 1) { still.addBox(kRoom, cells, grey(0.5), true); }

  void addBall(const Vector3& place, double radius, int n)
  {
    dynamicObjects.push_back(ball(place, radius, n));
  }

  SceneObjects objects() const { return { still.build(), dynamicObjects }; }
  Box bounds() const
  {
    Box bounds = lights;
    const SceneObjects all = objects();
    for (std::uint32_t i = 0; i < all.size(); ++i)
    {
      bounds.add(all[i].worldBounds());
    }
    return bounds;
  }
  PointGrid grid() const { return pointGrid(objects(), bounds()); }
};

bool isSame(const PointGrid& a, const PointGrid& b)
{
  return a.center == b.center && a.step == b.step;
}

bool holds(const PointGrid& grid, const Box& box)
{
  return grid(box.lower).cwiseAbs().maxCoeff() <= PointGrid::kReach &&
    grid(box.upper).cwiseAbs().maxCoeff() <= PointGrid::kReach;
}

/// The steps are at most this length.
void expectRoom(const PointGrid& grid, double step)
{
  EXPECT_TRUE(holds(grid, kRoom));
  EXPECT_LE(grid.step.maxCoeff(), step);
}

TEST(PointGrid, HoldsAllOfAnOrdinaryRoom)
{
  for (const int cells : { 1, 2, 7 })
  {
    Room room(cells);
    room.addBall({ 2, 2, 1 }, 0.3, 6);
    EXPECT_TRUE(isSame(room.grid(), PointGrid(kRoom))) << cells;
    // Many small triangles in one place, and things beside the house.
    room.addBall({ 1, 1, 1 }, 0.02, 60);
    room.addBall({ 20, 2, 1 }, 0.3, 6);
    room.lights.add(Vector3(2, 30, 3));
    EXPECT_TRUE(isSame(room.grid(), PointGrid(room.bounds()))) << cells;
  }
}

TEST(PointGrid, IsFineWhereSomethingIsFarAway)
{
  for (const double distances : { 1.0, 1e2, 1e6, 1e12 })
  {
    Room light, lamp, vehicle;
    light.lights.add(distances * kAway);
    lamp.still.addQuad(distances * kAway, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1, grey(0, 1));
    // Has more triangles than the room, and less area.
    vehicle.addBall(distances * kAway, 1.5, 20);
    for (Room* room : { &light, &lamp, &vehicle })
    {
      room->addBall({ 3, 3, 1 }, 0.3, 6);
      expectRoom(room->grid(), 2e-3);
    }
  }
}

TEST(PointGrid, HoldsDynamicObjectsThatAreNear)
{
  Room room;
  room.lights.add(kAway);
  room.addBall({ 40, 2, 1 }, 0.3, 6); // farther than the room is cut otherwise
  const PointGrid grid = room.grid();
  expectRoom(grid, 2e-3);
  EXPECT_TRUE(holds(grid, room.objects().dynamicObjects[0].worldBounds()));
  room.dynamicObjects[0].isPresent = false;
  EXPECT_FALSE(isSame(room.grid(), grid));
}

TEST(PointGrid, HoldsWhatIsThere)
{
  // Only far things: these are what matters.
  Room far;
  far.still = ObjectBuilder();
  far.addBall(kAway, 0.3, 6);
  EXPECT_TRUE(isSame(far.grid(), PointGrid(far.bounds())));
  // No surface.
  Room lights;
  lights.still = ObjectBuilder();
  EXPECT_TRUE(isSame(lights.grid(), PointGrid(Box())));
  lights.lights.add(kAway);
  EXPECT_TRUE(isSame(lights.grid(), PointGrid(lights.lights)));
  // A floor, and a far light above it.
  Room floor;
  floor.still = ObjectBuilder();
  floor.still.addQuad({ 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 1, 1, grey(0.5));
  EXPECT_TRUE(isSame(floor.grid(), PointGrid(floor.bounds())));
  floor.lights.add(Vector3(1, 1, 1e4));
  const PointGrid grid = floor.grid();
  EXPECT_TRUE(holds(grid, box({ 0, 0, 0 }, { 4, 4, 0 })));
  EXPECT_LE(grid.step.maxCoeff(), 1e-3);
}

TEST(PointGrid, FollowsTheScaleOfTheScene)
{
  Room room;
  room.addBall(kAway, 0.3, 6);
  const SceneObjects objects = room.objects();
  const PointGrid grid = pointGrid(objects, room.bounds());
  for (const double scale : { 0x1p-100, 0x1p100 })
  {
    std::vector<Triangle> triangles;
    for (const Triangle& triangle : objects.staticObject.mesh().triangles())
    {
      triangles.push_back({ scale * triangle.a, scale * triangle.b, scale * triangle.c });
    }
    SceneObjects scaled = objects;
    scaled.staticObject.body = std::make_shared<RigidObject>(TriangleMesh(triangles));
    AffineMap& pose = scaled.dynamicObjects[0].worldFromObject;
    pose.linear *= scale;
    pose.translation *= scale;
    const Box bounds = room.bounds();
    const PointGrid other = pointGrid(scaled, { scale * bounds.lower, scale * bounds.upper });
    EXPECT_EQ(other.center, Vector3(scale * grid.center));
    EXPECT_EQ(other.step, Vector3(scale * grid.step));
  }
}

}
}
