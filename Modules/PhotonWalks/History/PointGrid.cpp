// SPDX-License-Identifier: BSD-3-Clause
#include "History/PointGrid.h"

namespace irradiance
{

PointGrid::PointGrid(const Box& box)
{
  if (box.isEmpty())
  {
    return;
  }
  center = box.center();
  // From the middle as it was rounded, so that both corners are within reach.
  const Vector3 half = (box.upper - center).cwiseMax(center - box.lower);
  constexpr double kFlattest = 0x1p-10, kSmallest = 0x1p-500;
  // Points on the border, a little beside it by rounding, and bodies that touch it are well within.
  constexpr double kMargin = 8;
  const double least = std::max(kFlattest * half.maxCoeff(), kSmallest);
  step = half.cwiseMax(least) / (kReach - kMargin);
  perStep = step.cwiseInverse();
}

}
