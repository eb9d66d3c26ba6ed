#ifndef Goals_h
#define Goals_h

#include "Result.h"

namespace goals
{

// Speed of casts (rays per second) against a rival's.

/// One tree, against rtcIntersect1 on one mesh.
constexpr Goal kFlat = { 0.8, 1.1 };
constexpr Goal kFlatAvx2 = { 0.7, 0.85 };
/// A static and a dynamic tree, against rtcIntersect1 on a mesh and an instance.
constexpr Goal kTwoLevel = { 0.8, 1.2 };
constexpr Goal kFlatOverCgal = { 9, 15 };
constexpr Goal kFlatOverVtk = { 20, 35 };

// Time of a frame of the moving teapot against shooting all walks anew with rtcIntersect1.

constexpr Goal kVerification = { 0.05, 0.025 };
/// How many frames could be verified and repaired meanwhile.
constexpr Goal kReshooting = { 8, 15 };

}

#endif
