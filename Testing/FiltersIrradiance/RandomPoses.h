// SPDX-License-Identifier: BSD-3-Clause
#ifndef RandomPoses_h
#define RandomPoses_h

#include "TestScenes.h"

namespace TestScenes
{

// Random steps of things that move through a room of 3 m.

inline void ShiftALittle(RandomNumbers& random, vtkTransform* pose)
{
  pose->Translate(random.Between(-0.2, 0.2), random.Between(-0.2, 0.2), random.Between(-0.2, 0.2));
}

inline void TurnAtRandom(RandomNumbers& random, vtkTransform* pose)
{
  pose->RotateWXYZ(random.Between(0, 360), random.Between(-1, 1), random.Between(-1, 1), 1);
}

/// Or a little outside.
inline void PlaceInTheRoom(RandomNumbers& random, vtkTransform* pose)
{
  pose->Identity();
  pose->Translate(random.Between(-0.2, 3.2), random.Between(-0.2, 3.2), random.Between(-0.2, 3.2));
}

}

#endif
