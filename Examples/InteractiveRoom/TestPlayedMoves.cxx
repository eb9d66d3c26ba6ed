// SPDX-License-Identifier: BSD-3-Clause
// What is played ends with the picture of the page and the light of a new filter.
#include "../../Testing/FiltersIrradiance/OutputBits.h"
#include "EventFile.h"
#include "ShownRoom.h"

#include <vtkImageDifference.h>
#include <vtkInteractorEventRecorder.h>
#include <vtkPNGReader.h>
#include <vtkSMPTools.h>
#include <vtkTransformPolyDataFilter.h>

#include <sstream>

using namespace interactiveroom;

namespace
{

const char* const Moves = INTERACTIVEROOM_EVENTS;

// A new filter's, with things where they are.
OutputBits FreshBits(Shown& shown)
{
  LightFollower fresh(shown.TheRoom, shown.Options.Walks, shown.Options.GatherRays);
  for (int i = 0; i < int(shown.TheRoom.Moving.size()); ++i)
  {
    fresh.GetPose(i)->SetMatrix(shown.Pose(i));
  }
  fresh.Shoot({});
  return OutputBits(fresh.GetFilter());
}

std::string TextOf(const std::string& file)
{
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

// With the tolerances of the other pictures (Testing/FiltersIrradiance/TestImages.cxx).
double DifferenceToPage(Shown& shown)
{
  vtkNew<vtkPNGReader> page;
  page->SetFileName(INTERACTIVEROOM_PICTURE);
  vtkNew<vtkImageDifference> difference;
  difference->SetThreshold(16);
  difference->SetInputData(PictureOf(shown));
  difference->SetImageConnection(page->GetOutputPort());
  difference->Update();
  return difference->GetThresholdedError();
}

}

TEST(PlayedMoves, EndWithThePictureOfThePage)
{
  Shown shown({ "--walks", "1000000" });
  PlayEvents(Moves, shown.Window.GetInteractor());
  shown.Window.Settle();
  EXPECT_LE(DifferenceToPage(shown), 10);
  shown.Press("Right");
  shown.Window.Settle();
  EXPECT_GT(DifferenceToPage(shown), 10) << "a crate 7 cm beside it passes";
}

TEST(PlayedMoves, EndWithTheBitsOfANewFilterHoweverFastTheMachineIs)
{
  Shown stepped({ "--walks", "100000" });
  PlayEvents(Moves, stepped.Window.GetInteractor());
  stepped.Window.Settle();
  for (const int moved : { Teapot, Crate, Ring })
  {
    EXPECT_FALSE(
      IsEqual(stepped.Pose(moved), stepped.TheRoom.Moving[moved].WorldFromMesh->GetMatrix()));
  }
  for (const int left : { Ball, Drum })
  {
    EXPECT_TRUE(
      IsEqual(stepped.Pose(left), stepped.TheRoom.Moving[left].WorldFromMesh->GetMatrix()));
  }
  const OutputBits bits(stepped.Light.GetFilter());
  ASSERT_FALSE(bits.IsEmpty());
  EXPECT_TRUE(IsSame(bits, FreshBits(stepped)));

  // A machine so slow that no step comes before the end.
  std::istringstream lines(TextOf(Moves));
  std::string moves;
  for (std::string line; std::getline(lines, line);)
  {
    moves += line.rfind("TimerEvent", 0) == 0 ? "" : line + "\n";
  }
  Shown late({ "--walks", "100000" });
  PlayEvents(WriteFile("late.events", moves), late.Window.GetInteractor());
  late.Window.Settle();
  EXPECT_TRUE(IsSame(OutputBits(late.Light.GetFilter()), FreshBits(late)));
}

TEST(PlayedMoves, AreThoseThatWereRecorded)
{
  const std::string file = testing::TempDir() + "recorded.events";
  Shown first({ "--walks", "1000" });
  {
    const auto recorder = RecordEvents(file, first.Window.GetInteractor());
    first.Drag(512, 230, 560, 264);
    first.Press("Tab", '\t');
    first.Press("Up");
    recorder->Off();
  }
  Shown second({ "--walks", "1000" });
  PlayEvents(file, second.Window.GetInteractor());
  for (int i = 0; i < NumberOfThings; ++i)
  {
    EXPECT_TRUE(IsEqual(first.Pose(i), second.Pose(i))) << i;
  }
  EXPECT_FALSE(
    IsEqual(first.Pose(Teapot), first.TheRoom.Moving[Teapot].WorldFromMesh->GetMatrix()));
  EXPECT_FALSE(IsEqual(first.Pose(Ball), first.TheRoom.Moving[Ball].WorldFromMesh->GetMatrix()));
}

// A budget that is too small leaves walks stale, and further steps end with a new filter's light.
TEST(LightFollower, EndsExactAfterStepsWithoutTime)
{
  Shown shown({ "--walks", "400000" });
  EXPECT_TRUE(shown.Light.IsExact());
  for (int i = 0; i < NumberOfThings; ++i)
  {
    shown.Light.GetPose(i)->Translate(0, 0, 0.2);
  }
  EXPECT_TRUE(shown.Light.HasMoved());
  int renders = 0;
  vtkSMPTools::LocalScope(vtkSMPTools::Config(1), // many threads may have done all in that time
    [&] { shown.Light.Step(0, [&renders] { ++renders; }); });
  EXPECT_FALSE(shown.Light.HasMoved());
  EXPECT_FALSE(shown.Light.IsExact()) << "all is repaired in the least time";
  EXPECT_GT(shown.Light.GetFilter()->GetFigure("StalePower"), 0);
  EXPECT_EQ(renders, 1);
  shown.Light.Settle();
  EXPECT_TRUE(shown.Light.IsExact());
  EXPECT_TRUE(IsSame(OutputBits(shown.Light.GetFilter()), FreshBits(shown)));
}

// As ParaView's Transform does it, which the Guide describes: what moves are points.
TEST(MovedPoints, FollowWithinABudgetToo)
{
  const Room room = MakePreset("room");
  vtkNew<vtkTransform> pose;
  const auto make = [&](double budget) {
    vtkNew<vtkTransformPolyDataFilter> transform;
    transform->SetInputData(room.Moving[Teapot].Mesh);
    transform->SetTransform(pose);
    auto filter = vtkSmartPointer<vtkIrradianceFilter>::New();
    filter->AddInputDataObject(0, room.Still[0].Mesh);
    filter->AddInputDataObject(0, room.Still[1].Mesh);
    filter->AddInputConnection(1, transform->GetOutputPort());
    filter->SetNumberOfWalks(100000);
    filter->SetRepairTimeBudget(budget);
    filter->Update();
    return filter;
  };
  const auto filter = make(1e-6);
  pose->Translate(0.3, 0, 1);
  filter->Update();
  EXPECT_EQ(filter->GetFigure("ShootSeconds"), 0) << "all is shot again";
  EXPECT_GT(filter->GetFigure("StalePower"), 0);
  filter->SetRepairTimeBudget(0);
  filter->Update();
  EXPECT_TRUE(IsSame(OutputBits(filter), OutputBits(make(0))));
}
