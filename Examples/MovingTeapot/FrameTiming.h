// SPDX-License-Identifier: BSD-3-Clause
#ifndef FrameTiming_h
#define FrameTiming_h

#include <vector>

namespace movingteapot
{

/** What one frame took, and what came of it. */
struct FrameTiming
{
  double ShootSeconds = 0.0;
  double VerifySeconds = 0.0;
  double RepairSeconds = 0.0;
  double Segments = 0.0;
  double RepairedSegments = 0.0;
  double EmittedPower = 0.0; // W
  double AbsorbedPower = 0.0;
  double EscapedPower = 0.0;
};

/** The frames of a run in order; the first is the first shooting, the others are updates. */
using RunTiming = std::vector<FrameTiming>;

}

#endif
