// SPDX-License-Identifier: BSD-3-Clause
#ifndef RandomOperations_h
#define RandomOperations_h

#include "RandomEdits.h"

#include "vtkUnstructuredGrid.h"

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
  t.Set().CellEstimate = t.Random.Below(2);
  t.Set().NumberOfSpreadPhotons = 1 << t.Random.Below(10);
  t.Apply();
}

inline void ChangeTarget(Trial& t)
{
  static const int replicates[] = { 2, 5, 16, 40 };
  t.Set().NumberOfReplicates = replicates[t.Random.Below(4)];
  t.Set().TargetRelativeError = Chance(t.Random, 2) ? t.Random.Between(0.2, 1) : 0;
  t.Set().MaximumNumberOfWalks = 3000 + t.Random.Below(4000);
  t.Apply();
}

inline void ChangeReflectances(Trial& t)
{
  t.Set().DefaultDiffuseReflectance = t.Random.Between(0, 0.9);
  t.Set().ReflectanceArray = Chance(t.Random, 2) ? "Albedo" : "DiffuseReflectance";
  t.Apply();
}

inline void ChangeBudget(Trial& t)
{
  static const double budgets[] = { 0, 1e-9, 1e-9, 1e-4 }; // s
  t.Set().RepairTimeBudget = budgets[t.Random.Below(4)];
  t.Apply();
}

// Executions.

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
    EXPECT_TRUE(t.Filter->GetOutput()->GetNumberOfBlocks() == 0 || t.Observer->Progress == 1)
      << "aborted at " << t.Observer->Progress;
    ++t.Done.Aborts;
  }
  t.Filter->Modified();
  t.MustCompare = true;
}

inline void MeddleWhileItRuns(Trial& t)
{
  static void (*const changes[])(Trial&) = { MoveAPose, TouchSomething, ReplaceOrRemoveAPose,
    ChangeSamples, ChangeAValue, ChangeAPoseField };
  t.Filter->Modified();
  const auto change = changes[t.Random.Below(6)];
  t.Done.Meddlings += t.UpdateAndMeddle([&] { change(t); });
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
  const vtkIdType cell = PickCell(t, leaf.Mesh);
  if (cell >= 0)
  {
    vtkNew<vtkIdList> ids;
    leaf.Mesh->GetCellPoints(cell, ids);
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
    const char* name = t.Set().ReflectanceArray.c_str();
    vtkCellData* cells = leaf.Mesh->GetCellData();
    const vtkSmartPointer<vtkDataArray> old = cells->GetArray(name);
    SetCellValues(leaf.Mesh, name, { 0.5 });
    cells->GetArray(name)->SetComponent(cell, 0, 1.5);
    leaf.Modified();
    t.ExpectOneError();
    old ? static_cast<void>(cells->AddArray(old)) : cells->RemoveArray(name);
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
  switch (t.Random.Below(4))
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
    default:
      ChooseReflectance(t.Filter, "NoSuchArray");
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
  { "TouchSomething", TouchSomething, 14 }, { "GoWhereAnotherIs", GoWhereAnotherIs, 3 },
  { "GoFarAway", GoFarAway, 3 }, { "Deform", Deform, 6 }, { "TakeANewShape", TakeANewShape, 2 },
  { "SetAnArray", SetAnArray, 2 }, { "ChangeAValue", ChangeAValue, 2 },
  { "RemoveAnArray", RemoveAnArray, 1 }, { "ChangeGhosts", ChangeGhosts, 2 },
  { "ChangeBlocks", ChangeBlocks, 3 }, { "AddConnection", AddConnection, 4 },
  { "RemoveConnection", RemoveConnection, 3 }, { "ChangeSamples", ChangeSamples, 1 },
  { "ChangeModes", ChangeModes, 3 }, { "ChangeOutput", ChangeOutput, 2 },
  { "ChangeEstimate", ChangeEstimate, 2 }, { "ChangeTarget", ChangeTarget, 2 },
  { "ChangeReflectances", ChangeReflectances, 1 }, { "ChangeBudget", ChangeBudget, 6 },
  { "SayModified", SayModified, 2 }, { "Abort", Abort, 3 },
  { "MeddleWhileItRuns", MeddleWhileItRuns, 4 }, { "SpoilAPoint", SpoilAPoint, 1 },
  { "SpoilAReflectance", SpoilAReflectance, 1 }, { "SpoilAPose", SpoilAPose, 1 },
  { "SpoilALeaf", SpoilALeaf, 1 }, { "SpoilASetting", SpoilASetting, 1 } };

}

#endif
