// SPDX-License-Identifier: BSD-3-Clause
#include "RoomPresets.h"

#include "Oven.h"
#include "ProductionLine.h"
#include "Shapes.h"

#include <vtkPolyData.h>
#include <vtksys/SystemTools.hxx>

#include <stdexcept>

namespace interactiveroom
{
namespace
{

using movingteapot::Box;
using movingteapot::Facing;
using movingteapot::MakeGridBox;
constexpr std::optional<double> none;

Room MakeLitRoom()
{
  const Box box = { -2, 2, -1.5, 1.5, 0, 2.5 };
  const double cell = 0.1;
  Room room;
  room.Still = {
    { MakeGridBox(box, cell, Facing::Inward, { { 0.5, 0.5, 0.5, 0.5, 0.3, 0.7 } }), false, true },
    MakeLamp({ -0.9, 0.9, -0.6, 0.6, 2.49, 2.49 }, 100),
    { MakeGridBox({ -1.5, -0.3, 0.3, 1.2, 0.66, 0.72 }, cell, Facing::Outward,
      { { 0.5, 0.5, 0.5, 0.5, 0.5, 0.5 } }) }, // a table top
  };
  const double white = 0.7, grey = 0.4;
  room.Moving = {
    MakeMoving("teapot", MakeTeapot(0.7), white, { 0.35, -0.55, 0.75 }, 25),
    MakeMoving("ball", MakeBall(0.26), white, { -0.9, 0.75, 0.73 }),
    MakeMoving("crate", MakeBox(0.6, 0.6, 0.6, 0.06), grey, { 1.25, 0.5, 0 }, 20),
    MakeMoving("drum", MakeDrum(0.26, 0.8), grey, { -1.35, -0.6, 0 }),
    MakeMoving("ring", MakeRing(0.3, 0.09), white, { -0.35, -0.6, 0 }),
  };
  room.Limits = box;
  room.Eye = { 0, -7.3, 1.7 };
  room.Focus = { 0, 0, 1.2 };
  room.ViewAngle = 30;
  return room;
}

// The five machine parts, or other things of their size.
std::vector<MovingThing> MakeParts()
{
  std::vector<MovingThing> things;
  const auto place = [&](const std::string& name, Mesh mesh, double lift) {
    const double x = 0.3 * (2 - double(things.size()));
    things.push_back(MakeMoving(name, mesh, 0.2, { x, 0, lift }));
  };
  if (vtksys::SystemTools::FileExists(MOVINGTEAPOT_DATA "/downloaded/joint.off", true))
  {
    for (const auto& part :
      curingoven::ReadParts(curingoven::ReadOptions({ "--cells", "1500", "--part-size", "0.2" })))
    {
      place(part.Name, part.Mesh, 0);
    }
    return things;
  }
  place("teapot", MakeTeapot(0.18), curingoven::Lift);
  place("ball", MakeBall(0.07), curingoven::Lift);
  place("box", MakeBox(0.14, 0.14, 0.1, 0.01), curingoven::Lift);
  place("drum", MakeDrum(0.06, 0.14), curingoven::Lift);
  place("ring", MakeRing(0.06, 0.02), curingoven::Lift);
  return things;
}

Room MakeOvenBelt()
{
  const curingoven::OvenOptions options = curingoven::ReadOptions({});
  const auto meshes = curingoven::MakeOven(options);
  Room room;
  for (int i = 0; i < curingoven::NumberOfOvenMeshes; ++i)
  {
    room.Still.push_back({ meshes[i], i == curingoven::Lamps, i == curingoven::Tunnel });
  }
  room.Moving = MakeParts();
  const double end = curingoven::BeltEnd(options), side = options.OvenWidth / 2;
  room.Limits = Box{ -end, end, -side, side, 0, options.Opening };
  room.Eye = { 0.4, -4.6, 1.5 };
  room.Focus = { 0, 0, 0.22 };
  room.ViewAngle = 19;
  return room;
}

// Shelves on both sides of the aisle, and what lies on them.
Mesh MakeRacks()
{
  std::vector<Mesh> parts;
  for (const double side : { -1.0, 1.0 })
  {
    for (int level = 0; level < 3; ++level)
    {
      const double z = 1.1 + 1.2 * level;
      parts.push_back(Moved(MakeBox(9, 1, 0.08, 0.25), 0, side * 2.3, z));
      for (int bay = (level + (side > 0)) % 2; bay < 7; bay += 2 + level % 2)
      {
        parts.push_back(
          Moved(MakeBox(0.9, 0.8, 0.6, 0.15), -3.6 + 1.2 * bay, side * 2.3, z + 0.09));
      }
    }
    for (int post = 0; post < 4; ++post)
    {
      parts.push_back(Moved(MakeBox(0.08, 0.08, 4.2, 0.3), -4.2 + 2.8 * post, side * 1.75, 0));
    }
  }
  return Append(parts);
}

Mesh MakeTruck()
{
  const double cell = 0.1;
  return Append({ Moved(MakeBox(1.1, 0.8, 0.6, cell), 0, 0, 0.15),
    Moved(MakeBox(0.5, 0.7, 0.5, cell), -0.3, 0, 0.76),
    Moved(MakeBox(0.1, 0.7, 1.9, cell), 0.62, 0, 0.1),
    Moved(MakeBox(0.8, 0.12, 0.05, cell), 1.08, -0.25, 0.15),
    Moved(MakeBox(0.8, 0.12, 0.05, cell), 1.08, 0.25, 0.15) });
}

Room MakeWarehouseAisle()
{
  const Box hall = { -5, 5, -3, 3, 0, 5 };
  Room room;
  room.Still = {
    { MakeGridBox(hall, 0.25, Facing::Inward, { { 0.5, 0.5, 0.5, 0.5, 0.3, 0.6 } }), false, true },
    { MakeRacks() },
  };
  for (const double x : { -3.0, 0.0, 3.0 })
  {
    room.Still.push_back(MakeLamp({ x - 0.8, x + 0.8, -0.15, 0.15, 4.99, 4.99 }, 400));
  }
  const double cell = 0.08;
  room.Moving = {
    MakeMoving("truck", MakeTruck(), 0.5, { -1.8, 0.1, 0 }, 10),
    MakeMoving("pallet", MakeBox(1, 0.8, 0.9, cell), 0.6, { 0.9, -0.5, 0 }, -10),
    MakeMoving("crate", MakeBox(0.6, 0.6, 0.6, cell), 0.4, { -3.3, -0.8, 0 }, 30),
    MakeMoving("drum", MakeDrum(0.3, 0.9), 0.3, { 2.4, 0.7, 0 }),
    MakeMoving("load", MakeBox(0.7, 0.5, 0.4, cell), 0.7, { -3.2, 0.8, 0 }),
  };
  room.Limits = hall;
  room.Eye = { -12.2, -0.5, 3.2 };
  room.Focus = { 0, 0, 2.1 };
  room.ViewAngle = 41;
  return room;
}

}

const std::vector<std::string>& PresetNames()
{
  static const std::vector<std::string> names = { "room", "oven", "aisle" };
  return names;
}

Room MakePreset(const std::string& name)
{
  return name == "oven" ? MakeOvenBelt() : name == "aisle" ? MakeWarehouseAisle() : MakeLitRoom();
}

}
