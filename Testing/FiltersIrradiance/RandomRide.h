// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RandomChoices.h"

#include "vtkDataObject.h"
#include "vtkKeyFramedPose.h"

/// Poses over time.
namespace RandomModels
{

struct Ride
{
  struct Key
  {
    double Time;
    Vector Position, Orientation;
  };
  std::vector<Key> Keys; ///< empty: no ride
  int Interpolation = vtkKeyFramedPose::Linear, Outside = vtkKeyFramedPose::Hold;
};

/// Two to five keys from time 0 on, at most to 1.
inline Ride RandomRide(RandomNumbers& random)
{
  Ride ride;
  const int keys = 2 + random.Below(4);
  for (int i = 0; i < keys; ++i)
  {
    const Vector turned{ random.Between(-90, 90), random.Between(-90, 90),
      random.Between(-90, 90) };
    ride.Keys.push_back({ 0.25 * i, RandomPlace(random), turned });
  }
  ride.Interpolation = random.Below(3);
  ride.Outside = Chance(random, 2) ? vtkKeyFramedPose::Hold : vtkKeyFramedPose::Leave;
  return ride;
}

/// Half of all times are times of keys; some rides are over then.
inline double RandomTime(RandomNumbers& random)
{
  return Chance(random, 2) ? 0.25 * random.Below(6) : random.Between(0, 1.25);
}

inline void SetRide(vtkKeyFramedPose* pose, const Ride& ride)
{
  pose->RemoveAllPoses();
  for (const Ride::Key& key : ride.Keys)
  {
    pose->AddPose(key.Time, key.Position.data(), key.Orientation.data());
  }
  pose->SetInterpolationType(ride.Interpolation);
  pose->SetOutsideOfKeys(ride.Outside);
}

inline vtkSmartPointer<vtkKeyFramedPose> MakeRide(vtkDataObject* data, const Ride& ride)
{
  auto pose = vtkSmartPointer<vtkKeyFramedPose>::New();
  pose->SetInputDataObject(data);
  SetRide(pose, ride);
  return pose;
}

}
