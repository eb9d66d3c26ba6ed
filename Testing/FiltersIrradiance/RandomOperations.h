// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RandomEdits.h"

#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <limits>

/// What else users do to a filter, and the table of all operations.
namespace RandomPrograms
{

// Settings.

inline void ChangeSamples(Trial& t)
{
  t.Set().NumberOfWalks = 500 + t.Random.Below(2500);
  t.Set().Seed = t.Random.Below(5);
  t.Apply();
}

inline void ChangeModes(Trial& t)
{
  t.Set().TraversalMode = t.Random.Below(3);
  t.Set().UpdateMode =
    Chance(t.Random, 8) ? vtkIrradianceFilter::Rebuild : vtkIrradianceFilter::Verify;
  t.Set().CacheStaticHits = Chance(t.Random, 2);
  t.Given.NumberOfThreads = 1 + t.Random.Below(2);
  t.Apply();
}

inline void ChangeOutput(Trial& t)
{
  t.Set().SeparateSides = Chance(t.Random, 2);
  t.Set().ComputeStandardError = Chance(t.Random, 2);
  t.Apply();
}

inline void ChangeEstimate(Trial& t)
{
  const int estimates[] = { vtkIrradianceFilter::Sums, vtkIrradianceFilter::Spread,
    vtkIrradianceFilter::FinalGather, vtkIrradianceFilter::AutomaticEstimate };
  t.Set().CellEstimate = estimates[t.Random.Below(4)];
  t.Set().NumberOfSpreadPhotons = 1 << t.Random.Below(10);
  t.Set().NumberOfGatherRays = 1 << t.Random.Below(6);
  t.Set().MaximumNumberOfGatherRays = t.Set().NumberOfGatherRays << t.Random.Below(4);
  t.Set().GatherOn = t.Random.Below(2) * vtkIrradianceFilter::AllCells;
  t.Set().UnbiasedGather = Chance(t.Random, 4);
  t.Apply();
}

inline void ChangeDirectLight(Trial& t)
{
  t.Set().DirectLight = t.Random.Below(3);
  t.Apply();
}

inline void ChangeTarget(Trial& t)
{
  static const int replicates[] = { 2, 5, 16, 40 };
  t.Set().NumberOfReplicates = replicates[t.Random.Below(4)];
  t.Set().TargetRelativeError = Chance(t.Random, 2) ? t.Random.Between(0.2, 1) : 0;
  t.Set().MaximumNumberOfWalks =
    std::max<vtkIdType>(3000, t.Set().NumberOfWalks) + t.Random.Below(4000);
  t.Apply();
}

inline void ChangeReflectances(Trial& t)
{
  t.Set().DefaultDiffuseReflectance = t.Random.Between(0, 0.9);
  t.Set().ReflectanceArray = Chance(t.Random, 2) ? "Albedo" : "DiffuseReflectance";
  t.Set().SpecularArray = Chance(t.Random, 4) ? "Gloss" : "SpecularReflectance";
  t.Apply();
}

inline void ChangeFactors(Trial& t)
{
  static const double factors[] = { 0, 1, 1, 0.3 };
  t.Set().FactorOfStatic = factors[t.Random.Below(4)];
  t.Set().ComputeLightGroups = Chance(t.Random, 2);
  t.Apply();
}

inline void ChangeBudget(Trial& t)
{
  static const double budgets[] = { 0, 1e-9, 1e-9, 1e-4 }; // s
  t.Set().RepairTimeBudget = budgets[t.Random.Below(4)];
  t.Apply();
}

/// All walks, or those that touch a cell; it may be gone later, see Trial::KeepCellOfWalks.
inline void ChangeWalks(Trial& t)
{
  t.Set().NumberOfOutputWalks = Chance(t.Random, 3) ? 0 : 1 << t.Random.Below(13);
  t.Set().OutputWalksPort = t.Random.Below(2);
  const auto& connections = t.Given.Ports[t.Set().OutputWalksPort];
  t.Set().OutputWalksConnection = t.Random.Below(static_cast<int>(connections.size()));
  t.Set().OutputWalksCell = Chance(t.Random, 2) ? -1 : t.Random.Below(8);
  t.Apply();
}

// Views.

inline void MoveTheEye(Trial& t)
{
  MoveEye(t.Random, t.Given.Look);
}

inline void ChangeTheSensors(Trial& t)
{
  ChangeSensors(t.Random, t.Given.Look);
  ChangePoints(t.Random, t.Given.Look);
}

/// With it, what it collects of the filter's photons.
inline void AbortAView(Trial& t)
{
  MoveAPose(t);
  MoveTheEye(t);
  vtkAlgorithm* const views[] = { t.Views.Radiance, t.Views.Probe };
  for (vtkAlgorithm* view : views)
  {
    const auto meddler = EventObserver::Watch(view);
    meddler->EventsToWait = t.Random.Below(4);
    meddler->Change = [view] { view->SetAbortExecute(1); };
    t.LimitGloss();
    t.DropFinalGather();
    t.Look();
    view->RemoveObserver(meddler);
    view->SetAbortExecute(0);
    view->Modified(); // else it keeps the empty output
    t.Done.Aborts += !meddler->Change;
  }
  t.MustCompare = true;
}

/// On the cells of what the filter put out last.
inline void PutSensorsOnCells(Trial& t)
{
  auto leaves = LeavesOf(t.Filter->GetOutput());
  if (!leaves.empty())
  {
    t.Given.Look.Sensors = SensorsOn(t.Random, Pick(t.Random, leaves));
    t.Given.Look.HasSensors = true;
  }
}

// Executions.

/// A moving leaf goes, its arrays stay without values, and after some updates, with other poses,
/// estimates, outputs and views, it comes back, or something else does.
inline void GoAndComeBack(Trial& t)
{
  static void (*const changes[])(Trial&) = { ChangeEstimate, ChangeOutput, ChangeTarget,
    ChangeBudget, ChangeModes, MoveTheEye, ChangeTheSensors };
  Connection& moving = Pick(t.Random, t.Moving());
  auto leaves = LeavesOf(moving.Data);
  if (leaves.empty())
  {
    return;
  }
  vtkPolyData* leaf = Pick(t.Random, leaves);
  const Mesh model = Copy(leaf);
  const auto nothing = Mesh::New();
  nothing->GetCellData()->CopyAllOn();
  nothing->GetCellData()->CopyAllocate(model->GetCellData(), 0);
  if (Chance(t.Random, 2))
  {
    nothing->GetFieldData()->DeepCopy(model->GetFieldData());
  }
  leaf->DeepCopy(nothing);
  for (int updates = 1 + t.Random.Below(2); updates > 0 && !testing::Test::HasFailure(); --updates)
  {
    moving.Data->Modified();
    if (Chance(t.Random, 2))
    {
      changes[t.Random.Below(7)](t);
    }
    t.UpdateAndCheck();
    MoveAPose(t);
  }
  leaf->DeepCopy(Chance(t.Random, 4) ? RandomMesh(t.Random) : model);
  moving.Data->Modified();
}

inline void SayModified(Trial& t)
{
  t.Filter->Modified();
}

/// The last progress event, 1, is the executive's and comes too late to abort.
inline void Abort(Trial& t)
{
  MoveAPose(t);
  t.Filter->Modified();
  if (t.UpdateAndMeddle([&] { t.Filter->SetAbortExecute(1); }))
  {
    EXPECT_TRUE(t.Filter->GetOutput()->GetNumberOfBlocks() == 0 || t.MeddledAt == 1)
      << "aborted at " << t.MeddledAt;
    ++t.Done.Aborts;
  }
  t.Filter->SetAbortExecute(0);
  t.Filter->Modified();
  t.MustCompare = true;
}

inline void MeddleWhileItRuns(Trial& t)
{
  static void (*const changes[])(Trial&) = { MoveAPose, TouchSomething, ReplaceOrRemoveAPose,
    ChangeSamples, ChangeAValue, ChangeAPoseField };
  t.Filter->Modified();
  const auto change = changes[t.Random.Below(6)];
  const bool isDone = t.UpdateAndMeddle([&] { change(t); });
  t.Done.Meddlings += isDone;
  if (!isDone) // few events come in little time; the scene depends on no clock
  {
    change(t);
  }
  t.MustCompare = true;
}

// Bad input, for one update.

/// A random cell; -1 if it is a ghost and takes no part.
inline vtkIdType PickCell(Trial& t, vtkPolyData* mesh)
{
  const vtkIdType cell = t.Random.Below(static_cast<int>(mesh->GetNumberOfCells()));
  vtkUnsignedCharArray* ghosts = mesh->GetCellGhostArray();
  return ghosts && ghosts->GetValue(cell) != 0 ? -1 : cell;
}

inline void SpoilAPoint(Trial& t)
{
  const Leaf leaf = t.PickLeaf(true);
  vtkNew<vtkIdList> ids;
  PointsOfPolygon(leaf.Mesh, PickCell(t, leaf.Mesh), ids);
  if (ids->GetNumberOfIds() > 0)
  {
    double old[3];
    leaf.Mesh->GetPoint(ids->GetId(0), old);
    const auto set = [&](double x) {
      leaf.Mesh->GetPoints()->SetPoint(ids->GetId(0), x, old[1], old[2]);
      leaf.Mesh->GetPoints()->Modified();
      leaf.Modified();
    };
    set(std::numeric_limits<double>::quiet_NaN());
    t.ExpectOneError();
    set(old[0]);
  }
}

inline void SpoilAReflectance(Trial& t)
{
  const Leaf leaf = t.PickLeaf(true);
  const vtkIdType cell = PickCell(t, leaf.Mesh);
  if (cell >= 0)
  {
    const bool isDiffuse = Chance(t.Random, 2);
    const std::string name = isDiffuse ? t.Set().ReflectanceArray : t.Set().SpecularArray;
    vtkCellData* cells = leaf.Mesh->GetCellData();
    const vtkSmartPointer<vtkDataArray> old = cells->GetArray(name.c_str());
    SetCellValues(leaf.Mesh, name.c_str(), { isDiffuse ? 0.5 : 0.01 });
    cells->GetArray(name.c_str())->SetComponent(cell, 0, 1.5);
    leaf.Modified();
    t.ExpectOneError();
    old ? static_cast<void>(cells->AddArray(old)) : cells->RemoveArray(name.c_str());
    leaf.Modified();
  }
}

/// Of a lamp with a table, or the sky.
inline void SpoilALight(Trial& t)
{
  std::vector<Leaf> lights;
  t.ForEachMesh([&](const Leaf& leaf) {
    const bool isThere = leaf.Mesh->GetNumberOfCells() > 0 && !t.HasLeft(*leaf.In);
    if (IsSky(leaf.Mesh) || (HasTable(leaf.Mesh) && isThere))
    {
      lights.push_back(leaf);
    }
  });
  if (!lights.empty())
  {
    const Leaf leaf = Pick(t.Random, lights);
    const char* const name = IsSky(leaf.Mesh) ? "SunIrradiance" : "PolarAngles";
    vtkFieldData* fields = leaf.Mesh->GetFieldData();
    const vtkSmartPointer<vtkDataArray> old = fields->GetArray(name);
    SetFieldTuple(leaf.Mesh, name, { -1 });
    leaf.Modified();
    t.ExpectOneError();
    fields->AddArray(old);
    leaf.Modified();
  }
}

/// A singular pose, of a dynamic connection or of one past the last.
inline void SpoilAPose(Trial& t)
{
  const int i = t.Random.Below(static_cast<int>(t.Moving().size()) + 1);
  vtkNew<vtkTransform> pose;
  pose->Scale(1, 0, 1);
  t.Filter->SetDynamicTransform(i, pose);
  t.ExpectOneError();
  const auto index = static_cast<std::size_t>(i);
  t.Filter->SetDynamicTransform(
    i, index < t.Moving().size() ? t.Moving()[index].Pose.Get() : nullptr);
}

inline void SpoilALeaf(Trial& t)
{
  const int port = t.Random.Below(2);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(1, vtkNew<vtkUnstructuredGrid>());
  t.Filter->AddInputDataObject(port, blocks);
  t.ExpectOneError();
  t.Filter->RemoveInputConnection(port, static_cast<int>(t.Given.Ports[port].size()));
}

inline void SpoilASetting(Trial& t)
{
  switch (t.Random.Below(6))
  {
    case 0:
      t.Filter->SetNumberOfWalks(0);
      break;
    case 1:
      t.Filter->SetRepairTimeBudget(-1);
      break;
    case 2:
      t.Filter->SetNumberOfSpreadPhotons(0);
      break;
    case 3:
      t.Filter->SetCellEstimateToGathered();
      t.Filter->SetDirectLightToShot();
      break;
    case 4:
      t.Filter->SetNumberOfOutputWalks(1);
      t.Filter->SetOutputWalksCell(1000000);
      t.Filter->SetOutputWalksConnection(t.Random.Below(2));
      t.Filter->SetOutputWalksPort(2);
      break;
    default:
      ChooseArray(t.Filter, 1 + t.Random.Below(2), "NoSuchArray");
  }
  t.ExpectOneError();
  t.Apply();
}

struct Operation
{
  const char* Name;
  void (*Do)(Trial&);
  int Weight;
};

inline const Operation Operations[] = { { "MoveAPose", MoveAPose, 18 },
  { "ReplaceOrRemoveAPose", ReplaceOrRemoveAPose, 3 }, { "ChangeAPoseField", ChangeAPoseField, 4 },
  { "ChangeALightGroup", ChangeALightGroup, 4 }, { "ChangeFactors", ChangeFactors, 4 },
  { "TouchSomething", TouchSomething, 14 }, { "GoWhereAnotherIs", GoWhereAnotherIs, 3 },
  { "GoFarAway", GoFarAway, 3 }, { "GoToAnotherTime", GoToAnotherTime, 8 },
  { "ChangeARide", ChangeARide, 2 }, { "GoAndComeBack", GoAndComeBack, 6 }, { "Deform", Deform, 6 },
  { "TakeANewShape", TakeANewShape, 2 }, { "SetAnArray", SetAnArray, 2 },
  { "SetGloss", SetGloss, 3 }, { "ChangeExponents", ChangeExponents, 3 },
  { "RemoveGloss", RemoveGloss, 2 }, { "ChangeAValue", ChangeAValue, 2 },
  { "RemoveAnArray", RemoveAnArray, 1 }, { "ChangeLuminaires", ChangeLuminaires, 5 },
  { "ChangeTheSky", ChangeTheSky, 5 }, { "ChangeGhosts", ChangeGhosts, 2 },
  { "ChangeBlocks", ChangeBlocks, 3 }, { "AddConnection", AddConnection, 4 },
  { "RemoveConnection", RemoveConnection, 3 }, { "ChangeSamples", ChangeSamples, 1 },
  { "ChangeModes", ChangeModes, 3 }, { "ChangeOutput", ChangeOutput, 2 },
  { "ChangeEstimate", ChangeEstimate, 4 }, { "ChangeDirectLight", ChangeDirectLight, 6 },
  { "ChangeTarget", ChangeTarget, 2 }, { "ChangeReflectances", ChangeReflectances, 1 },
  { "ChangeBudget", ChangeBudget, 6 }, { "ChangeWalks", ChangeWalks, 4 },
  { "MoveTheEye", MoveTheEye, 3 }, { "ChangeTheSensors", ChangeTheSensors, 3 },
  { "PutSensorsOnCells", PutSensorsOnCells, 3 }, { "AbortAView", AbortAView, 2 },
  { "SayModified", SayModified, 2 }, { "Abort", Abort, 3 },
  { "MeddleWhileItRuns", MeddleWhileItRuns, 4 }, { "SpoilAPoint", SpoilAPoint, 1 },
  { "SpoilAReflectance", SpoilAReflectance, 1 }, { "SpoilALight", SpoilALight, 1 },
  { "SpoilAPose", SpoilAPose, 1 }, { "SpoilALeaf", SpoilALeaf, 1 },
  { "SpoilASetting", SpoilASetting, 1 } };

}
