// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RandomTrial.h"

#include "vtkDataSetAttributes.h"
#include "vtkUnsignedCharArray.h"

#include <cmath>

/// What users do to a filter's inputs and their poses. Each edit changes model and filter alike.
namespace RandomPrograms
{

// Poses.

inline void MoveAPose(Trial& t)
{
  Connection& moving = Pick(t.Random, t.Moving());
  if (moving.Pose)
  {
    MoveRandomly(t.Random, moving.Pose);
  }
}

inline void ReplaceOrRemoveAPose(Trial& t)
{
  const int i = t.Random.Below(static_cast<int>(t.Moving().size()));
  Connection& moving = t.Moving()[static_cast<std::size_t>(i)];
  if (!moving.Keys.Keys.empty())
  {
    return;
  }
  auto& pose = moving.Pose;
  pose = Chance(t.Random, 3) ? nullptr : vtkSmartPointer<vtkTransform>::New();
  if (pose)
  {
    MoveRandomly(t.Random, pose);
  }
  t.Filter->SetDynamicTransform(i, pose);
}

/// The field of a leaf, or of the root of a connection.
inline void ChangeAPoseField(Trial& t)
{
  Connection& moving = Pick(t.Random, t.Moving());
  auto leaves = LeavesOf(moving.Data);
  vtkDataObject* data = moving.Data;
  if (!leaves.empty() && Chance(t.Random, 2))
  {
    data = Pick(t.Random, leaves);
  }
  vtkNew<vtkTransform> pose;
  MoveRandomly(t.Random, pose);
  Chance(t.Random, 4) ? data->GetFieldData()->RemoveArray("ObjectToWorld")
                      : SetObjectToWorld(data, pose);
  moving.Data->Modified();
}

/// The lamps of a leaf join a group, which has another factor or not.
inline void ChangeALightGroup(Trial& t)
{
  Connection& connection = Pick(t.Random, t.Given.Ports[t.Random.Below(2)]);
  auto leaves = LeavesOf(connection.Data);
  if (leaves.empty())
  {
    return;
  }
  vtkPolyData* const leaf = Pick(t.Random, leaves);
  leaf->GetFieldData()->RemoveArray("LightGroup");
  leaf->GetFieldData()->RemoveArray("LightGroupFactor");
  const int group = t.Random.Below(3);
  if (group > 0)
  {
    SetField(leaf, "LightGroup", { static_cast<double>(group) });
  }
  if (group == 2 && Chance(t.Random, 2))
  {
    SetField(leaf, "LightGroupFactor", { 0.25 });
  }
  leaf->Modified();
  connection.Data->Modified();
}

/// Touches exactly: the lamp, or in a corner the floor, two walls and other objects there.
inline void TouchSomething(Trial& t)
{
  Connection& moving = Pick(t.Random, t.Moving());
  auto leaves = LeavesOf(moving.Data);
  if (moving.Pose && !leaves.empty())
  {
    const double* bounds = Pick(t.Random, leaves)->GetBounds();
    double shift[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      shift[axis] = 0.25 * t.Random.Below(4) - bounds[2 * axis];
    }
    if (Chance(t.Random, 3))
    {
      shift[0] = shift[1] = 1.5;
      shift[2] = 2.75 - bounds[4 + t.Random.Below(2)];
    }
    moving.Pose->Identity();
    moving.Pose->Translate(shift);
  }
}

inline void GoWhereAnotherIs(Trial& t)
{
  Connection &one = Pick(t.Random, t.Moving()), &other = Pick(t.Random, t.Moving());
  if (one.Pose && other.Pose)
  {
    one.Pose->SetMatrix(other.Pose->GetMatrix());
  }
}

inline void GoFarAway(Trial& t)
{
  Connection& moving = Pick(t.Random, t.Moving());
  if (moving.Pose)
  {
    const double far = std::pow(10, t.Random.Below(5));
    moving.Pose->Identity();
    moving.Pose->Translate(t.Random.Between(500, 1000) * far, 1e3 * far, -300 * far);
  }
}

/// Forwards, backwards, and beyond the keys of some rides.
inline void GoToAnotherTime(Trial& t)
{
  t.Given.Time = RandomTime(t.Random);
}

inline void ChangeARide(Trial& t)
{
  for (std::size_t i = 0; i < t.Moving().size(); ++i)
  {
    if (!t.Moving()[i].Keys.Keys.empty())
    {
      t.Moving()[i].Keys = RandomRide(t.Random);
      SetRide(vtkKeyFramedPose::SafeDownCast(t.Filter->GetInputAlgorithm(1, static_cast<int>(i))),
        t.Moving()[i].Keys);
    }
  }
}

// Data.

/// Moves one point of a mesh of triangles, or scales all points of another, whose cells stay flat.
inline void Deform(Trial& t)
{
  const Leaf leaf = t.PickLeaf(false);
  if (leaf.IsGround)
  {
    return;
  }
  vtkPoints* points = leaf.Mesh->GetPoints();
  const auto pick = [&] { return t.Random.Below(static_cast<int>(points->GetNumberOfPoints())); };
  if (leaf.Mesh->GetPolys()->GetMaxCellSize() == 3)
  {
    double target[3] = { t.Random.Between(-0.5, 0.5), t.Random.Between(-0.5, 0.5), 0.25 };
    if (Chance(t.Random, 4))
    {
      points->GetPoint(pick(), target); // triangles without area
    }
    points->SetPoint(pick(), target);
  }
  else
  {
    const int axis = t.Random.Below(3);
    const double factor = t.Random.Between(0.6, 1.5);
    for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
    {
      double point[3];
      points->GetPoint(i, point);
      point[axis] *= factor;
      points->SetPoint(i, point);
    }
  }
  points->Modified();
  leaf.Modified();
}

inline void TakeANewShape(Trial& t)
{
  const Leaf leaf = t.PickLeaf(false);
  if (!leaf.IsGround)
  {
    leaf.Mesh->DeepCopy(RandomMesh(t.Random));
    leaf.Modified();
  }
}

inline void SetGloss(Trial& t)
{
  const Leaf leaf = t.PickLeaf(true);
  SetCellValues(leaf.Mesh, "SpecularReflectance", RandomTuple(t.Random, 0.95));
  SetRandomExponents(t.Random, leaf.Mesh);
  leaf.Modified();
}

/// And nothing else, on half of what is glossy.
inline void ChangeExponents(Trial& t)
{
  t.ForEachMesh([&](const Leaf& leaf) {
    if (leaf.Mesh->GetCellData()->HasArray(t.Set().SpecularArray.c_str()) && Chance(t.Random, 2))
    {
      SetRandomExponents(t.Random, leaf.Mesh);
      leaf.Modified();
    }
  });
}

/// Or only the exponents: then all of it is a mirror.
inline void RemoveGloss(Trial& t)
{
  const Leaf leaf = t.PickLeaf(true);
  leaf.Mesh->GetCellData()->RemoveArray("PhongExponent");
  if (!Chance(t.Random, 3))
  {
    leaf.Mesh->GetCellData()->RemoveArray("SpecularReflectance");
  }
  leaf.Modified();
}

inline void SetAnArray(Trial& t)
{
  const Leaf leaf = t.PickLeaf(true);
  const bool isLight = !leaf.IsGround && !HasTable(leaf.Mesh) && Chance(t.Random, 3);
  SetCellValues(leaf.Mesh, isLight ? "RadiantExitance" : "DiffuseReflectance",
    RandomTuple(t.Random, isLight ? 50 : 0.9));
  leaf.Modified();
}

inline void ChangeAValue(Trial& t)
{
  const Leaf leaf = t.PickLeaf(false);
  for (const char* name : { "RadiantExitance", "DiffuseReflectance", "RadiantFlux", "Albedo",
         "SpecularReflectance", "PhongExponent" })
  {
    if (vtkDataArray* array = leaf.Mesh->GetCellData()->GetArray(name))
    {
      const int cell = t.Random.Below(static_cast<int>(array->GetNumberOfTuples()));
      array->SetComponent(cell, 0, t.Random.Between(0, 0.9));
      array->Modified();
    }
  }
  leaf.Modified();
}

inline void RemoveAnArray(Trial& t)
{
  const Leaf leaf = t.PickLeaf(true);
  leaf.Mesh->GetCellData()->RemoveArray(
    Chance(t.Random, 2) ? "RadiantExitance" : "DiffuseReflectance");
  leaf.Modified();
}

inline void ChangeGhosts(Trial& t)
{
  const Leaf leaf = t.PickLeaf(false);
  leaf.Mesh->GetCellData()->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  const bool isOpening = HasTable(leaf.Mesh) && leaf.Mesh->GetNumberOfPolys() > 0; // stays whole
  if (!isOpening && !Chance(t.Random, 3))
  {
    vtkNew<vtkUnsignedCharArray> ghosts;
    ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
    for (vtkIdType i = 0; i < leaf.Mesh->GetNumberOfCells(); ++i)
    {
      ghosts->InsertNextValue(!Chance(t.Random, 6) ? 0
          : Chance(t.Random, 2)                    ? vtkDataSetAttributes::HIDDENCELL
                                                   : vtkDataSetAttributes::DUPLICATECELL);
    }
    leaf.Mesh->GetCellData()->AddArray(ghosts);
  }
  leaf.Modified();
}

inline void ChangeBlocks(Trial& t)
{
  Connection& connection = Pick(t.Random, t.Given.Ports[Chance(t.Random, 4) ? 0 : 1]);
  const auto i = static_cast<unsigned int>(t.Random.Below(4));
  const Mesh mesh = Chance(t.Random, 2) ? nullptr : RandomMesh(t.Random);
  if (auto* blocks = vtkMultiBlockDataSet::SafeDownCast(connection.Data))
  {
    Chance(t.Random, 3) ? blocks->SetNumberOfBlocks(i) : blocks->SetBlock(i, mesh);
  }
  else if (auto* pieces = vtkPartitionedDataSet::SafeDownCast(connection.Data))
  {
    Chance(t.Random, 3) ? pieces->SetNumberOfPartitions(i) : pieces->SetPartition(i, mesh);
  }
  else if (auto* all = vtkPartitionedDataSetCollection::SafeDownCast(connection.Data))
  {
    Chance(t.Random, 3) ? all->SetNumberOfPartitionedDataSets(i) : all->SetPartition(i, 0, mesh);
  }
  connection.Data->Modified();
}

// Lights.

/// Its flux, its table or its axes, of half of the lamps.
inline void ChangeLuminaires(Trial& t)
{
  t.ForEachMesh([&](const Leaf& leaf) {
    if (HasTable(leaf.Mesh) && leaf.Mesh->GetNumberOfCells() > 0 && Chance(t.Random, 2))
    {
      const int what = t.Random.Below(3);
      what == 0     ? SetRandomFlux(t.Random, leaf.Mesh)
        : what == 1 ? SetRandomTable(t.Random, leaf.Mesh, IsFlat(leaf.Mesh))
                    : SetRandomAxes(t.Random, leaf.Mesh, IsFlat(leaf.Mesh));
      leaf.Modified();
    }
  });
}

inline void ChangeTheSky(Trial& t)
{
  t.ForEachMesh([&](const Leaf& leaf) {
    if (IsSky(leaf.Mesh))
    {
      leaf.Mesh->DeepCopy(RandomSky(t.Random));
      leaf.Modified();
    }
  });
}

// Connections.

inline void ShiftPoints(vtkPolyData* mesh, const double shift[3])
{
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double point[3];
    mesh->GetPoint(i, point);
    mesh->GetPoints()->SetPoint(i, point[0] + shift[0], point[1] + shift[1], point[2] + shift[2]);
  }
  mesh->GetPoints()->Modified();
}

/// Static meshes stand in the same corner, and touch exactly.
inline void PutIntoTheCorner(Trial& t, vtkPolyData* mesh)
{
  double bounds[6];
  mesh->GetBounds(bounds);
  double shift[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    shift[axis] = 0.25 * t.Random.Below(4) - bounds[2 * axis];
  }
  ShiftPoints(mesh, shift);
}

inline void AddConnection(Trial& t)
{
  const int port = Chance(t.Random, 3) ? 0 : 1;
  auto& connections = t.Given.Ports[port];
  if (connections.size() < 7)
  {
    const bool isTwin = port == 1 && Chance(t.Random, 4); // the same data, in another place
    const auto data = isTwin ? Pick(t.Random, connections).Data : RandomData(t.Random);
    auto pose = vtkSmartPointer<vtkTransform>::New();
    MoveRandomly(t.Random, pose);
    if (port == 0)
    {
      ForEachLeaf(data, [&](vtkPolyData* mesh) { PutIntoTheCorner(t, mesh); });
    }
    const Ride ride = port == 1 && Chance(t.Random, 3) ? RandomRide(t.Random) : Ride{};
    connections.push_back({ data, port == 1 && ride.Keys.empty() ? pose : nullptr, ride });
    Connect(t.Filter, port, connections.back());
    ApplyPoses(t.Filter, t.Given);
  }
}

/// So many small static boxes, each a connection of its own.
inline void AddManyParts(Trial& t, int count)
{
  for (int i = 0; i < count; ++i)
  {
    Mesh part = MakeBox(0.01, 0.01, 0.01);
    const double shift[] = { t.Random.Between(0, 3), t.Random.Between(0, 3),
      t.Random.Between(0, 3) };
    ShiftPoints(part, shift);
    t.Given.Ports[0].push_back({ part, nullptr, {} });
    Connect(t.Filter, 0, t.Given.Ports[0].back());
  }
}

/// The ground stays, and so does the first dynamic connection.
inline void RemoveConnection(Trial& t)
{
  const int port = Chance(t.Random, 3) ? 0 : 1;
  auto& connections = t.Given.Ports[port];
  if (connections.size() > 1)
  {
    const int i = 1 + t.Random.Below(static_cast<int>(connections.size()) - 1);
    connections.erase(connections.begin() + i);
    t.Filter->RemoveInputConnection(port, i);
    t.Filter->RemoveAllDynamicTransforms();
    ApplyPoses(t.Filter, t.Given);
  }
}

}
