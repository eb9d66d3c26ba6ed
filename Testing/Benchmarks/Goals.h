#ifndef Goals_h
#define Goals_h

#include "Result.h"

namespace goals
{

// Speed of casts (rays per second) against a rival's, as the geometric mean over the sets of rays.

/// One tree, against rtcIntersect1 on one mesh.
constexpr Goal kFlat = { 1.0, 1.4 };
constexpr Goal kFlatAvx2 = { 0.7, 1.0 };
/// The same on the set of rays where it is slowest.
constexpr Goal kFlatWorst = { 0.8, 1.25 };
/// A static and a dynamic tree, against rtcIntersect1 on a mesh and an instance.
constexpr Goal kTwoLevel = { 1.0, 1.6 };
constexpr Goal kFlatOverCgal = { 12, 25 };
constexpr Goal kFlatOverVtk = { 30, 50 };
/// Static and dynamic trees side by side, against all in one tree and one after the other.
constexpr Goal kParallelOverOneTree = { 0.9, 1.0 };
constexpr Goal kParallelOverSequential = { 1.0, 1.1 };

/// Time to build a kd-tree over a fine mesh, against Embree's best tree.
constexpr Goal kTreeBuild = { 4, 2 };

// The moving teapot.

/// Speed of the first shooting against Embree's fastest way to do the same walks.
constexpr Goal kFirstShooting = { 0.85, 1.2 };
/// Time against that of the first shooting.
constexpr Goal kVerification = { 0.03, 0.01 };
constexpr Goal kNothingMoved = { 0.0001, 0 };
/// Frames that are verified and repaired while Embree's fastest way shoots one.
constexpr Goal kReshooting = { 12, 25 };
/// The same where about a hundredth of the walks changes.
constexpr Goal kReshootingSmall = { 25, 45 };
/// Time of repair with the cache of static hits against that without.
constexpr Goal kStaticHitCache = { 0.8, 0.6 };
/// Speed of two threads against one.
constexpr Goal kTwoThreads = { 1.7, 1.9 };
/// Of history, with one band.
constexpr Goal kBytesPerHit = { 56, 40 };

/// Time to find the segments near moved bodies, against that to read all that is stored once, with
/// 16 million segments.
constexpr Goal kSegmentScan = { 0.5, 0.2 };

}

#endif
