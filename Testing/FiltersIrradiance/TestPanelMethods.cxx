// SPDX-License-Identifier: BSD-3-Clause
// What a panel sets by numbers and names is what programs set by objects.

#include "ErrorObserver.h"
#include "OutputBits.h"
#include "TestScenes.h"

#include <gtest/gtest.h>

using namespace TestScenes;

TEST(PanelMethods, AMatrixIsATransform)
{
  const Scene scene = MakeSmallScene();
  vtkNew<vtkTransform> transform;
  transform->Translate(0.1, 0.2, 0.05);
  transform->RotateZ(30);
  const auto byTransform = MakeFilter(scene, 2000), byMatrix = MakeFilter(scene, 2000),
             byNumbers = MakeFilter(scene, 2000);
  byTransform->SetDynamicTransform(0, transform);
  double m[16];
  vtkMatrix4x4::DeepCopy(m, transform->GetMatrix());
  byMatrix->SetDynamicMatrix(0, m);
  byNumbers->SetDynamicMatrix(0, m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10],
    m[11], m[12], m[13], m[14], m[15]);
  EXPECT_TRUE(UpdatesLike(byMatrix, byTransform));
  EXPECT_TRUE(UpdatesLike(byNumbers, byTransform));
  byNumbers->RemoveAllDynamicTransforms();
  EXPECT_FALSE(UpdatesLike(byNumbers, byTransform));
}

TEST(PanelMethods, AMatrixThatIsNoPoseIsAnError)
{
  const auto filter = MakeFilter(MakeSmallScene(), 2000);
  filter->SetDynamicMatrix(0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, std::nan(""), 0, 0, 0, 0, 1);
  ExpectWords(OnlyErrorOf(filter), { "input port 1, connection 0" });
  filter->SetDynamicMatrix(0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0.5, 1); // a perspective
  ExpectWords(OnlyErrorOf(filter), { "input port 1, connection 0" });
}

TEST(PanelMethods, DynamicInputsAreRemoved)
{
  const auto filter = MakeFilter(MakeSmallScene(), 2000);
  ASSERT_GT(filter->GetNumberOfInputConnections(1), 0);
  const int fixed = filter->GetNumberOfInputConnections(0);
  filter->RemoveAllDynamicInputs();
  EXPECT_EQ(filter->GetNumberOfInputConnections(1), 0);
  EXPECT_EQ(filter->GetNumberOfInputConnections(0), fixed);
}

TEST(PanelMethods, AQuantityIsReadFromTheNamedArrayOrFromNone)
{
  Scene scene = MakeSmallScene();
  SetCellValues(scene.Fixed[0], "White", { 0.9 });
  SetCellValues(scene.Fixed[0], "DiffuseReflectance", { 0.1 });
  const auto filter = MakeFilter(scene, 2000);
  const auto absorbed = [&] {
    filter->Update();
    return Field(filter, "NumberOfSegments");
  };
  const double dark = absorbed();
  filter->SetCellArray("DiffuseReflectance", "White");
  const double white = absorbed();
  filter->SetCellArray("DiffuseReflectance", "None");
  const double none = absorbed();
  EXPECT_LT(dark, none); // of DefaultDiffuseReflectance, 0.5
  EXPECT_LT(none, white);
  filter->SetCellArray("DiffuseReflectance", "");
  EXPECT_EQ(absorbed(), none);
  filter->SetCellArray("DiffuseReflectance", "Absent");
  ExpectWords(OnlyErrorOf(filter), { "Absent" });
  filter->SetCellArray("DiffuseReflectance", "DiffuseReflectance");
  EXPECT_EQ(absorbed(), dark);
}

TEST(PanelMethods, AnUnknownQuantityIsAnError)
{
  const auto filter = MakeFilter(MakeSmallScene(), 2000);
  const auto observer = ErrorObserver::Watch(filter);
  filter->SetCellArray("Colour", "RadiantExitance");
  ExpectOne(observer->Errors, { "Colour" });
}

TEST(PanelMethods, FiguresAreThoseOfTheFieldData)
{
  Scene scene = MakeSmallScene();
  scene.Fixed.push_back(MakeLamp({ 1, 1, 1.5 }, 0.2, { 1, 2, 3 }));
  const auto filter = MakeFilter(scene, 2000);
  EXPECT_TRUE(std::isnan(filter->GetFigure("EmittedPower")));
  EXPECT_TRUE(std::isnan(filter->GetFigure("HistoryBytes")));
  filter->Update();
  vtkFieldData* fields = filter->GetOutput()->GetFieldData();
  const double* emitted = fields->GetArray("EmittedPower")->GetTuple3(0);
  EXPECT_EQ(filter->GetFigure("EmittedPower"), emitted[0] + emitted[1] + emitted[2]);
  EXPECT_DOUBLE_EQ(filter->GetFigure("AbsorbedPower") + filter->GetFigure("EscapedPower"),
    filter->GetFigure("EmittedPower"));
  EXPECT_EQ(filter->GetFigure("StalePower"), 0);
  EXPECT_EQ(filter->GetFigure("NumberOfWalks"), 2000);
  EXPECT_TRUE(std::isnan(filter->GetFigure("NumberOfGatherRays"))); // no cell gathers
  EXPECT_EQ(
    filter->GetFigure("NumberOfSegments"), fields->GetArray("NumberOfSegments")->GetTuple1(0));
  EXPECT_GT(filter->GetFigure("HistoryBytes"), 0);
  EXPECT_GT(filter->GetFigure("ShootSeconds"), 0);
  EXPECT_TRUE(std::isnan(filter->GetFigure("ReachedRelativeError"))); // no target
  EXPECT_TRUE(std::isnan(filter->GetFigure("NoFigure")));
}

TEST(PanelMethods, OldNamesWarnOnce)
{
  const auto filter = MakeFilter(MakeSmallScene(), 2000);
  filter->Update();
  const auto observer = ErrorObserver::Watch(filter);
  for (int call = 0; call < 2; ++call)
  {
    EXPECT_EQ(filter->GetEmittedPower(), filter->GetFigure("EmittedPower"));
    EXPECT_EQ(filter->GetNumberOfShotWalks(), filter->GetFigure("NumberOfWalks"));
  }
  ASSERT_EQ(observer->Warnings.size(), 2u);
  EXPECT_NE(observer->Warnings[0].find("call GetFigure(\"EmittedPower\")"), std::string::npos);
  EXPECT_NE(observer->Warnings[1].find("call GetFigure(\"NumberOfWalks\")"), std::string::npos);
  filter->SetDynamicTransformInterpolator(0, nullptr);
  ExpectOne(observer->Errors, { "vtkKeyFramedPose" });
}
