#ifndef irradiance_MeetingLanes_h
#define irradiance_MeetingLanes_h

#include "Geometry/TriangleIntersection.h"

#include <limits>

namespace irradiance
{

/// Eight meetings of a ray and a triangle side by side.
struct MeetingLanes
{
  static constexpr unsigned kSize = 8;

  struct alignas(64) Points
  {
    double x[kSize] = {}, y[kSize] = {}, z[kSize] = {};

    void set(unsigned lane, const RayAxes& axes, const Vector3& point)
    {
      x[lane] = point[axes.x];
      y[lane] = point[axes.y];
      z[lane] = point[axes.z];
    }
    __attribute__((always_inline)) Meeting::Point operator[](unsigned lane) const
    {
      return { x[lane], y[lane], z[lane] };
    }
  };

  Points origin, direction, a, b, c;
  alignas(64) double distance[kSize] = {}; ///< not a number where nothing is met
  alignas(64) double weightB[kSize] = {}, weightC[kSize] = {};

  void set(
    unsigned lane, const Vector3& rayOrigin, const Vector3& rayDirection, const Triangle& triangle)
  {
    const RayAxes axes(rayDirection);
    origin.set(lane, axes, rayOrigin);
    direction.set(lane, axes, rayDirection);
    a.set(lane, axes, triangle.a);
    b.set(lane, axes, triangle.b);
    c.set(lane, axes, triangle.c);
  }

  /// To be compiled once for each kind of machine.
  __attribute__((always_inline)) void meet()
  {
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      const Meeting meeting(origin[lane], direction[lane], a[lane], b[lane], c[lane]);
      distance[lane] = meeting.isMet ? meeting.distance : std::numeric_limits<double>::quiet_NaN();
      weightB[lane] = meeting.weightB;
      weightC[lane] = meeting.weightC;
    }
  }
};

/// With the best instructions of the machine; the same bits with all.
void meetAll(MeetingLanes& lanes);
void meetAllAvx2(MeetingLanes& lanes);
void meetAllAvx512(MeetingLanes& lanes);

}

#endif
