// SPDX-License-Identifier: BSD-3-Clause
#ifndef TimingTable_h
#define TimingTable_h

#include "FrameTiming.h"

#include <iosfwd>

namespace movingteapot
{

/**
 * Writes the table of the paper's section 5 with the paper's figures beside it: first shooting,
 * verification, and update with and without the static-hit cache, in seconds and as shares of the
 * first shooting.
 */
void WriteTimingTable(
  std::ostream& stream, const RunTiming& cached, const RunTiming& uncached, double afreshSeconds);

}

#endif
