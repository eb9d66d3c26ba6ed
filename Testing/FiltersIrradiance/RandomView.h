// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RandomChoices.h"

#include <algorithm>
#include <limits>

/// What looks at the photons of a filter: an eye, and sensors.
namespace RandomModels
{

struct View
{
  bool HasEye = false, HasSensors = false, HasPoints = false;
  Vector Eye{ 1, 2, 3 };
  bool IsFar = false; ///< the eye is infinitely far away in the direction of Eye
  int NumberOfSpecularSamples = 4;
  Mesh Sensors;
  int NumberOfPhotons = 50;
  double MaximumRadius = 0;
  double MaximumDistance = 0;
  int NumberOfPointRays = 2;
  double FeatureAngle = 30;

  bool IsUsed() const { return this->HasEye || this->HasSensors || this->HasPoints; }
};

/// Half of them on the floor or a wall of the room, the others anywhere.
inline Mesh RandomSensors(RandomNumbers& random)
{
  std::vector<Vector> positions, normals;
  for (int i = random.Below(30); i >= 0; --i)
  {
    Vector position = RandomPlace(random);
    Vector normal{ random.Between(-1, 1), random.Between(-1, 1), random.Between(-1, 1) };
    if (Chance(random, 2))
    {
      const auto axis = static_cast<std::size_t>(random.Below(3));
      normal = { 0, 0, 0 };
      normal[axis] = Chance(random, 2) ? 1 : -2;
      position[axis] = normal[axis] > 0 ? 0 : 3;
    }
    positions.push_back(position);
    normals.push_back(normal);
  }
  return MakeSensors(positions, normals);
}

/// At most 16 in the middles of cells, on their front or back.
inline Mesh SensorsOn(RandomNumbers& random, vtkPolyData* surface)
{
  std::vector<Vector> positions, normals;
  vtkNew<vtkIdList> ids;
  const int cells = static_cast<int>(surface->GetNumberOfPolys());
  for (int i = 0; i < std::min(cells, 16); ++i)
  {
    surface->GetPolys()->GetCellAtId(random.Below(cells), ids);
    Vector middle{}, normal = PolygonNormal(surface, ids);
    vtkMath::Normalize(normal.data());
    for (vtkIdType corner = 0; corner < ids->GetNumberOfIds(); ++corner)
    {
      Vector point;
      surface->GetPoint(ids->GetId(corner), point.data());
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        middle[axis] += point[axis] / static_cast<double>(ids->GetNumberOfIds());
      }
    }
    const double side = Chance(random, 4) ? -1 : 1;
    if (vtkMath::Norm(normal.data()) > 0)
    {
      positions.push_back(middle);
      normals.push_back({ side * normal[0], side * normal[1], side * normal[2] });
    }
  }
  return MakeSensors(positions, normals);
}

inline void MoveEye(RandomNumbers& random, View& view)
{
  view.Eye = RandomPlace(random);
  view.IsFar = Chance(random, 4);
  view.NumberOfSpecularSamples = 1 + random.Below(8);
}

inline void ChangeSensors(RandomNumbers& random, View& view)
{
  view.Sensors = RandomSensors(random);
  view.NumberOfPhotons = 2 << random.Below(10);
  const auto limit = [&] {
    return Chance(random, 3) ? 0
      : Chance(random, 2)    ? std::numeric_limits<double>::infinity()
                             : random.Between(0.01, 2);
  };
  view.MaximumRadius = limit();
  view.MaximumDistance = limit();
}

inline void ChangePoints(RandomNumbers& random, View& view)
{
  view.NumberOfPointRays = 1 + random.Below(4);
  view.FeatureAngle = Chance(random, 2) ? 30 : random.Between(0, 180);
}

/// Half of all models have an eye, half have sensors, a third have light at points.
inline View RandomView(RandomNumbers& random)
{
  View view;
  view.HasEye = Chance(random, 2);
  view.HasSensors = Chance(random, 2);
  MoveEye(random, view);
  ChangeSensors(random, view);
  view.HasPoints = Chance(random, 3);
  ChangePoints(random, view);
  return view;
}

}
