// SPDX-License-Identifier: BSD-3-Clause
// Progress comes often and only rises; an abort stops soon and leaves nothing half done behind.

#include "EventObserver.h"
#include "OutputBits.h"
#include "TestScenes.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace TestScenes;

namespace
{

/// The number of walks that take about `seconds` to shoot on this machine now.
vtkIdType NumberOfWalksIn(double seconds, const Scene& scene)
{
  constexpr vtkIdType sample = 20000;
  const auto filter = MakeFilter(scene, sample);
  filter->Update();
  return static_cast<vtkIdType>(sample * seconds / Field(filter, "ShootSeconds"));
}

void ExpectRisingFrom0To1(const std::vector<double>& values)
{
  ASSERT_FALSE(values.empty());
  EXPECT_TRUE(std::is_sorted(values.begin(), values.end()));
  EXPECT_EQ(values.front(), 0);
  EXPECT_EQ(values.back(), 1);
}

}

// The promise is an event every 0.1 s, so shooting of about a second has ten. A machine that is
// slow or stops the process for a while makes more of them, not fewer.
TEST(Progress, RisesAndComesOften)
{
  const Scene scene = MakeSmallScene();
  const auto filter = MakeFilter(scene, NumberOfWalksIn(1.2, scene));
  const auto observer = EventObserver::Watch(filter);
  filter->Update();
  ExpectRisingFrom0To1(observer->Progress);
  EXPECT_GE(observer->Progress.size(), 6u); // the machine may have been slower when it was tried

  scene.Moving[0].Pose->Translate(0.5, 0.3, 0.1);
  observer->Progress.clear();
  filter->Update();
  ExpectRisingFrom0To1(observer->Progress);
}

// First in rounds whose number is not known beforehand, then in updates that need more or fewer.
TEST(Progress, RisesWithATarget)
{
  const Scene scene = MakeSmallScene();
  const auto filter = MakeFilter(scene, 2000);
  filter->SetTargetRelativeError(0.05);
  const auto observer = EventObserver::Watch(filter);
  for (const double z : { 0.0, 1.4, -1.4 })
  {
    scene.Moving[0].Pose->Translate(0, 0, z);
    observer->Progress.clear();
    filter->Update();
    EXPECT_GE(Field(filter, "NumberOfWalks"), 4000);
    ExpectRisingFrom0To1(observer->Progress);
  }
}

TEST(Abort, WhileShooting)
{
  const Scene scene = MakeSmallScene();
  const vtkIdType walks = NumberOfWalksIn(0.7, scene);
  const auto filter = MakeFilter(scene, walks);
  const auto observer = EventObserver::Watch(filter);
  observer->AbortFrom = 0.3;
  filter->Update();
  // The executive of VTK 9.3 ends with 1 in any case.
  EXPECT_LT(*std::find_if(observer->Progress.rbegin(), observer->Progress.rend(),
              [](double value) { return value < 1; }),
    0.7);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfBlocks(), 0u);
  EXPECT_EQ(filter->GetOutput()->GetFieldData()->GetNumberOfArrays(), 0);
  observer->AbortFrom = 2;
  filter->SetAbortExecute(0);
  EXPECT_TRUE(UpdatesLike(filter, MakeFilter(scene, walks)));
}

// Verification is the first half of an update, repair the second. A frame aborted in either must
// not pass for one that can be repaired. Where nothing has moved there is nothing to abort; the
// output is empty all the same.
TEST(Abort, WhileVerifyingOrRepairingOrWithNothingToDo)
{
  constexpr vtkIdType walks = 300000;
  const Scene scene = MakeSmallScene();
  const auto filter = MakeFilter(scene, walks);
  filter->Update();
  const auto observer = EventObserver::Watch(filter);
  for (const auto& [at, step] : { std::pair(0.0, 0.3), { 0.1, -0.4 }, { 0.6, 0.5 }, { 0.0, 0.0 } })
  {
    SCOPED_TRACE(testing::Message() << "abort at " << at << ", step " << step);
    scene.Moving[0].Pose->Translate(step, 0.6 * step, 0.2 * step);
    filter->Modified();
    observer->AbortFrom = at;
    filter->Update();
    EXPECT_EQ(filter->GetOutput()->GetNumberOfBlocks(), 0u);
    scene.Moving[0].Pose->Translate(-0.4 * step, 0, 0);
    observer->AbortFrom = 2;
    filter->SetAbortExecute(0);
    EXPECT_TRUE(UpdatesLike(filter, MakeFilter(scene, walks)));
  }
}
