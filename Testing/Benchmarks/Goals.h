#ifndef Goals_h
#define Goals_h

#include "Result.h"

/// What the ray casts have to reach, in speed (rays per second) against a rival's.
namespace goals
{

/// One tree, against rtcIntersect1 on one mesh.
constexpr Goal kFlat = { 0.8, 1.1 };
constexpr Goal kFlatAvx2 = { 0.7, 0.85 };
/// A static and a dynamic tree, against rtcIntersect1 on a mesh and an instance.
constexpr Goal kTwoLevel = { 0.8, 1.2 };
constexpr Goal kFlatOverCgal = { 9, 15 };
constexpr Goal kFlatOverVtk = { 20, 35 };

}

#endif
