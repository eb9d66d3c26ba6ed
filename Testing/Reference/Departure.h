// SPDX-License-Identifier: BSD-3-Clause
#ifndef Departure_h
#define Departure_h

#include "PathVertex.h"
#include "Random.h"

#include <optional>

namespace pathtracedroom
{

/// The first vertex of a subpath and the unit direction in which the subpath leaves it. Without a
/// direction it is reflected as everywhere on its way.
struct Departure
{
  PathVertex vertex;
  std::optional<Vector3> direction;
};

}

#endif
