// SPDX-License-Identifier: BSD-3-Clause
#ifndef TimingTable_h
#define TimingTable_h

#include <iosfwd>

class vtkFieldData;

namespace movingteapot
{

/**
 * What was measured: the field data of vtkIrradianceFilter's output, a tuple for each frame. The
 * first frame is a shooting, the others are updates.
 */
struct Measurements
{
  vtkFieldData* Cached;   // with the static-hit cache
  vtkFieldData* Uncached; // without it; may be null
  vtkFieldData* Afresh;   // the last frame alone; may be null
};

/**
 * Writes the table of the paper's section 5 with the paper's figures beside it: first shooting,
 * verification, and update with and without the static-hit cache, in seconds and as ratios to the
 * first shooting (medians, which other programs on the machine disturb least).
 */
void WriteTimingTable(std::ostream& stream, const Measurements& measurements);

}

#endif
