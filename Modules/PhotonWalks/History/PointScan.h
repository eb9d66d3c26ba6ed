// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PointScan_h
#define irradiance_PointScan_h

#include <cstddef>
#include <cstdint>

namespace irradiance
{

/// Points in a row, each with the tag of the segment that begins there.
struct ScanPoints
{
  const float *x, *y, *z;
  const std::uint16_t* tags;
  std::size_t count;
};

/// A ball in a frame of its own: point p of the scan stands at matrix * p + offset, and the ball
/// around 0 there. It is larger for a segment that begins far from the origin of the points.
struct ScanBody
{
  float matrix[9]; ///< column by column
  float offset[3];
  float squaredRadius;
  float byDistance; ///< by which it is larger, times the squared distance
};

/// What the loops of a SegmentScan work on: one look at each segment between two points in a row.
struct PointScan
{
  static constexpr std::size_t kTogether = 16; ///< segments

  ScanPoints points;
  ScanPoints next; ///< will be read after these
  std::uint32_t tags;
  const ScanBody* bodies;
  std::size_t numberOfBodies;
  /// From points this near to 0, floats tell enough.
  float squaredNear;
  /// A bit for each segment, kTogether in a word: set if it may touch a body, or if the bit of its
  /// tag is set in `tags`.
  std::uint16_t* named;
};

void runScanPlain(const PointScan& scan);
#ifdef __x86_64__
void runScanAvx2(const PointScan& scan);
void runScanAvx512(const PointScan& scan);
#endif

}

#endif
