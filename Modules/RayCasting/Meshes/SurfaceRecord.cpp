// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/SurfaceRecord.h"

#include "Meshes/SurfaceFormula.h"

namespace irradiance
{

namespace
{

SurfaceFormula::Point plain(const Vector3& v)
{
  return { v[0], v[1], v[2] };
}

void store(const SurfaceFormula::Point& point, double (&row)[3])
{
  row[0] = point.x;
  row[1] = point.y;
  row[2] = point.z;
}

}

SurfaceRecord::SurfaceRecord(const Triangle& world)
{
  // Weights of 0 are raised to the least that any weight is raised to.
  const SurfaceFormula formula(plain(world.a), plain(world.b), plain(world.c), { 0, 0, 0 });
  store(plain(world.a), a);
  store(plain(world.b), b);
  store(plain(world.c), c);
  store(formula.normal, normal);
  clearance = formula.clearance;
  store(formula.kept, inset);
}

}
