// SPDX-License-Identifier: BSD-3-Clause
// Law 1 where objects are so many and small that the filter flattens them, beside a large one that
// it instances, and whose points change while its cells stay. (TestRandomPrograms.cxx has the law
// for what else users do, TestLaws.cpp for all that the engine does.)

#include "OutputBits.h"
#include "TestScenes.h"

#include <gtest/gtest.h>

using namespace TestScenes;

TEST(UpdateEqualsRebuild, WithManySmallObjectsAndOneThatDeforms)
{
  constexpr vtkIdType walks = 400;
  RandomNumbers random(20260104);
  Scene scene = MakeSmallScene();
  for (int i = 0; i < 130; ++i)
  {
    scene.Moving.push_back(MakeMoving(MakeBox(0.1, 0.2, 0.1),
      { random.Between(0.2, 2.8), random.Between(0.2, 2.8), random.Between(0.2, 2.6) }));
  }
  std::vector<vtkSmartPointer<vtkIrradianceFilter>> updated;
  for (const int mode : { vtkIrradianceFilter::OneTree, vtkIrradianceFilter::Sequential,
         vtkIrradianceFilter::Parallel })
  {
    updated.push_back(MakeFilter(scene, walks));
    updated.back()->SetTraversalMode(mode);
  }
  double invalid = 0;
  for (int frame = 0; frame < 20; ++frame)
  {
    const auto fresh = MakeFilter(scene, walks);
    for (const auto& filter : updated)
    {
      ASSERT_TRUE(UpdatesLike(filter, fresh))
        << "frame " << frame << ", mode " << filter->GetTraversalMode();
      EXPECT_EQ(Field(filter, "ShootSeconds") == 0, frame > 0);
      invalid += Field(filter, "NumberOfInvalidWalks");
    }
    vtkPoints* points = scene.Moving[0].Model->GetPoints();
    points->SetPoint(random.Below(static_cast<int>(points->GetNumberOfPoints())),
      random.Between(-0.5, 0.5), random.Between(-0.5, 0.5), random.Between(-0.5, 0.5));
    points->Modified();
    for (const int moved : { 0, random.Below(132) })
    {
      vtkTransform* pose = scene.Moving[static_cast<std::size_t>(moved)].Pose;
      pose->RotateWXYZ(random.Between(0, 360), random.Between(-1, 1), random.Between(-1, 1), 1);
      pose->Translate(random.Between(-0.2, 0.2), random.Between(-0.2, 0.2), 0);
    }
  }
  EXPECT_GT(invalid, 0);
}
