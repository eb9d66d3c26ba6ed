// SPDX-License-Identifier: BSD-3-Clause
#ifndef TimingTable_h
#define TimingTable_h

#include "FrameReport.h"

#include <iosfwd>
#include <vector>

namespace movingteapot
{

/** What was measured; in each run the first frame is a shooting and the others are updates. */
struct Measurements
{
  std::vector<FrameReport> Cached;   // with the static-hit cache
  std::vector<FrameReport> Uncached; // without it; may be empty
  std::vector<FrameReport> Afresh;   // the last frame alone; may be empty
};

/**
 * Writes the table of the paper's section 5 with the paper's figures beside it: first shooting,
 * verification, and update with and without the static-hit cache, in seconds and as ratios to the
 * first shooting (medians, which other programs on the machine disturb least).
 */
void WriteTimingTable(std::ostream& stream, const Measurements& measurements);

}

#endif
