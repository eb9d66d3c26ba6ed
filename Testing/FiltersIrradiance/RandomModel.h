// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RandomGloss.h"
#include "RandomLights.h"
#include "RandomRide.h"
#include "RandomView.h"

#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkInformation.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkReverseSense.h"

#include <algorithm>
#include <cmath>

/// Everything that determines a filter's result, and random parts of it.
namespace RandomModels
{

struct Settings
{
  vtkIdType NumberOfWalks = 1000, MaximumNumberOfWalks = 6000;
  int Seed = 1, NumberOfReplicates = 16;
  double FactorOfStatic = 1; ///< of the light group of lamps that nobody gave another
  bool ComputeLightGroups = false;
  int TraversalMode = vtkIrradianceFilter::Parallel, UpdateMode = vtkIrradianceFilter::Verify;
  int CellEstimate = vtkIrradianceFilter::Sums, NumberOfSpreadPhotons = 250;
  int DirectLight = vtkIrradianceFilter::Shot;
  int NumberOfGatherRays = 4, MaximumNumberOfGatherRays = 32,
      GatherOn = vtkIrradianceFilter::SmallCells;
  bool UnbiasedGather = false;
  bool CacheStaticHits = true, SeparateSides = false, ComputeStandardError = false;
  double DefaultDiffuseReflectance = 0.5, TargetRelativeError = 0, RepairTimeBudget = 0;
  std::string ReflectanceArray = "DiffuseReflectance", SpecularArray = "SpecularReflectance";
  vtkIdType NumberOfOutputWalks = 0, OutputWalksCell = -1;
  int OutputWalksPort = 0, OutputWalksConnection = 0;
};

struct Connection
{
  vtkSmartPointer<vtkDataObject> Data;
  vtkSmartPointer<vtkTransform> Pose; ///< null for none; port 1 only
  Ride Keys;                          ///< port 1 only; excludes a pose
};

struct Model
{
  std::vector<Connection> Ports[2];
  Settings Set;
  View Look;
  int NumberOfThreads = 1;
  double Time = 0; ///< at which the filters are updated
};

/// `index`: 1 for the diffuse reflectance, 2 for the specular one.
inline void ChooseArray(vtkIrradianceFilter* filter, int index, const std::string& name)
{
  if (name != filter->GetInputArrayInformation(index)->Get(vtkDataObject::FIELD_NAME()))
  {
    filter->SetInputArrayToProcess(
      index, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, name.c_str());
  }
}

inline void ApplySettings(vtkIrradianceFilter* filter, const Settings& settings)
{
  filter->SetDirectLight(settings.DirectLight);
  filter->SetNumberOfWalks(settings.NumberOfWalks);
  filter->SetMaximumNumberOfWalks(settings.MaximumNumberOfWalks);
  filter->SetSeed(settings.Seed);
  filter->SetLightGroupFactor("Static", settings.FactorOfStatic);
  filter->SetComputeLightGroups(settings.ComputeLightGroups);
  filter->SetNumberOfReplicates(settings.NumberOfReplicates);
  filter->SetTraversalMode(settings.TraversalMode);
  filter->SetUpdateMode(settings.UpdateMode);
  filter->SetCellEstimate(settings.CellEstimate);
  filter->SetNumberOfSpreadPhotons(settings.NumberOfSpreadPhotons);
  filter->SetNumberOfGatherRays(settings.NumberOfGatherRays);
  filter->SetMaximumNumberOfGatherRays(settings.MaximumNumberOfGatherRays);
  filter->SetGatherOn(settings.GatherOn);
  filter->SetUnbiasedGather(settings.UnbiasedGather);
  filter->SetCacheStaticHits(settings.CacheStaticHits);
  filter->SetSeparateSides(settings.SeparateSides);
  filter->SetComputeStandardError(settings.ComputeStandardError);
  filter->SetDefaultDiffuseReflectance(settings.DefaultDiffuseReflectance);
  filter->SetTargetRelativeError(settings.TargetRelativeError);
  filter->SetRepairTimeBudget(settings.RepairTimeBudget);
  ChooseArray(filter, 1, settings.ReflectanceArray);
  ChooseArray(filter, 2, settings.SpecularArray);
  filter->SetNumberOfOutputWalks(settings.NumberOfOutputWalks);
  filter->SetOutputWalksPort(settings.OutputWalksPort);
  filter->SetOutputWalksConnection(settings.OutputWalksConnection);
  filter->SetOutputWalksCell(settings.OutputWalksCell);
}

inline void ApplyPoses(vtkIrradianceFilter* filter, const Model& model)
{
  for (std::size_t i = 0; i < model.Ports[1].size(); ++i)
  {
    filter->SetDynamicTransform(static_cast<int>(i), model.Ports[1][i].Pose);
  }
}

/// Adds a connection, behind a vtkKeyFramedPose of its own if it rides.
inline void Connect(vtkIrradianceFilter* filter, int port, const Connection& connection)
{
  if (connection.Keys.Keys.empty())
  {
    filter->AddInputDataObject(port, connection.Data);
  }
  else
  {
    filter->AddInputConnection(port, MakeRide(connection.Data, connection.Keys)->GetOutputPort());
  }
}

/// Sets up a filter that has no connections yet.
inline void Configure(vtkIrradianceFilter* filter, const Model& model)
{
  ApplySettings(filter, model.Set);
  for (const int port : { 0, 1 })
  {
    for (const Connection& connection : model.Ports[port])
    {
      Connect(filter, port, connection);
    }
  }
  ApplyPoses(filter, model);
}

/// Visits the polydata in `data`, in order; `data` may itself be one.
template <class Visit>
void ForEachLeaf(vtkDataObject* data, const Visit& visit)
{
  if (auto* polyData = vtkPolyData::SafeDownCast(data))
  {
    visit(polyData);
  }
  else if (auto* tree = vtkDataObjectTree::SafeDownCast(data))
  {
    const auto leaves = vtk::TakeSmartPointer(tree->NewTreeIterator());
    for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
    {
      visit(vtkPolyData::SafeDownCast(leaves->GetCurrentDataObject()));
    }
  }
}

/// Adds polygons that have no area: of one point, of two, and of three on a line.
inline void AddTinyPolygons(vtkPolyData* mesh)
{
  const vtkIdType a = 0, b = mesh->GetNumberOfPoints() - 1;
  const vtkIdType corners[] = { a, b, a };
  for (const vtkIdType count : { 1, 2, 3 })
  {
    mesh->GetPolys()->InsertNextCell(count, corners);
  }
  mesh->Modified();
}

/// Shells of 0.25 m around cavities, nested as deep as `depth`, with all fronts out of the matter.
/// The innermost comes first.
inline Mesh MakeNestedShells(double size, int depth)
{
  std::vector<Mesh> shells;
  for (int i = 0; i < 2 * depth; ++i)
  {
    const double side = size + 0.25 * i;
    shells.push_back(MakeBox(side, side, side));
    if (i % 2 == 0)
    {
      vtkNew<vtkReverseSense> turned;
      turned->SetInputData(shells.back());
      turned->Update();
      shells.back() = Copy(turned->GetOutput());
    }
  }
  return Join(shells);
}

/// Around the origin. Lengths are multiples of 0.25 m, so flat faces can touch exactly; some boxes
/// are thin boards.
inline Mesh RandomMesh(RandomNumbers& random)
{
  const auto length = [&] { return 0.25 * (1 + random.Below(4)); };
  const int kind = random.Below(19);
  if (kind == 18)
  {
    return RandomLuminaire(random);
  }
  if (kind == 0)
  {
    return MakePointLight({ 0, 0, 0 }, Scaled(RandomTuple(random, 40), RandomWeakness(random)));
  }
  if (kind == 1)
  {
    return MakeLamp(
      { 0, 0, 0 }, length(), Scaled(RandomTuple(random, 100), RandomWeakness(random)));
  }
  const double x = length(), y = length(), z = length();
  Mesh mesh = kind >= 16 ? MakeNestedShells(x, 1 + random.Below(2))
    : kind < 7           ? MakeBall(0.5 * x, 4 + random.Below(4))
    : kind < 12
    ? MakeBox(x, y, kind == 11 ? 0x1p-9 : z)
    : MakeRectangle({ -x, -y, 0 }, { 2 * x, 0, 0 }, { 0, 2 * y, 0 }, 1 + random.Below(3));
  if (Chance(random, 8))
  {
    AddTinyPolygons(mesh);
  }
  if (Chance(random, 2))
  {
    SetCellValues(mesh, "DiffuseReflectance", RandomTuple(random, 0.95));
  }
  if (Chance(random, 4))
  {
    SetCellValues(mesh, "SpecularReflectance", RandomTuple(random, 0.95));
    SetRandomExponents(random, mesh);
  }
  if (Chance(random, 16))
  {
    SetCellValues(mesh, "RadiantExitance", RandomTuple(random, 30));
  }
  else if (kind >= 16 && Chance(random, 2)) // on an inner wall
  {
    SetCellValues(mesh, "RadiantExitance", { 0 });
    mesh->GetCellData()
      ->GetArray("RadiantExitance")
      ->SetComponent(random.Below(6), 0, 30 * RandomWeakness(random));
  }
  return mesh;
}

/// Lets the specular reflectance of all meshes suit the diffuse one; whether it had to change.
inline bool LimitGloss(vtkDataObject* data, const Settings& settings)
{
  bool isLimited = false;
  ForEachLeaf(data, [&](vtkPolyData* mesh) {
    if (LimitGloss(mesh, settings.ReflectanceArray.c_str(), settings.SpecularArray.c_str(),
          settings.DefaultDiffuseReflectance))
    {
      mesh->Modified();
      isLimited = true;
    }
  });
  return isLimited;
}

inline void MoveRandomly(RandomNumbers& random, vtkTransform* pose)
{
  switch (random.Below(5))
  {
    case 0:
      pose->Translate(
        random.Between(-0.3, 0.3), random.Between(-0.3, 0.3), random.Between(-0.3, 0.3));
      break;
    case 1:
      pose->RotateWXYZ(random.Between(0, 360), random.Between(-1, 1), random.Between(-1, 1), 1);
      break;
    case 2:
      pose->Identity();
      pose->Translate(RandomPlace(random).data());
      pose->Scale(random.Between(0.3, 2), random.Between(0.3, 2), random.Between(0.3, 2));
      break;
    case 3:
      pose->Identity();
      pose->Translate(RandomPlace(random).data());
      pose->Scale(1, -1, 1);
      break;
    default:
      pose->Identity();
      pose->Translate(RandomPlace(random).data());
  }
}

/// A polydata, or one to three of them in a composite dataset of some kind.
inline vtkSmartPointer<vtkDataObject> RandomData(RandomNumbers& random)
{
  const auto count = static_cast<unsigned int>(1 + random.Below(3));
  const auto leaf = [&] {
    Mesh mesh = RandomMesh(random);
    vtkNew<vtkTransform> pose;
    pose->Translate(random.Between(-1, 1), random.Between(-1, 1), random.Between(-1, 1));
    SetObjectToWorld(mesh, pose);
    return mesh;
  };
  const int kind = random.Below(6);
  if (kind == 0)
  {
    auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
    vtkNew<vtkMultiBlockDataSet> inner;
    inner->SetBlock(1, leaf());
    blocks->SetBlock(0, inner);
    for (unsigned int i = 1; i < count; ++i)
    {
      blocks->SetBlock(i, leaf());
    }
    return blocks;
  }
  if (kind == 1)
  {
    auto pieces = vtkSmartPointer<vtkPartitionedDataSet>::New();
    for (unsigned int i = 0; i < count; ++i)
    {
      pieces->SetPartition(i, leaf());
    }
    return pieces;
  }
  if (kind == 2)
  {
    auto collection = vtkSmartPointer<vtkPartitionedDataSetCollection>::New();
    for (unsigned int i = 0; i < count; ++i)
    {
      collection->SetPartition(i, i % 2, leaf());
    }
    return collection;
  }
  return RandomMesh(random);
}

/// A room or an open floor, which stays and may shine, a lamp, perhaps a bulb of many facets, a lamp
/// with a table or a sky, four dynamic inputs and one that rides.
inline Model RandomModel(RandomNumbers& random)
{
  Model model;
  const bool hasSky = Chance(random, 4);
  Mesh ground = Chance(random, hasSky ? 1 : 3)
    ? MakeRectangle({ -2, -2, 0 }, { 7, 0, 0 }, { 0, 7, 0 }, 3)
    : MakeRoom(3, 1 + random.Below(3));
  SetCellValues(ground, "Albedo", { 0.3 });
  SetCellValues(ground, "Gloss", { 0.4 });
  model.Ports[0] = { { ground, nullptr, {} },
    { MakeLamp({ 1.5, 1.5, 2.75 }, 0.75, RandomTuple(random, 100)), nullptr, {} } };
  if (Chance(random, 4)) // walls that shine, more or less than what they reflect
  {
    SetCellValues(
      ground, "RadiantExitance", Scaled(RandomTuple(random, 30), RandomWeakness(random)));
  }
  if (Chance(random, 4)) // a lamp of many facets, behind a louvre or not
  {
    Mesh bulb = MakeBall(0.125, 8 + random.Below(8));
    SetCellValues(bulb, "RadiantExitance", RandomTuple(random, 300));
    for (vtkIdType point = 0; point < bulb->GetNumberOfPoints(); ++point)
    {
      const double* const place = bulb->GetPoint(point);
      bulb->GetPoints()->SetPoint(point, place[0] + 1, place[1] + 1.25, place[2] + 2.25);
    }
    model.Ports[0].push_back({ bulb, nullptr, {} });
    for (int i = random.Below(4); i > 0; --i)
    {
      model.Ports[0].push_back(
        { MakeRectangle({ 0.5 + 0.25 * i, 0.5, 2 }, { 0, 2, 0 }, { 0, 0, 0.125 }, 2), nullptr,
          {} });
    }
  }
  if (Chance(random, 3))
  {
    model.Ports[0].push_back({ Placed(RandomLuminaire(random), 1, { 2, 1, 2.5 }), nullptr, {} });
  }
  if (hasSky)
  {
    model.Ports[0].push_back({ RandomSky(random), nullptr, {} });
  }
  for (int i = 0; i < 4; ++i)
  {
    auto pose = vtkSmartPointer<vtkTransform>::New();
    pose->Translate(RandomPlace(random).data());
    model.Ports[1].push_back({ RandomData(random), pose, {} });
  }
  model.Ports[1].push_back({ RandomData(random), nullptr, RandomRide(random) });
  if (!hasSky && Chance(random, 6))
  {
    const double far = std::pow(10, 1 + random.Below(7));
    model.Ports[0].push_back(
      { MakePointLight({ 0.3 * far, 0.4 * far, far }, { 100 * far * far }), nullptr, {} });
  }
  model.Set.NumberOfWalks = 500 + random.Below(1500);
  model.Look = RandomView(random);
  return model;
}

}
