// SPDX-License-Identifier: BSD-3-Clause
// Output port 1: walks to look at are those that were shot, and say what a motion touched.

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

constexpr vtkIdType NumberOfWalks = 1500;

vtkSmartPointer<vtkIrradianceFilter> MakeShowing(const Scene& scene, vtkIdType shown = All)
{
  auto filter = MakeFilter(scene, NumberOfWalks);
  filter->SetNumberOfOutputWalks(shown);
  return filter;
}

bool HasShot(vtkIrradianceFilter* filter)
{
  return Field(filter, "ShootSeconds") > 0;
}

/// Without walls: most light escapes.
Scene MakeOpenScene()
{
  Scene scene = MakeSmallScene();
  scene.Fixed[0] = MakeRectangle({ 0, 0, 0 }, { 3, 0, 0 }, { 0, 3, 0 }, 3);
  return scene;
}

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

TEST(OutputWalks, AreNoneByDefaultAndCostNothing)
{
  Scene scene = MakeSmallScene();
  for (const bool isStatic : { false, true })
  {
    if (isStatic)
    {
      scene.Moving.clear();
    }
    const auto filter = MakeFilter(scene, NumberOfWalks), showing = MakeShowing(scene);
    filter->Update();
    showing->Update();
    EXPECT_EQ(filter->GetWalksOutput()->GetNumberOfPoints(), 0);
    EXPECT_EQ(filter->GetWalksOutput()->GetCellData()->GetNumberOfArrays(), 0);
    EXPECT_EQ(showing->GetWalksOutput()->GetNumberOfCells(), NumberOfWalks);
    EXPECT_TRUE(IsSame(OutputBits(filter), OutputBits(showing)));
    EXPECT_EQ(Field(filter, "HistoryBytes"), isStatic ? 0 : Field(showing, "HistoryBytes"));
    EXPECT_GT(Field(showing, "HistoryBytes"), 0);
  }
}

TEST(OutputWalks, AreTheFirstForAnyNumberOfThreads)
{
  const Scene scene = MakeOpenScene();
  const auto all = MakeShowing(scene);
  const Walks walks = UpdatedWalks(all);
  EXPECT_EQ(walks.size(), static_cast<std::size_t>(NumberOfWalks));
  EXPECT_EQ(walks.rbegin()->first, NumberOfWalks - 1);
  const auto some = MakeShowing(scene, 200);
  vtkSMPTools::LocalScope(vtkSMPTools::Config{ 1, "STDThread", false }, [&] { some->Update(); });
  const Walks first = WalksOf(some->GetWalksOutput());
  EXPECT_EQ(first.size(), 200u);
  EXPECT_EQ(first.rbegin()->first, 199);
  for (const auto& [id, walk] : first)
  {
    EXPECT_EQ(walk.Points, walks.at(id).Points);
  }
}

TEST(OutputWalks, CarryTheEmittedPower)
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
      const double emitted = Field(filter, "EmittedPower", band);
      EXPECT_NEAR(sum[static_cast<std::size_t>(band)], emitted, 1e-9 * emitted);
    }
    if (!isColoured) // reflections change no power
    {
      EXPECT_NEAR(escaped[0], Field(filter, "EscapedPower"), 1e-12 * sum[0]);
    }
  }
}

// VTK's own search of the output's meshes knows nothing of trees, histories and samples.
TEST(OutputWalks, RunFromTheLampFromHitToHit)
{
  const Scene scene = MakeOpenScene();
  const auto filter = MakeShowing(scene, 400);
  filter->ComputeStandardErrorOn(); // each replicate has samples of its own
  filter->Update();
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

TEST(OutputWalks, ThatEscapeEndBeyondTheScene)
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

TEST(OutputWalks, TouchTheChosenCell)
{
  Scene scene = MakeSmallScene();
  scene.Fixed.push_back(MakePointLight({ 0.5, 2.5, 0.5 }, { 30 }));
  const auto filter = MakeShowing(scene);
  const Walks walks = UpdatedWalks(filter);
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
        EXPECT_FALSE(HasShot(filter));
        // A point on an edge belongs to one of two cells.
        EXPECT_TRUE(Contains(TouchingByDistance(walks, mesh, cell, 1e-6), touching));
        const Ids near = TouchingByDistance(walks, mesh, cell, 1e-8);
        EXPECT_LE(near.size(), touching.size() + 1);
        cells += !touching.empty();
      }
    }
  }
  EXPECT_GT(cells, 50);
}

TEST(OutputWalks, OfACellAreTheFirstThatTouchIt)
{
  const auto filter = MakeShowing(MakeSmallScene());
  const Ids all = Touching(filter, 0, 0, 4); // in the middle of the floor
  ASSERT_GT(all.size(), 20u);
  filter->SetOutputWalksCell(4);
  for (const vtkIdType count : { 1, 20 })
  {
    filter->SetNumberOfOutputWalks(count);
    const Ids some = IdsOf(UpdatedWalks(filter));
    EXPECT_EQ(some, Ids(all.begin(), std::next(all.begin(), count)));
  }
}

// Every walk that touches the moved thing, before or after, and no other.
TEST(OutputWalks, SayWhichWereRepaired)
{
  const Scene scene = MakeSmallScene();
  const auto filter = MakeShowing(scene);
  Walks before = UpdatedWalks(filter);
  EXPECT_TRUE(RepairedOf(before).empty()) << "all were shot for the first time";
  for (const int moved : { 0, 1, 0 })
  {
    SCOPED_TRACE(moved);
    Ids expected = Touching(filter, 1, moved);
    scene.Moving[static_cast<std::size_t>(moved)].Pose->Translate(0.2, -0.1, 0.15);
    const Walks after = UpdatedWalks(filter);
    EXPECT_EQ(RepairedOf(after).size(), Field(filter, "NumberOfInvalidWalks"));
    double segments = 0;
    for (const auto& [id, walk] : after)
    {
      SCOPED_TRACE(id);
      const auto news = std::count(walk.IsNew.begin(), walk.IsNew.end(), true);
      const auto kept = walk.IsNew.size() - static_cast<std::size_t>(news);
      EXPECT_EQ(walk.Repaired, news > 0);
      EXPECT_TRUE(std::is_sorted(walk.IsNew.begin(), walk.IsNew.end())) << "a tail";
      ASSERT_GE(before.at(id).Points.size(), kept);
      EXPECT_TRUE(
        std::equal(walk.Points.begin(), walk.Points.end() - news, before.at(id).Points.begin()));
      EXPECT_TRUE(walk.Repaired || walk.Points == before.at(id).Points);
      segments += static_cast<double>(news);
    }
    EXPECT_EQ(segments, Field(filter, "NumberOfRepairedSegments"));
    const Ids now = Touching(filter, 1, moved);
    expected.insert(now.begin(), now.end());
    EXPECT_EQ(RepairedOf(after), expected);
    EXPECT_GT(expected.size(), 50u);
    EXPECT_LT(expected.size(), static_cast<std::size_t>(NumberOfWalks) / 2);
    before = after;
  }
}

TEST(OutputWalks, SayWhichAThingTouchedThatCameOrLeft)
{
  const Scene scene = MakeSmallScene();
  const Mesh ball = Copy(scene.Moving[0].Model);
  const auto filter = MakeShowing(scene);
  filter->Update();
  const Ids touching = Touching(filter, 1, 0);
  EXPECT_GT(touching.size(), 50u);
  for (const bool leaves : { true, false, true })
  {
    scene.Moving[0].Model->ShallowCopy(leaves ? Mesh::New() : ball);
    const Walks after = UpdatedWalks(filter);
    EXPECT_FALSE(HasShot(filter));
    EXPECT_EQ(RepairedOf(after), touching);
    EXPECT_EQ(Touching(filter, 1, 0), leaves ? Ids() : touching);
  }
}

TEST(OutputWalks, KeepTheMarksWhileNothingMoves)
{
  const Scene scene = MakeSmallScene();
  const auto filter = MakeShowing(scene);
  filter->Update();
  scene.Moving[0].Pose->Translate(0.2, 0, 0);
  const Ids repaired = RepairedOf(UpdatedWalks(filter));
  filter->SetNumberOfOutputWalks(NumberOfWalks / 2);
  Ids half = RepairedOf(UpdatedWalks(filter));
  EXPECT_EQ(half, Ids(repaired.begin(), repaired.lower_bound(NumberOfWalks / 2)));
  EXPECT_FALSE(half.empty());
  filter->SetNumberOfOutputWalks(0);
  filter->Update();
  EXPECT_EQ(filter->GetWalksOutput()->GetNumberOfPoints(), 0);
  filter->SetNumberOfOutputWalks(All);
  EXPECT_EQ(RepairedOf(UpdatedWalks(filter)), repaired);
  filter->SetSeed(2);
  EXPECT_TRUE(RepairedOf(UpdatedWalks(filter)).empty());
  EXPECT_TRUE(HasShot(filter));
}

TEST(OutputWalks, AreThoseOfANewFilter)
{
  using Setting = std::function<void(vtkIrradianceFilter*)>;
  const std::vector<Setting> settings{ [](vtkIrradianceFilter*) {},
    [](vtkIrradianceFilter* filter) { filter->SeparateSidesOn(); },
    [](vtkIrradianceFilter* filter) {
      ErrorObserver::Watch(filter); // the target is not reached
      filter->SetTargetRelativeError(0.2);
      filter->SetMaximumNumberOfWalks(4 * NumberOfWalks);
      filter->SetNumberOfReplicates(5);
    },
    [](vtkIrradianceFilter* filter) {
      filter->SetOutputWalksPort(1);
      filter->SetOutputWalksConnection(1);
      filter->SetOutputWalksCell(5);
    } };
  for (std::size_t i = 0; i < settings.size(); ++i)
  {
    SCOPED_TRACE(i);
    Scene scene = MakeOpenScene();
    SetCellValues(scene.Fixed[1], "RadiantExitance", { 50, 100, 25 });
    SetCellValues(scene.Moving[0].Model, "DiffuseReflectance", { 0.1 });
    SetCellValues(scene.Moving[0].Model, "SpecularReflectance", { 0.8 });
    SetCellValues(scene.Moving[0].Model, "PhongExponent", { 40 });
    const auto filter = MakeShowing(scene);
    settings[i](filter);
    filter->Update();
    for (int frame = 0; frame < 4; ++frame)
    {
      scene.Moving[0].Pose->Translate(0.1, 0.2, frame % 2 ? 1.2 : -1);
      scene.Moving[1].Pose->RotateZ(20);
      filter->Update();
      const auto fresh = MakeShowing(scene);
      settings[i](fresh);
      vtkSMPTools::LocalScope(
        vtkSMPTools::Config{ 1, "STDThread", false }, [&] { fresh->Update(); });
      EXPECT_TRUE(IsSame(LastingBits(filter), LastingBits(fresh)));
      EXPECT_GT(fresh->GetWalksOutput()->GetNumberOfCells(), 0);
      EXPECT_TRUE(RepairedOf(WalksOf(fresh->GetWalksOutput())).empty());
    }
  }
}

TEST(OutputWalks, OfAStaticSceneAreShotOnce)
{
  Scene scene = MakeSmallScene();
  scene.Moving.clear();
  const auto filter = MakeShowing(scene, 0);
  filter->Update();
  filter->SetNumberOfOutputWalks(100);
  filter->Update();
  EXPECT_TRUE(HasShot(filter)) << "they were not stored";
  EXPECT_EQ(filter->GetWalksOutput()->GetNumberOfCells(), 100);
  filter->SetNumberOfOutputWalks(200);
  filter->Update();
  EXPECT_FALSE(HasShot(filter));
  filter->SetNumberOfOutputWalks(0);
  filter->Update();
  filter->SetOutputWalksCell(4);
  filter->SetNumberOfOutputWalks(20);
  filter->Update();
  EXPECT_FALSE(HasShot(filter));
  EXPECT_EQ(filter->GetWalksOutput()->GetNumberOfCells(), 20);
}

TEST(OutputWalks, SayWhichAreStale)
{
  constexpr double noTime = 1e-9; // s; over when it begins
  const Scene scene = MakeSmallScene();
  const auto filter = MakeShowing(scene);
  filter->SetRepairTimeBudget(noTime);
  EXPECT_TRUE(IdsOf(UpdatedWalks(filter)).size() == static_cast<std::size_t>(NumberOfWalks));
  EXPECT_TRUE(filter->GetWalksOutput()->GetCellData()->HasArray("Stale"));
  scene.Moving[0].Pose->Translate(0.2, 0, 0);
  const auto full = MakeShowing(scene);
  full->SetRepairTimeBudget(10);
  scene.Moving[0].Pose->Translate(-0.2, 0, 0);
  full->Update();
  scene.Moving[0].Pose->Translate(0.2, 0, 0);
  const Ids expected = RepairedOf(UpdatedWalks(full));
  Ids repaired;
  std::size_t left = expected.size();
  for (int calls = 0; left > 0; ++calls)
  {
    filter->Modified();
    const Walks walks = UpdatedWalks(filter);
    Ids waiting = expected;
    const Ids now = RepairedOf(walks);
    EXPECT_GT(now.size(), 0u);
    repaired.insert(now.begin(), now.end());
    std::size_t stale = 0;
    double power = 0;
    for (const auto& [id, walk] : walks)
    {
      EXPECT_EQ(walk.Stale, expected.count(id) > 0 && repaired.count(id) == 0) << id;
      stale += walk.Stale;
      power += walk.Stale ? walk.Power[0] : 0;
    }
    EXPECT_NEAR(power, Field(filter, "StalePower"), 1e-9 * Field(filter, "EmittedPower"));
    ASSERT_LT(stale, left) << "call " << calls;
    left = stale;
    filter->SetRepairTimeBudget(calls < 3 ? noTime : 10);
  }
  EXPECT_EQ(repaired, expected);
  EXPECT_TRUE(IsSame(LastingBits(filter), LastingBits(full)));
}

TEST(OutputWalks, NumberTheCellsOfACompositeConnectionFromLeafToLeaf)
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
  flat->Update();
  composite->Update();
  EXPECT_EQ(Touching(composite, 0, 1, 0), Touching(flat, 0, 1, 0));
  EXPECT_EQ(Touching(composite, 0, 1, 5), Touching(flat, 0, 2, 4));
  EXPECT_GT(Touching(composite, 0, 1, 5).size(), 20u);
  EXPECT_EQ(Touching(composite, 0, 2, 0), Touching(flat, 0, 3, 0));
  EXPECT_GT(Touching(composite, 0, 2, 0).size(), 20u);
}

TEST(OutputWalks, OfAThingThatIsNotThereAreNone)
{
  Scene scene = MakeSmallScene();
  scene.Moving.push_back(MakeMoving(Mesh::New(), { 0, 0, 0 }));
  const auto filter = MakeShowing(scene);
  const auto reports = ErrorObserver::Watch(filter);
  filter->Update();
  EXPECT_TRUE(Touching(filter, 1, 2, 7).empty());
  EXPECT_TRUE(reports->Errors.empty());
}

TEST(OutputWalks, OfADarkSceneAreNone)
{
  const auto filter = MakeShowing({ { MakeRoom(3, 1) }, {} });
  const auto reports = ErrorObserver::Watch(filter);
  EXPECT_TRUE(UpdatedWalks(filter).empty());
  filter->SetOutputWalksCell(2);
  EXPECT_TRUE(UpdatedWalks(filter).empty());
  EXPECT_TRUE(reports->Errors.empty());
}

TEST(OutputWalks, ThatDoNotExistAreAnError)
{
  struct Case
  {
    vtkIdType Count;
    int Port, Connection;
    vtkIdType Cell;
    std::vector<std::string> Said;
  };
  const std::vector<Case> cases{ { -1, 0, 0, -1, { "NumberOfOutputWalks is -1", "0 to" } },
    { 5000000000, 0, 0, -1, { "NumberOfOutputWalks is 5000000000" } },
    { 1, 2, 0, 0, { "OutputWalksPort is 2" } }, { 1, -1, 0, 0, { "OutputWalksPort is -1" } },
    { 1, 0, 2, 0, { "OutputWalksConnection is 2", "input port 0 has 2 connections" } },
    { 1, 1, -1, 0, { "OutputWalksConnection is -1" } },
    { 1, 0, 0, 54, { "OutputWalksCell is 54", "input port 0, connection 0 has 54 cells" } },
    { 1, 1, 1, -2, { "OutputWalksCell is -2", "input port 1, connection 1 has 6 cells" } } };
  const Scene scene = MakeSmallScene();
  const auto filter = MakeShowing(scene);
  filter->Update();
  for (const Case& wrong : cases)
  {
    filter->SetNumberOfOutputWalks(wrong.Count);
    filter->SetOutputWalksPort(wrong.Port);
    filter->SetOutputWalksConnection(wrong.Connection);
    filter->SetOutputWalksCell(wrong.Cell);
    const std::string error = OnlyErrorOf(filter);
    for (const std::string& said : wrong.Said)
    {
      EXPECT_NE(error.find(said), std::string::npos) << error;
    }
    EXPECT_EQ(filter->GetWalksOutput()->GetNumberOfCells(), 0);
    EXPECT_EQ(filter->GetWalksOutput()->GetCellData()->GetNumberOfArrays(), 0);
    filter->RemoveAllObservers();
    filter->GetExecutive()->RemoveAllObservers();
    filter->SetNumberOfOutputWalks(0); // then the others do not matter
    filter->SetOutputWalksCell(std::max<vtkIdType>(wrong.Cell, 1000));
    const auto reports = ErrorObserver::Watch(filter);
    filter->Update();
    EXPECT_TRUE(reports->Errors.empty());
    EXPECT_EQ(filter->GetOutput()->GetNumberOfBlocks(), 2u);
    EXPECT_FALSE(HasShot(filter));
  }
}
