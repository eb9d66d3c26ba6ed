// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ErrorObserver.h"
#include "EventObserver.h"
#include "OutputBits.h"
#include "OutputChecks.h"
#include "RandomModel.h"
#include "ShownWalks.h"
#include "ViewFilters.h"

#include "vtkMultiProcessController.h"
#include "vtkSMPTools.h"

#include <gtest/gtest.h>

#include <functional>
#include <utility>

/// One long-lived filter that is compared with fresh ones.
namespace RandomPrograms
{

using namespace RandomModels;
using namespace OutputChecks;

template <class Updated>
void Update(Updated& filter, double time, int threads)
{
  vtkSMPTools::LocalScope(
    vtkSMPTools::Config{ threads, "STDThread", false }, [&] { filter.UpdateTimeStep(time); });
}

/// One leaf of a connection.
struct Leaf
{
  Connection* In;
  vtkPolyData* Mesh;
  bool IsGround;

  void Modified() const
  {
    this->Mesh->Modified();
    this->In->Data->Modified(); // a composite dataset does not look into its leaves
  }
};

/// A point light between faces that touch is bad input, and so is a part outside of a sky's bounds.
inline bool IsMetByChance(const std::string& error)
{
  return error.find("no side to shine into") != std::string::npos ||
    error.find("leaves the box that the sky lights") != std::string::npos;
}

struct Counts
{
  int Operations = 0, Compared = 0, Repairs = 0, Stale = 0, Errors = 0, Mishaps = 0, Aborts = 0,
      Meddlings = 0, Luminaires = 0, Skies = 0, Looks = 0, Shown = 0, Gathered = 0,
      FinalGathers = 0, ChosenGathers = 0;
  std::uint64_t Digest = 0; ///< of all that fresh filters computed

  void Digested(std::uint64_t digest) { this->Digest = 3 * this->Digest + digest; }
};

/// A long-lived filter and what it is to compute. With a controller its processes compute it
/// together, and the fresh filters alone.
struct Trial
{
  Trial(std::uint64_t seed, Counts& counts, vtkMultiProcessController* controller = nullptr)
    : Random(seed)
    , Given(RandomModel(Random))
    , Done(counts)
  {
    this->Filter->SetController(controller);
    Configure(this->Filter, this->Given);
  }

  std::vector<Connection>& Moving() { return this->Given.Ports[1]; }
  Settings& Set() { return this->Given.Set; }
  bool IsShared() const
  {
    vtkMultiProcessController* controller = this->Filter->GetController();
    return controller && controller->GetNumberOfProcesses() > 1;
  }
  void Update()
  {
    RandomPrograms::Update(*this->Filter, this->Given.Time, this->Given.NumberOfThreads);
  }
  void Apply() { ApplySettings(this->Filter, this->Given.Set); }

  /// Whether a ride is over, and the part is gone: then nobody reads its data.
  bool HasLeft(const Connection& connection) const
  {
    const Ride& ride = connection.Keys;
    return !ride.Keys.empty() && ride.Outside == vtkKeyFramedPose::Leave &&
      this->Given.Time > ride.Keys.back().Time;
  }

  /// Calls visit(leaf) for each mesh of the static and the dynamic inputs.
  template <class Visit>
  void ForEachMesh(const Visit& visit)
  {
    bool isGround = true;
    for (auto& port : this->Given.Ports)
    {
      for (Connection& connection : port)
      {
        ForEachLeaf(connection.Data, [&](vtkPolyData* mesh) {
          visit(Leaf{ &connection, mesh, std::exchange(isGround, false) });
        });
      }
    }
  }

  bool HasSky()
  {
    bool has = false;
    this->ForEachMesh([&](const Leaf& leaf) { has = has || IsSky(leaf.Mesh); });
    return has;
  }

  /// `withSurface`: it is also there.
  Leaf PickLeaf(bool withSurface)
  {
    std::vector<Leaf> leaves;
    this->ForEachMesh([&](const Leaf& leaf) {
      const bool hasSurface = leaf.Mesh->GetNumberOfPolys() > 0 && !this->HasLeft(*leaf.In);
      if (withSurface ? hasSurface : !IsSky(leaf.Mesh))
      {
        leaves.push_back(leaf);
      }
    });
    return Pick(this->Random, leaves);
  }

  /// Updates, with `change` at one of the first progress events; false if there were too few.
  bool UpdateAndMeddle(const std::function<void()>& change)
  {
    // The first event comes from the executive, when rides have been computed already.
    this->Observer->EventsToWait = 1 + this->Random.Below(2 << this->Random.Below(5));
    this->Observer->Change = [&] {
      this->MeddledAt = this->Observer->Progress.back();
      change();
    };
    this->Update();
    return !std::exchange(this->Observer->Change, nullptr);
  }

  void ExpectOneError()
  {
    this->Reports->Clear();
    this->Update();
    EXPECT_EQ(this->Reports->Errors.size(), 1u);
    EXPECT_EQ(this->Filter->GetOutput()->GetNumberOfBlocks(), 0u);
    EXPECT_EQ(this->Filter->GetOutput()->GetFieldData()->GetNumberOfArrays(), 0);
    EXPECT_EQ(this->Filter->GetWalksOutput()->GetNumberOfPoints(), 0);
    this->MustCompare = true;
    ++this->Done.Errors;
  }

  /// A new filter, updated with another number of threads.
  vtkSmartPointer<vtkIrradianceFilter> MakeFresh(std::size_t errors = 0) const
  {
    auto fresh = vtkSmartPointer<vtkIrradianceFilter>::New();
    const auto reports = ErrorObserver::Watch(fresh);
    fresh->SetController(nullptr);
    Configure(fresh, this->Given);
    RandomPrograms::Update(*fresh, this->Given.Time, 3 - this->Given.NumberOfThreads);
    EXPECT_EQ(reports->Errors.size(), errors);
    return fresh;
  }

  void LimitGloss();
  void KeepCellOfWalks();
  void DropBudgetOfLook();
  void BringHome();
  bool HasUnseenLight();
  void DropFinalGather();
  void UpdateAndCheck();
  void Compare();
  void Look();
  void CompareViews(vtkIrradianceFilter* fresh, bool isCertain);

  RandomNumbers Random;
  Model Given;
  Counts& Done;
  bool MustCompare = true;
  bool HasLooked = false; ///< at photons, now or before
  vtkNew<vtkIrradianceFilter> Filter;
  vtkSmartPointer<ErrorObserver> Reports = ErrorObserver::Watch(this->Filter);
  vtkSmartPointer<EventObserver> Observer = EventObserver::Watch(this->Filter);
  double MeddledAt = 0; ///< progress
  ViewFilters Views{ this->Filter };
};

/// Reflectances that other changes left with too large a sum.
inline void Trial::LimitGloss()
{
  for (const auto& port : this->Given.Ports)
  {
    for (const Connection& connection : port)
    {
      if (RandomModels::LimitGloss(connection.Data, this->Given.Set))
      {
        connection.Data->Modified();
      }
    }
  }
}

/// Connections come and go, and so do their cells.
inline void Trial::KeepCellOfWalks()
{
  const auto& connections = this->Given.Ports[this->Set().OutputWalksPort];
  const auto number = static_cast<std::size_t>(this->Set().OutputWalksConnection);
  vtkIdType cells = 0;
  if (number < connections.size())
  {
    ForEachLeaf(
      connections[number].Data, [&](vtkPolyData* leaf) { cells += leaf->GetNumberOfCells(); });
  }
  if (this->Set().OutputWalksCell >= cells)
  {
    this->Set().OutputWalksCell = -1;
    this->Apply();
  }
}

/// Several processes look at photons or have a budget. The pipeline does not forget that photons
/// were asked for.
inline void Trial::DropBudgetOfLook()
{
  this->HasLooked = this->HasLooked || this->Given.Look.IsUsed();
  if (this->IsShared() && this->HasLooked && this->Set().RepairTimeBudget > 0)
  {
    this->Set().RepairTimeBudget = 0;
    this->Apply();
  }
}

/// Whether a gather would not know how gloss reflects a light.
inline bool Trial::HasUnseenLight()
{
  bool hasGloss = false, hasPoints = false;
  this->ForEachMesh([&](const Leaf& leaf) {
    hasGloss = hasGloss || leaf.Mesh->GetCellData()->HasArray(this->Set().SpecularArray.c_str());
    hasPoints = hasPoints || leaf.Mesh->GetNumberOfVerts() > 0 || IsSky(leaf.Mesh);
  });
  return hasGloss && hasPoints;
}

/// Where it is bad input, and beside a budget, with which what is stale on a cell need not fall
/// from update to update.
inline void Trial::DropFinalGather()
{
  const bool isLeft = this->Set().CellEstimate == vtkIrradianceFilter::AutomaticEstimate;
  if (this->Set().CellEstimate != vtkIrradianceFilter::FinalGather && !isLeft)
  {
    return;
  }
  const bool isBad = this->Set().DirectLight == vtkIrradianceFilter::Shot || this->HasUnseenLight();
  if (this->Set().RepairTimeBudget > 0 || (isBad && !isLeft))
  {
    this->Set().CellEstimate = vtkIrradianceFilter::Sums;
    this->Apply();
  }
}

/// Half of the time, what moves, and wider bounds of the sky.
inline void Trial::BringHome()
{
  const bool stays = Chance(this->Random, 2);
  for (Connection& moving : this->Moving())
  {
    if (moving.Pose && !stays)
    {
      moving.Pose->Identity();
      moving.Pose->Translate(RandomPlace(this->Random).data());
    }
  }
  this->ForEachMesh([&](const Leaf& leaf) {
    if (IsSky(leaf.Mesh) && !stays)
    {
      SetFieldTuple(leaf.Mesh, "SkyBounds", { -8, 11, -8, 11, -8, 11 });
      leaf.Modified();
    }
  });
}

inline void Trial::UpdateAndCheck()
{
  this->LimitGloss();
  this->DropFinalGather();
  this->KeepCellOfWalks();
  this->DropBudgetOfLook();
  if (!this->Reports->Errors.empty())
  {
    this->Filter->Modified(); // else it keeps the empty output if nothing has changed since
  }
  this->Reports->Clear();
  if (this->Given.Look.IsUsed() && Chance(this->Random, 4))
  {
    this->Look(); // updates the filter, too
  }
  this->Update();
  const auto& errors = this->Reports->Errors;
  if (errors.size() == 1 && IsMetByChance(errors[0]))
  {
    this->MakeFresh(1);
    ++this->Done.Mishaps;
    this->BringHome();
    this->MustCompare = true;
    return;
  }
  ASSERT_TRUE(errors.empty()) << errors.front();
  ExpectSoundOutput(this->Filter, this->Given);
  if (testing::Test::HasFatalFailure())
  {
    return;
  }
  ++this->Done.Operations;
  this->Done.Repairs += Field(this->Filter, "VerifySeconds") > 0;
  if (this->Given.Look.IsUsed() && Chance(this->Random, 2))
  {
    this->Look();
    this->Views.ExpectSound();
  }
  if (std::exchange(this->MustCompare, false) || Chance(this->Random, 3))
  {
    this->Compare();
  }
}

inline void Trial::Look()
{
  this->Given.Look.HasPoints = this->Given.Look.HasPoints && !this->HasUnseenLight();
  this->Views.Apply(this->Given.Look);
  RandomPrograms::Update(this->Views, this->Given.Time, this->Given.NumberOfThreads);
  ++this->Done.Looks;
}

/// What looks at the photons of the filter sees the same as with a fresh one. `isCertain`: this
/// comparison does not depend on time.
inline void Trial::CompareViews(vtkIrradianceFilter* fresh, bool isCertain)
{
  this->Look();
  ASSERT_NO_FATAL_FAILURE(this->Views.ExpectSound());
  ViewFilters views(fresh);
  views.Apply(this->Given.Look);
  RandomPrograms::Update(views, this->Given.Time, 3 - this->Given.NumberOfThreads);
  EXPECT_TRUE(IsSame(this->Views, views));
  if (isCertain)
  {
    this->Done.Digested(views.Digest());
  }
}

/// Stale light keeps its bounds, and is repaired at once or left to later operations.
inline void Trial::Compare()
{
  const auto fresh = this->MakeFresh();
  // Drawn before it is known whether something is stale, which depends on time.
  const bool waits = Chance(this->Random, 2);
  ++this->Done.Compared;
  this->ForEachMesh([&](const Leaf& leaf) {
    this->Done.Luminaires += HasTable(leaf.Mesh) && leaf.Mesh->GetNumberOfCells() > 0;
    this->Done.Skies += IsSky(leaf.Mesh);
  });
  this->Done.Digested(OutputBits(fresh).Digest());
  this->Done.Digested(ShownWalks::LastingBits(fresh->GetWalksOutput()).Digest());
  if (MostStale(this->Filter) > 0)
  {
    ++this->Done.Stale;
    // A target may give the fresh filter other walks.
    if (Field(this->Filter, "NumberOfWalks") == Field(fresh, "NumberOfWalks"))
    {
      ExpectBounds(this->Filter, fresh);
    }
    if (waits)
    {
      return;
    }
  }
  for (double left = MostStale(this->Filter); left > 0;)
  {
    this->Filter->Modified();
    this->Update();
    ASSERT_LT(MostStale(this->Filter), left) << "each execution repairs some walks";
    left = MostStale(this->Filter);
  }
  EXPECT_TRUE(IsSame(OutputBits(this->Filter), OutputBits(fresh)));
  EXPECT_TRUE(IsSame(ShownWalks::LastingBits(this->Filter->GetWalksOutput()),
    ShownWalks::LastingBits(fresh->GetWalksOutput())));
  const bool isGathered = Field(fresh, "DirectLight") == 1;
  const bool isFinalGather = Field(fresh, "CellEstimate") == vtkIrradianceFilter::FinalGather;
  this->Done.Gathered += isGathered;
  this->Done.FinalGathers += isFinalGather;
  this->Done.ChosenGathers +=
    isFinalGather && this->Set().CellEstimate == vtkIrradianceFilter::AutomaticEstimate;
  this->Done.Shown += fresh->GetWalksOutput()->GetNumberOfCells() > 0;
  this->CompareViews(fresh, !waits);
}

}
