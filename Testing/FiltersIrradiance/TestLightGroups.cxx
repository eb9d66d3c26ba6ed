// SPDX-License-Identifier: BSD-3-Clause
// Lamps name their groups in arrays; factors come from properties and from field data over time.

#include "ErrorObserver.h"
#include "OutputBits.h"
#include "TestScenes.h"

#include "vtkIntArray.h"
#include "vtkIrradianceProbeFilter.h"
#include "vtkOutgoingRadianceFilter.h"
#include "vtkPointIrradianceFilter.h"
#include "vtkStringArray.h"

#include <gtest/gtest.h>

#include <numeric>

using namespace TestScenes;

namespace
{

/// A text array of cells or of field data.
void SetNames(vtkFieldData* data, const std::vector<std::string>& names)
{
  vtkNew<vtkStringArray> array;
  array->SetName("LightGroup");
  for (const std::string& name : names)
  {
    array->InsertNextValue(name);
  }
  data->AddArray(array);
}

/// A room with lamps in the groups "a", "7" and "Dynamic 0", of which the last moves.
Scene MakeLampScene()
{
  Scene scene = MakeSmallScene();
  Mesh lamps = Join(
    { MakeLamp({ 0.75, 0.75, 2.5 }, 0.5, { 50 }), MakeLamp({ 2.25, 0.75, 2.5 }, 0.5, { 80 }) });
  vtkNew<vtkIntArray> numbers;
  numbers->SetName("LightGroup");
  numbers->InsertNextValue(7);
  numbers->InsertNextValue(8);
  lamps->GetCellData()->AddArray(numbers);
  SetNames(scene.Fixed[1]->GetFieldData(), { "a" });
  scene.Fixed.push_back(lamps);
  scene.Moving.push_back(MakeMoving(MakeLamp({ 0, 0, 0 }, 0.4, { 60 }), { 2, 1, 1.5 }));
  return scene;
}

vtkSmartPointer<vtkIrradianceFilter> MakeGroups(const Scene& scene)
{
  auto filter = MakeFilter(scene, 3000);
  filter->ComputeLightGroupsOn();
  filter->ComputeStandardErrorOn();
  return filter;
}

std::vector<std::string> NamesOf(vtkIrradianceFilter* filter)
{
  auto* names = vtkStringArray::SafeDownCast(
    filter->GetOutput()->GetFieldData()->GetAbstractArray("LightGroups"));
  std::vector<std::string> all;
  for (vtkIdType i = 0; names && i < names->GetNumberOfValues(); ++i)
  {
    all.push_back(names->GetValue(i));
  }
  return all;
}

std::vector<double> OfFloor(vtkIrradianceFilter* filter, const std::string& name)
{
  return ValuesOf(OutputOf(filter->GetOutput(), 0, 0)->GetCellData()->GetArray(name.c_str()));
}

TEST(LightGroups, AreNamedByCellsFieldsAndConnections)
{
  const Scene scene = MakeLampScene();
  const auto filter = MakeGroups(scene);
  filter->Update();
  const std::vector<std::string> names{ "7", "8", "Dynamic 2", "a" };
  ASSERT_EQ(NamesOf(filter), names);
  const std::vector<double> all = OfFloor(filter, "Irradiance");
  std::vector<double> sum(all.size()), squares(all.size());
  for (const std::string& name : names)
  {
    const std::vector<double> part = OfFloor(filter, "Irradiance_" + name);
    EXPECT_GT(std::accumulate(part.begin(), part.end(), 0.0), 0) << name;
    std::transform(sum.begin(), sum.end(), part.begin(), sum.begin(), std::plus<double>());
    const std::vector<double> error = OfFloor(filter, "Irradiance_" + name + "StandardError");
    EXPECT_EQ(error.size(), all.size());
  }
  EXPECT_EQ(sum, all);
  EXPECT_NEAR(filter->GetFigure("EmittedPower"), 56.25 + 12.5 + 20 + 9.6, 1e-5);
  EXPECT_NEAR(filter->GetFigure("AbsorbedPower") + filter->GetFigure("EscapedPower"), 98.35, 1e-5);
}

TEST(LightGroups, FactorsOfPropertiesAndFieldsMultiply)
{
  const Scene scene = MakeLampScene();
  const auto filter = MakeGroups(scene);
  filter->Update();
  const std::vector<double> full = OfFloor(filter, "Irradiance_a");
  filter->SetLightGroupFactor("a", 0.7);
  EXPECT_EQ(filter->GetLightGroupFactor("a"), 0.7);
  filter->Update();
  std::vector<double> expected = full;
  std::for_each(expected.begin(), expected.end(), [](double& value) { value *= 0.7; });
  EXPECT_EQ(OfFloor(filter, "Irradiance_a"), expected);
  EXPECT_EQ(filter->GetFigure("NumberOfRepairedSegments"), 0);
  SetField(scene.Fixed[1], "LightGroupFactor", { 0.5 });
  scene.Fixed[1]->Modified();
  filter->Update();
  EXPECT_EQ(filter->GetFigure("ShootSeconds"), 0);
  expected = full;
  std::for_each(expected.begin(), expected.end(), [](double& value) { value *= 0.7 * 0.5; });
  EXPECT_EQ(OfFloor(filter, "Irradiance_a"), expected);
  filter->SetLightGroupFactor("a", 0);
  filter->Update();
  EXPECT_EQ(OfFloor(filter, "Irradiance_a"), std::vector<double>(full.size(), 0.0));
  filter->RemoveAllLightGroupFactors();
  scene.Fixed[1]->GetFieldData()->RemoveArray("LightGroupFactor");
  scene.Fixed[1]->Modified();
  filter->Update();
  EXPECT_EQ(OfFloor(filter, "Irradiance_a"), full);
  EXPECT_TRUE(IsSame(OutputBits(filter), [&] {
    const auto fresh = MakeGroups(scene);
    fresh->Update();
    return OutputBits(fresh);
  }()));
}

TEST(LightGroups, ASeedOfOneShootsItAlone)
{
  const Scene scene = MakeLampScene();
  const auto filter = MakeGroups(scene);
  filter->Update();
  const std::vector<double> ofA = OfFloor(filter, "Irradiance_a"),
                            of7 = OfFloor(filter, "Irradiance_7");
  filter->SetLightGroupSeed("a", 5);
  EXPECT_EQ(filter->GetLightGroupSeed("a"), 5);
  EXPECT_EQ(filter->GetLightGroupSeed("7"), filter->GetSeed());
  filter->Update();
  EXPECT_NE(OfFloor(filter, "Irradiance_a"), ofA);
  EXPECT_EQ(OfFloor(filter, "Irradiance_7"), of7);
  filter->RemoveAllLightGroupSeeds();
  filter->Update();
  EXPECT_EQ(OfFloor(filter, "Irradiance_a"), ofA);
}

/// A table of names and factors, for lamps that cells name.
TEST(LightGroups, ATableOfFactorsStandsInFieldData)
{
  const Scene scene = MakeLampScene();
  const auto filter = MakeGroups(scene);
  filter->Update();
  const std::vector<double> seven = OfFloor(filter, "Irradiance_7"),
                            eight = OfFloor(filter, "Irradiance_8");
  SetNames(scene.Fixed[2]->GetFieldData(), { "7", "8" });
  SetField(scene.Fixed[2], "LightGroupFactor", { 2, 0 });
  scene.Fixed[2]->Modified();
  filter->Update();
  std::vector<double> twice = seven;
  std::for_each(twice.begin(), twice.end(), [](double& value) { value *= 2; });
  EXPECT_EQ(OfFloor(filter, "Irradiance_7"), twice);
  EXPECT_EQ(OfFloor(filter, "Irradiance_8"), std::vector<double>(eight.size(), 0.0));
}

TEST(LightGroups, ALampThatMovesIsAGroupOfItsOwn)
{
  const Scene scene = MakeLampScene();
  for (const int method : { vtkIrradianceFilter::Automatic, vtkIrradianceFilter::Walks,
         vtkIrradianceFilter::SpreadWalks, vtkIrradianceFilter::Gathered })
  {
    const auto filter = MakeGroups(scene), fresh = MakeGroups(scene);
    filter->SetMethod(method);
    fresh->SetMethod(method);
    filter->Update();
    const std::vector<double> resting = OfFloor(filter, "Irradiance_8");
    scene.Moving[2].Pose->Translate(-0.3, 0.2, 0.1);
    EXPECT_TRUE(UpdatesLike(filter, fresh)) << method;
    EXPECT_NE(OfFloor(filter, "Irradiance_8"), std::vector<double>(resting.size(), 0.0));
  }
}

/// The parts of what sensors, points and an eye see add up, too: with all other groups off, each
/// is what its group brings.
TEST(LightGroups, AddUpForSensorsPointsAndEyes)
{
  const Scene scene = MakeLampScene();
  const auto filter = MakeGroups(scene);
  vtkNew<vtkIrradianceProbeFilter> probe;
  probe->SetInputData(MakeSensors({ { 1, 1, 0.5 }, { 2, 2.5, 1 } }, { { 0, 0, 1 } }));
  probe->SetSourceConnection(filter->GetOutputPort());
  probe->SetEstimateToGathered();
  vtkNew<vtkPointIrradianceFilter> points;
  points->SetInputConnection(filter->GetOutputPort());
  vtkNew<vtkOutgoingRadianceFilter> eye;
  eye->SetInputConnection(filter->GetOutputPort());
  eye->SetEyePosition(1.5, 1.5, 1.2);
  using Values = std::array<std::vector<double>, 3>;
  const auto seen = [&] {
    probe->Update();
    points->Update();
    eye->Update();
    auto* ofPoints = vtkMultiBlockDataSet::SafeDownCast(points->GetOutputDataObject(0));
    auto* ofEye = vtkMultiBlockDataSet::SafeDownCast(eye->GetOutputDataObject(0));
    return Values{ ValuesOf(vtkDataSet::SafeDownCast(probe->GetOutputDataObject(0))
                              ->GetPointData()
                              ->GetArray("Irradiance")),
      ValuesOf(OutputOf(ofPoints, 0, 0)->GetPointData()->GetArray("PointIrradiance")),
      ValuesOf(OutputOf(ofEye, 0, 0)->GetCellData()->GetArray("Radiance")) };
  };
  const std::vector<std::string> names{ "7", "8", "Dynamic 2", "a" };
  const Values all = seen();
  Values sums;
  for (const std::string& name : names)
  {
    for (const std::string& other : names)
    {
      filter->SetLightGroupFactor(other.c_str(), other == name ? 1 : 0);
    }
    const Values part = seen();
    for (std::size_t i = 0; i < part.size(); ++i)
    {
      sums[i].resize(part[i].size());
      std::transform(
        sums[i].begin(), sums[i].end(), part[i].begin(), sums[i].begin(), std::plus<double>());
    }
  }
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    ASSERT_EQ(sums[i].size(), all[i].size());
    for (std::size_t k = 0; k < all[i].size(); ++k)
    {
      // Points without light are NaN in no part, or in all.
      EXPECT_TRUE(std::abs(sums[i][k] - all[i][k]) <= 1e-12 * all[i][k] ||
        (std::isnan(sums[i][k]) && std::isnan(all[i][k])))
        << i << ", " << k;
    }
  }
}

TEST(LightGroups, OddInputIsOneErrorAndUnknownNamesAreAWarning)
{
  const Scene scene = MakeLampScene();
  const auto filter = MakeGroups(scene);
  const auto observer = ErrorObserver::Watch(filter);
  filter->SetLightGroupFactor("ceiling", 0.5);
  filter->Update();
  filter->Modified();
  filter->Update();
  ASSERT_EQ(observer->Warnings.size(), 1u);
  ExpectWords(observer->Warnings[0], { "ceiling", "LightGroup" });
  observer->Clear();
  filter->SetLightGroupFactor("a", -1);
  ASSERT_EQ(observer->Errors.size(), 1u);
  ExpectWords(observer->Errors[0], { "light group a", "-1" });
  filter->RemoveAllLightGroupFactors();
  const auto expectError = [&](const std::vector<std::string>& words) {
    observer->Clear();
    scene.Fixed[1]->Modified();
    filter->Update();
    ASSERT_EQ(observer->Errors.size(), 1u);
    ExpectWords(observer->Errors[0], words);
  };
  SetField(scene.Fixed[1], "LightGroupFactor", { std::nan("") });
  expectError({ "input port 0, connection 1", "factor of light group a", "nan" });
  SetField(scene.Fixed[1], "LightGroupFactor", { 1, 2 });
  expectError({ "input port 0, connection 1", "LightGroupFactor", "1 tuples" });
  scene.Fixed[1]->GetFieldData()->RemoveArray("LightGroupFactor");
  SetNames(scene.Fixed[1]->GetFieldData(), { "" });
  expectError({ "input port 0, connection 1", "empty name" });
}

}
