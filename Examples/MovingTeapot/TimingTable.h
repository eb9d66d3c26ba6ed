// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class vtkFieldData;

namespace movingteapot
{

/**
 * Prints the table of the paper's section 5 with the paper's figures beside it: first shooting,
 * verification, and update with and without the static-hit cache, in seconds and as ratios to the
 * first shooting (medians, which other programs on the machine disturb least).
 *
 * Of each run the field data of vtkIrradianceFilter's output, a tuple for each frame; the first is
 * a shooting, the others are updates. Without a comparison `uncached` (without the static-hit
 * cache) and `afresh` (the last frame alone) have none.
 */
void PrintTimingTable(vtkFieldData* cached, vtkFieldData* uncached, vtkFieldData* afresh);

}
