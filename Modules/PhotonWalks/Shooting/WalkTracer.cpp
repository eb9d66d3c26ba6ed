// SPDX-License-Identifier: BSD-3-Clause
#include "Shooting/WalkTracer.h"

#include <algorithm>

namespace irradiance
{

namespace
{

TreeRays raysOf(WalkFront& front)
{
  return { static_cast<std::uint32_t>(front.size),
    { front.originX.data(), front.originY.data(), front.originZ.data() },
    { front.directionX.data(), front.directionY.data(), front.directionZ.data() },
    { nullptr, nullptr, nullptr }, front.start.data(), front.distance.data(), front.hit.data(),
    { front.weightB.data(), front.weightC.data() } };
}

}

void WalkTracer::cast(WalkFront& front, FrontCast& cast) const
{
  std::fill_n(front.distance.data(), front.size, kInfinity);
  std::fill_n(front.hit.data(), front.size, WalkFront::kNone);
  cast.cast(scene_, triangles_.surfaces(), raysOf(front));
  resolveContacts(front);
}

void WalkTracer::castDynamic(WalkFront& front, FrontCast& cast) const
{
  cast.castDynamic(scene_, triangles_.surfaces(), raysOf(front));
  resolveContacts(front);
}

void WalkTracer::castMoved(WalkFront& front, FrontCast& cast) const
{
  std::copy_n(front.hit.data(), front.size, front.candidate.data());
  cast.castMoved(scene_, triangles_.surfaces(), raysOf(front));
  for (std::size_t row = 0; hasContacts() && row < front.size; ++row)
  {
    if (front.hit[row] != front.candidate[row])
    {
      resolveContact(front, row);
    }
  }
}

void WalkTracer::findDistances(WalkFront& front, FrontCast& cast) const
{
  cast.findDistances(scene_, triangles_.surfaces(), raysOf(front));
}

void WalkTracer::resolveContacts(WalkFront& front) const
{
  for (std::size_t row = 0; hasContacts() && row < front.size; ++row)
  {
    resolveContact(front, row);
  }
}

void WalkTracer::resolveContact(WalkFront& front, std::size_t row) const
{
  const TriangleId start = triangles_.idOf(front.start[row]), id = triangles_.idOf(front.hit[row]);
  if (!contacts_->has(start) && !contacts_->has(id))
  {
    return;
  }
  const Hit closest{ front.distance[row], id, { front.weightB[row], front.weightC[row] } };
  const Hit hit = contacts_->resolveContact(scene_, rayOf(front, row), closest);
  front.distance[row] = hit.distance;
  front.hit[row] = triangles_.numberOf(hit.id);
  front.weightB[row] = hit.weights[0];
  front.weightC[row] = hit.weights[1];
}

}
