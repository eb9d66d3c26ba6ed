// SPDX-License-Identifier: BSD-3-Clause
#ifndef FrameReport_h
#define FrameReport_h

namespace movingteapot
{

/** What one frame took, and what came of it: the field data of vtkIrradianceFilter's output. */
struct FrameReport
{
  double ShootSeconds = 0.0; // 0 in an update
  double VerifySeconds = 0.0;
  double RepairSeconds = 0.0;
  double Walks = 0.0;
  double InvalidWalks = 0.0;
  double Segments = 0.0;
  double RepairedSegments = 0.0;
  double HistoryBytes = 0.0;
  double EmittedPower = 0.0; // W
  double AbsorbedPower = 0.0;
  double EscapedPower = 0.0;
};

}

#endif
