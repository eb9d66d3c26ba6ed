// SPDX-License-Identifier: BSD-3-Clause
// Progress comes often and only rises; an abort stops soon and leaves nothing half done behind.

#include "OutputBits.h"
#include "TestScenes.h"

#include "vtkCommand.h"
#include "vtkSMPTools.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace TestScenes;

namespace
{

/// Records every progress event, and aborts from progress AbortAt on; never if that is above 1.
class ProgressObserver : public vtkCommand
{
public:
  static ProgressObserver* New() { return new ProgressObserver; }

  void Execute(vtkObject* caller, unsigned long, void* progress) override
  {
    this->Values.push_back(*static_cast<double*>(progress));
    if (this->Values.back() >= this->AbortAt)
    {
      this->HasAborted = true;
      static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
    }
  }

  void Restart(double abortAt)
  {
    this->Values.clear();
    this->AbortAt = abortAt;
    this->HasAborted = false;
  }

  std::vector<double> Values;
  double AbortAt = 2;
  bool HasAborted = false;
};

vtkSmartPointer<ProgressObserver> Watch(vtkIrradianceFilter* filter)
{
  auto observer = vtkSmartPointer<ProgressObserver>::New();
  filter->AddObserver(vtkCommand::ProgressEvent, observer);
  return observer;
}

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
  const auto observer = Watch(filter);
  observer->Restart(2);
  filter->Update();
  std::cout << filter->GetNumberOfWalks() << " walks, " << observer->Values.size() << " events\n";
  ExpectRisingFrom0To1(observer->Values);
  EXPECT_GE(observer->Values.size(), 6u); // the machine may have been slower when it was tried

  scene.Moving[0].Pose->Translate(0.5, 0.3, 0.1);
  observer->Restart(2);
  filter->Update();
  ExpectRisingFrom0To1(observer->Values);
}

// First in rounds whose number is not known beforehand, then in updates that need more or fewer.
TEST(Progress, RisesWithATarget)
{
  const Scene scene = MakeSmallScene();
  const auto filter = MakeFilter(scene, 2000);
  filter->SetTargetRelativeError(0.05);
  const auto observer = Watch(filter);
  for (const double z : { 0.0, 1.4, -1.4 })
  {
    scene.Moving[0].Pose->Translate(0, 0, z);
    observer->Restart(2);
    filter->Update();
    std::cout << Field(filter, "NumberOfWalks") << " walks, " << observer->Values.size()
              << " events\n";
    EXPECT_GE(Field(filter, "NumberOfWalks"), 4000);
    ExpectRisingFrom0To1(observer->Values);
  }
}

TEST(Abort, WhileShooting)
{
  const Scene scene = MakeSmallScene();
  const vtkIdType walks = NumberOfWalksIn(0.7, scene);
  const auto filter = MakeFilter(scene, walks);
  const auto observer = Watch(filter);
  observer->Restart(0.3);
  filter->Update();
  ASSERT_TRUE(observer->HasAborted);
  // The executive of VTK 9.3 ends with 1 in any case.
  EXPECT_LT(*std::find_if(observer->Values.rbegin(), observer->Values.rend(),
              [](double value) { return value < 1; }),
    0.7);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfBlocks(), 0u);
  EXPECT_EQ(filter->GetOutput()->GetFieldData()->GetNumberOfArrays(), 0);

  observer->Restart(2);
  filter->SetAbortExecute(0);
  filter->Update();
  const auto fresh = MakeFilter(scene, walks);
  fresh->Update();
  EXPECT_TRUE(IsSame(OutputBits(filter), OutputBits(fresh)));
}

// Verification is the first half of an update, repair the second. A frame aborted in either must
// not pass for one that can be repaired.
TEST(Abort, WhileVerifyingOrRepairing)
{
  for (const double at : { 0.0, 0.1, 0.6 })
  {
    const Scene scene = MakeSmallScene();
    const vtkIdType walks = 300000;
    std::cout << walks << " walks, abort at " << at << "\n";
    const auto filter = MakeFilter(scene, walks);
    const auto observer = Watch(filter);
    filter->Update();
    scene.Moving[0].Pose->Translate(0.5, 0.3, 0.1);
    observer->Restart(at);
    filter->Update();
    ASSERT_TRUE(observer->HasAborted);
    EXPECT_EQ(filter->GetOutput()->GetNumberOfBlocks(), 0u);

    scene.Moving[0].Pose->Translate(-0.2, 0, 0);
    observer->Restart(2);
    filter->SetAbortExecute(0);
    filter->Update();
    const auto fresh = MakeFilter(scene, walks);
    fresh->Update();
    EXPECT_TRUE(IsSame(OutputBits(filter), OutputBits(fresh))) << "abort at " << at;
  }
}

// Nothing has moved, so there is nothing to abort; the output is empty all the same.
TEST(Abort, WithNothingToDo)
{
  const Scene scene = MakeSmallScene();
  const auto filter = MakeFilter(scene, 1000);
  filter->Update();
  const auto observer = Watch(filter);
  observer->Restart(0);
  filter->Modified();
  filter->Update();
  ASSERT_TRUE(observer->HasAborted);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfBlocks(), 0u);

  observer->Restart(2);
  filter->SetAbortExecute(0);
  filter->Update();
  const auto fresh = MakeFilter(scene, 1000);
  fresh->Update();
  EXPECT_TRUE(IsSame(OutputBits(filter), OutputBits(fresh)));
}
