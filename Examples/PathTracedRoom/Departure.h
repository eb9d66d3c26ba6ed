// SPDX-License-Identifier: BSD-3-Clause
#ifndef Departure_h
#define Departure_h

#include "PathVertex.h"
#include "Random.h"

namespace pathtracedroom
{

/// The first vertex of a subpath and the unit direction in which the subpath leaves it.
struct Departure
{
  PathVertex vertex;
  Vector3 direction;
};

}

#endif
