// SPDX-License-Identifier: BSD-3-Clause
// Walks to look at are those that were shot, and which of them touch a cell.

#include "ErrorObserver.h"
#include "ShownWalks.h"

#include "vtkAppendPolyData.h"
#include "vtkCompositeDataSet.h"
#include "vtkGenericCell.h"
#include "vtkSMPTools.h"
#include "vtkStaticCellLocator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

using namespace ShownWalks;

namespace
{

/// Everything that light can hit, as VTK sees it.
class Surroundings
{
public:
  explicit Surroundings(vtkMultiBlockDataSet* output)
  {
    vtkNew<vtkAppendPolyData> append;
    append->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    for (const unsigned int port : { 0u, 1u })
    {
      auto* blocks = vtkMultiBlockDataSet::SafeDownCast(output->GetBlock(port));
      for (unsigned int i = 0; i < blocks->GetNumberOfBlocks(); ++i)
      {
        append->AddInputData(OutputOf(output, port, i));
      }
    }
    append->Update();
    this->Meshes = append->GetOutput();
    this->Locator->SetDataSet(this->Meshes);
    this->Locator->BuildLocator();
  }

  /// Whether a straight line runs from a point to the other without hitting anything on its way.
  bool IsFree(const Vector& from, const Vector& to) const
  {
    constexpr double near = 1e-4;
    Vector begin, end, at, parameters;
    for (std::size_t i = 0; i < 3; ++i)
    {
      begin[i] = from[i] + near * (to[i] - from[i]);
      end[i] = to[i] + near * (from[i] - to[i]);
    }
    double t = 0;
    int part = 0;
    return this->Locator->IntersectWithLine(
             begin.data(), end.data(), 0, t, at.data(), parameters.data(), part) == 0;
  }

  double DistanceTo(const Vector& point) const
  {
    Vector closest;
    vtkIdType cell = 0;
    int part = 0;
    double squared = 0;
    this->Locator->FindClosestPoint(point.data(), closest.data(), cell, part, squared);
    return std::sqrt(squared);
  }

  const double* Bounds() const { return this->Meshes->GetBounds(); }

private:
  Mesh Meshes;
  vtkNew<vtkStaticCellLocator> Locator;
};

double DistanceToCell(vtkPolyData* mesh, vtkIdType number, const Vector& point)
{
  vtkNew<vtkGenericCell> cell;
  mesh->GetCell(number, cell);
  Vector closest, parameters;
  int part = 0;
  double squared = 0;
  std::vector<double> weights(static_cast<std::size_t>(cell->GetNumberOfPoints()));
  cell->EvaluatePosition(
    point.data(), closest.data(), part, parameters.data(), squared, weights.data());
  return std::sqrt(squared);
}

/// By looking at all points of all walks.
Ids TouchingByDistance(const Walks& walks, vtkPolyData* mesh, vtkIdType cell, double within)
{
  Ids ids;
  for (const auto& [id, walk] : walks)
  {
    const auto end = walk.Points.end() - (walk.Escaped ? 1 : 0);
    if (std::any_of(walk.Points.begin(), end,
          [&](const Vector& point) { return DistanceToCell(mesh, cell, point) <= within; }))
    {
      ids.insert(id);
    }
  }
  return ids;
}

bool Contains(const Ids& all, const Ids& some)
{
  return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

}

TEST(PhotonWalks, ChangeNothingElse)
{
  Scene scene = MakeSmallScene();
  for (const bool isStatic : { false, true })
  {
    if (isStatic)
    {
      scene.Moving.clear();
    }
    const auto filter = MakeFilter(scene, NumberOfWalks);
    const Showing showing = MakeShowing(scene);
    filter->Update();
    showing.Update();
    EXPECT_EQ(showing.Shown->GetOutput()->GetNumberOfCells(), NumberOfWalks);
    EXPECT_TRUE(IsSame(OutputBits(filter), OutputBits(showing.Light)));
    EXPECT_EQ(Field(filter, "HistoryBytes"), isStatic ? 0 : Field(showing.Light, "HistoryBytes"));
    EXPECT_GT(Field(showing.Light, "HistoryBytes"), 0);
  }
}

// Output port 1, the old way to them.
TEST(PhotonWalks, OfTheOldPortAreTheSame)
{
  Scene scene = MakeSmallScene();
  const Showing showing = MakeShowing(scene, 300);
  const auto old = MakeFilter(scene, NumberOfWalks);
  const auto reports = ErrorObserver::Watch(old);
  old->SetNumberOfOutputWalks(300);
  old->SetNumberOfOutputWalks(200);
  old->SetNumberOfOutputWalks(300);
  ExpectOne(reports->Warnings, { "vtkPhotonWalksFilter" });
  for (int frame = 0; frame < 2; ++frame)
  {
    showing.Update();
    old->Update();
    EXPECT_EQ(old->GetWalksOutput()->GetNumberOfCells(), 300);
    EXPECT_TRUE(IsSame(OutputBits(old->GetWalksOutput()), OutputBits(showing.Shown->GetOutput())));
    scene.Moving[0].Pose->Translate(0.2, -0.1, 0.15);
  }
}

TEST(PhotonWalks, AreTheFirstForAnyNumberOfThreads)
{
  const Scene scene = MakeOpenScene();
  const auto all = MakeShowing(scene);
  const Walks walks = UpdatedWalks(all);
  EXPECT_EQ(walks.size(), static_cast<std::size_t>(NumberOfWalks));
  EXPECT_EQ(walks.rbegin()->first, NumberOfWalks - 1);
  const auto some = MakeShowing(scene, 200);
  vtkSMPTools::LocalScope(vtkSMPTools::Config{ 1, "STDThread", false }, [&] { some.Update(); });
  const Walks first = WalksOf(some.Shown->GetOutput());
  EXPECT_EQ(first.size(), 200u);
  EXPECT_EQ(first.rbegin()->first, 199);
  for (const auto& [id, walk] : first)
  {
    EXPECT_EQ(walk.Points, walks.at(id).Points);
  }
}

TEST(PhotonWalks, CarryTheEmittedPower)
{
  for (const bool isColoured : { false, true })
  {
    const Scene scene = MakeOpenScene();
    if (isColoured)
    {
      SetCellValues(scene.Fixed[1], "RadiantExitance", { 50, 100, 25 });
    }
    const auto filter = MakeShowing(scene);
    std::vector<double> sum(isColoured ? 3 : 1), escaped(sum);
    for (const auto& [id, walk] : UpdatedWalks(filter))
    {
      ASSERT_EQ(walk.Power.size(), sum.size());
      for (std::size_t band = 0; band < sum.size(); ++band)
      {
        sum[band] += walk.Power[band];
        escaped[band] += walk.Escaped ? walk.Power[band] : 0;
      }
    }
    for (int band = 0; band < static_cast<int>(sum.size()); ++band)
    {
      const double emitted = Field(filter.Light, "EmittedPower", band);
      EXPECT_NEAR(sum[static_cast<std::size_t>(band)], emitted, 1e-9 * emitted);
    }
    if (!isColoured) // reflections change no power
    {
      EXPECT_NEAR(escaped[0], Field(filter.Light, "EscapedPower"), 1e-12 * sum[0]);
    }
  }
}

// VTK's own search of the output's meshes knows nothing of trees, histories and samples.
TEST(PhotonWalks, RunFromTheLampFromHitToHit)
{
  const Scene scene = MakeOpenScene();
  const auto filter = MakeShowing(scene, 400);
  filter->ComputeStandardErrorOn(); // each replicate has samples of its own
  filter.Update();
  scene.Moving[0].Pose->Translate(0.4, 0.3, 0.2);
  const Walks walks = UpdatedWalks(filter);
  const Surroundings all(filter->GetOutput());
  int escapes = 0, hits = 0;
  for (const auto& [id, walk] : walks)
  {
    SCOPED_TRACE(id);
    ASSERT_GE(walk.Points.size(), 2u);
    EXPECT_NEAR(walk.Points[0][2], 2.875, 1e-6);
    EXPECT_LE(
      std::max(std::abs(walk.Points[0][0] - 1.5), std::abs(walk.Points[0][1] - 1.5)), 0.375);
    for (std::size_t i = 1; i < walk.Points.size(); ++i)
    {
      const bool isEnd = walk.Escaped && i + 1 == walk.Points.size();
      EXPECT_TRUE(isEnd || all.DistanceTo(walk.Points[i]) < 1e-6);
      EXPECT_TRUE(all.IsFree(walk.Points[i - 1], walk.Points[i])) << "segment " << i;
      hits += !isEnd;
    }
    escapes += walk.Escaped;
  }
  EXPECT_GT(escapes, 100);
  EXPECT_GT(hits, 80);
}

TEST(PhotonWalks, ThatEscapeEndBeyondTheScene)
{
  const auto filter = MakeShowing(MakeOpenScene());
  const Walks walks = UpdatedWalks(filter);
  const Surroundings all(filter->GetOutput());
  double bounds[6], diagonal = 0;
  std::copy_n(all.Bounds(), 6, bounds);
  for (int axis = 0; axis < 3; ++axis)
  {
    diagonal = std::hypot(diagonal, bounds[2 * axis + 1] - bounds[2 * axis]);
  }
  int escapes = 0;
  for (const auto& [id, walk] : walks)
  {
    double outside = -1;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double x = walk.Points.back()[axis];
      outside = std::max({ outside, bounds[2 * axis] - x, x - bounds[2 * axis + 1] });
    }
    EXPECT_NEAR(outside, walk.Escaped ? diagonal / 8 : 0, walk.Escaped ? 1e-6 : 3) << id;
    EXPECT_TRUE(walk.Escaped || outside < 1e-6) << id;
    escapes += walk.Escaped;
  }
  EXPECT_GT(escapes, NumberOfWalks / 4);
}

TEST(PhotonWalks, TouchTheChosenCell)
{
  Scene scene = MakeSmallScene();
  scene.Fixed.push_back(MakePointLight({ 0.5, 2.5, 0.5 }, { 30 }));
  const auto filter = MakeShowing(scene);
  const Walks walks = UpdatedWalks(filter);
  const vtkMTimeType time = filter.Time();
  int cells = 0;
  for (const int port : { 0, 1 })
  {
    const auto connections = static_cast<int>(port == 0 ? scene.Fixed.size() : scene.Moving.size());
    for (int i = 0; i < connections; ++i)
    {
      const Mesh mesh = Copy(OutputOf(
        filter->GetOutput(), static_cast<unsigned int>(port), static_cast<unsigned int>(i)));
      for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); cell += 2)
      {
        SCOPED_TRACE(std::to_string(port) + " " + std::to_string(i) + " " + std::to_string(cell));
        const Ids touching = Touching(filter, port, i, cell);
        // A point on an edge belongs to one of two cells.
        EXPECT_TRUE(Contains(TouchingByDistance(walks, mesh, cell, 1e-6), touching));
        const Ids near = TouchingByDistance(walks, mesh, cell, 1e-8);
        EXPECT_LE(near.size(), touching.size() + 1);
        cells += !touching.empty();
      }
    }
  }
  EXPECT_GT(cells, 50);
  EXPECT_EQ(filter.Time(), time) << "light was computed for other walks";
}

TEST(PhotonWalks, OfACellAreTheFirstThatTouchIt)
{
  const auto filter = MakeShowing(MakeSmallScene());
  const Ids all = Touching(filter, 0, 0, 4); // in the middle of the floor
  ASSERT_GT(all.size(), 20u);
  filter.Shown->SetCell(4);
  for (const vtkIdType count : { 1, 20 })
  {
    filter.Shown->SetNumberOfWalks(count);
    const Ids some = IdsOf(UpdatedWalks(filter));
    EXPECT_EQ(some, Ids(all.begin(), std::next(all.begin(), count)));
  }
}

TEST(PhotonWalks, NumberTheCellsOfACompositeConnectionFromLeafToLeaf)
{
  const Scene parts = MakeSmallScene();
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, parts.Fixed[1]); // one cell
  blocks->SetBlock(2, parts.Fixed[0]);
  Scene scene = parts;
  scene.Fixed = { MakeRectangle({ 1, 1, 1 }, { 0.1, 0, 0 }, { 0, 0.1, 0 }, 2) };
  const auto flat = MakeShowing(scene), composite = MakeShowing(scene);
  flat->AddInputDataObject(0, parts.Fixed[1]);
  flat->AddInputDataObject(0, parts.Fixed[0]);
  composite->AddInputDataObject(0, blocks);
  for (const auto& filter : { flat, composite })
  {
    filter->AddInputDataObject(0, MakeRectangle({ 1, 1, 2 }, { 0.5, 0, 0 }, { 0, 0.5, 0 }, 1));
  }
  flat.Update();
  composite.Update();
  EXPECT_EQ(Touching(composite, 0, 1, 0), Touching(flat, 0, 1, 0));
  EXPECT_EQ(Touching(composite, 0, 1, 5), Touching(flat, 0, 2, 4));
  EXPECT_GT(Touching(composite, 0, 1, 5).size(), 20u);
  EXPECT_EQ(Touching(composite, 0, 2, 0), Touching(flat, 0, 3, 0));
  EXPECT_GT(Touching(composite, 0, 2, 0).size(), 20u);
}

TEST(PhotonWalks, OfAThingThatIsNotThereAreNone)
{
  Scene scene = MakeSmallScene();
  scene.Moving.push_back(MakeMoving(Mesh::New(), { 0, 0, 0 }));
  const auto filter = MakeShowing(scene);
  const auto reports = ErrorObserver::Watch(filter.Shown);
  filter.Update();
  EXPECT_TRUE(Touching(filter, 1, 2, 7).empty());
  EXPECT_TRUE(reports->Errors.empty());
}

TEST(PhotonWalks, AreAllInTheFirstPiece)
{
  const auto filter = MakeShowing(MakeSmallScene(), 7);
  filter.Shown->UpdatePiece(1, 2, 0);
  EXPECT_EQ(filter.Shown->GetOutput()->GetNumberOfCells(), 0);
  filter.Shown->UpdatePiece(0, 2, 0);
  EXPECT_EQ(filter.Shown->GetOutput()->GetNumberOfCells(), 7);
}

TEST(PhotonWalks, OfADarkSceneAreNone)
{
  const auto filter = MakeShowing({ { MakeRoom(3, 1) }, {} });
  const auto reports = ErrorObserver::Watch(filter.Shown);
  EXPECT_TRUE(UpdatedWalks(filter).empty());
  filter.Shown->SetCell(2);
  EXPECT_TRUE(UpdatedWalks(filter).empty());
  EXPECT_TRUE(reports->Errors.empty());
}

TEST(PhotonWalks, ThatDoNotExistAreAnError)
{
  struct Case
  {
    vtkIdType Count;
    int Port, Connection;
    vtkIdType Cell;
    std::vector<std::string> Said;
  };
  const std::vector<Case> cases{ { -1, 0, 0, -1, { "the number of walks is -1", "0 to" } },
    { 5000000000, 0, 0, -1, { "the number of walks is 5000000000" } },
    { 1, 2, 0, 0, { "the port of the cell is 2" } },
    { 1, -1, 0, 0, { "the port of the cell is -1" } },
    { 1, 0, 2, 0, { "the connection of the cell is 2", "input port 0 has 2 connections" } },
    { 1, 1, -1, 0, { "the connection of the cell is -1" } },
    { 1, 0, 0, 54, { "the cell is 54", "static connection 0 has 54 cells" } },
    { 1, 1, 1, -2, { "the cell is -2", "dynamic connection 1 has 6 cells" } } };
  const Scene scene = MakeSmallScene();
  const auto filter = MakeShowing(scene);
  filter.Update();
  for (const Case& wrong : cases)
  {
    filter.Shown->SetNumberOfWalks(wrong.Count);
    filter.Shown->SetCellPort(wrong.Port);
    filter.Shown->SetCellConnection(wrong.Connection);
    filter.Shown->SetCell(wrong.Cell);
    ExpectOne(Update(filter.Shown).Errors, wrong.Said);
    EXPECT_EQ(filter.Shown->GetOutput()->GetNumberOfCells(), 0);
    EXPECT_EQ(filter.Shown->GetOutput()->GetCellData()->GetNumberOfArrays(), 0);
    filter.Shown->SetNumberOfWalks(7);
    filter.Shown->SetCell(-1); // then the others do not matter
    EXPECT_EQ(UpdatedWalks(filter).size(), 7u);
  }
}
