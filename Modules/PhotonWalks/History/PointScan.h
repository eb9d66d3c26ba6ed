// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PointScan_h
#define irradiance_PointScan_h

#include <cstddef>
#include <cstdint>

namespace irradiance
{

/// Consecutive points, each with the tag of the segment that begins there.
struct ScanPoints
{
  const float *x, *y, *z;
  const std::uint16_t* tags;
  std::size_t count;
};

/// A ball around 0 in a frame of its own, in which point p of the scan is at matrix * p + offset.
/// It is larger for a segment that begins far from the origin of the points.
struct ScanBody
{
  float matrix[9]; ///< column by column
  float offset[3];
  float squaredRadius;
  float byDistance; ///< times the squared distance from that origin: added to squaredRadius
};

/// What the loops of a SegmentScan work on: they test each segment between consecutive points once.
struct PointScan
{
  static constexpr std::size_t kGroupSize = 16; ///< segments to a word of `flagged`

  ScanPoints points;
  ScanPoints next; ///< the points of the next scan, to be prefetched
  std::uint32_t tags;
  const ScanBody* bodies;
  std::size_t numberOfBodies;
  /// Within this squared distance of 0, errors are small relative to each body.
  float squaredNear;
  /// A flag bit for each segment, kGroupSize to a word: set if the segment may touch a body, or if
  /// the bit of its tag is set in `tags`.
  std::uint16_t* flagged;
};

void runScanPlain(const PointScan& scan);
#ifdef __x86_64__
void runScanAvx2(const PointScan& scan);
void runScanAvx512(const PointScan& scan);
#endif

}

#endif
