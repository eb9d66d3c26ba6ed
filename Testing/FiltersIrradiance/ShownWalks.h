// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "OutputBits.h"

#include "vtkPhotonWalksFilter.h"

#include <map>
#include <set>

/// What a vtkPhotonWalksFilter shows.
namespace ShownWalks
{

using namespace TestScenes;

constexpr vtkIdType All = 1000000; ///< more than any test shoots

struct Walk
{
  std::vector<Vector> Points;
  std::vector<bool> IsNew; ///< of each point: whether the segment before it was shot again
  std::vector<double> Power;
  bool Repaired, Escaped, Stale;
};

/// By WalkId.
using Walks = std::map<vtkIdType, Walk>;
using Ids = std::set<vtkIdType>;

inline Walks WalksOf(vtkPolyData* shown)
{
  Walks walks;
  vtkCellData* cells = shown->GetCellData();
  vtkPointData* points = shown->GetPointData();
  vtkDataArray* power = cells->GetArray("Power");
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < shown->GetNumberOfCells(); ++i)
  {
    const auto flag = [&](const char* name) {
      return cells->HasArray(name) && cells->GetArray(name)->GetComponent(i, 0) != 0;
    };
    Walk walk{ {}, {}, {}, flag("Repaired"), flag("Escaped"), flag("Stale") };
    shown->GetCellPoints(i, ids);
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
    {
      Vector point;
      shown->GetPoint(ids->GetId(k), point.data());
      walk.Points.push_back(point);
      walk.IsNew.push_back(points->GetArray("Repaired")->GetComponent(ids->GetId(k), 0) != 0);
      EXPECT_EQ(points->GetArray("Bounce")->GetComponent(ids->GetId(k), 0), k);
    }
    for (int band = 0; band < power->GetNumberOfComponents(); ++band)
    {
      walk.Power.push_back(power->GetComponent(i, band));
    }
    const auto id = static_cast<vtkIdType>(cells->GetArray("WalkId")->GetComponent(i, 0));
    EXPECT_TRUE(walks.emplace(id, walk).second) << "walk " << id << " is there twice";
  }
  return walks;
}

/// A filter, and one that shows its walks.
struct Showing
{
  vtkSmartPointer<vtkIrradianceFilter> Light;
  vtkSmartPointer<vtkPhotonWalksFilter> Shown = vtkSmartPointer<vtkPhotonWalksFilter>::New();

  vtkIrradianceFilter* operator->() const { return this->Light; }
  void Update() const { this->Shown->Update(); }
  /// When the light was computed.
  vtkMTimeType Time() const { return this->Light->GetOutput()->GetUpdateTime(); }
};

inline Walks UpdatedWalks(const Showing& showing)
{
  showing.Update();
  return WalksOf(showing.Shown->GetOutput());
}

inline Ids IdsOf(const Walks& walks)
{
  Ids ids;
  for (const auto& [id, walk] : walks)
  {
    ids.insert(id);
  }
  return ids;
}

inline Ids RepairedOf(const Walks& walks)
{
  Ids ids;
  for (const auto& [id, walk] : walks)
  {
    if (walk.Repaired)
    {
      ids.insert(id);
    }
  }
  return ids;
}

/// Walks of a filter that shows them.
constexpr vtkIdType NumberOfWalks = 1500;

inline Showing MakeShowing(const Scene& scene, vtkIdType shown = All)
{
  Showing showing{ MakeFilter(scene, NumberOfWalks) };
  showing.Shown->SetInputConnection(showing.Light->GetOutputPort());
  showing.Shown->SetNumberOfWalks(shown);
  return showing;
}

inline bool HasShot(const Showing& showing)
{
  return Field(showing.Light, "ShootSeconds") > 0;
}

/// Without walls: most light escapes.
inline Scene MakeOpenScene()
{
  Scene scene = MakeSmallScene();
  scene.Fixed[0] = MakeRectangle({ 0, 0, 0 }, { 3, 0, 0 }, { 0, 3, 0 }, 3);
  return scene;
}

/// Asks for all walks that touch a cell, then for what was asked before.
inline Ids Touching(const Showing& showing, int port, int connection, vtkIdType cell)
{
  const vtkIdType count = showing.Shown->GetNumberOfWalks();
  showing.Shown->SetNumberOfWalks(All);
  showing.Shown->SetCellPort(port);
  showing.Shown->SetCellConnection(connection);
  showing.Shown->SetCell(cell);
  const Ids ids = IdsOf(UpdatedWalks(showing));
  showing.Shown->SetNumberOfWalks(count);
  showing.Shown->SetCell(-1);
  showing.Update();
  return ids;
}

/// Those that touch any cell of a connection.
inline Ids Touching(const Showing& showing, int port, int connection)
{
  Ids all;
  vtkPolyData* part = OutputOf(showing.Light->GetOutput(), static_cast<unsigned int>(port),
    static_cast<unsigned int>(connection));
  const vtkIdType cells = part->GetNumberOfCells();
  for (vtkIdType cell = 0; cell < cells; ++cell)
  {
    const Ids some = Touching(showing, port, connection, cell);
    all.insert(some.begin(), some.end());
  }
  return all;
}

/// All but what tells how the walks came about.
inline OutputBits LastingBits(vtkPolyData* walks)
{
  vtkNew<vtkPolyData> shown;
  shown->ShallowCopy(walks);
  shown->GetCellData()->RemoveArray("Repaired");
  shown->GetPointData()->RemoveArray("Repaired");
  return OutputBits(shown);
}

}
