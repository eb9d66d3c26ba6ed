// SPDX-License-Identifier: BSD-3-Clause
// What light groups bring over time, and to sensors: their parts add up to the whole.

#include "ExposureScenes.h"
#include "SensorPipeline.h"

#include "vtkStringArray.h"

using namespace ExposureScenes;

namespace
{

const std::vector<double> kSteps{ 0, 1, 2, 3, 4 };

bool IsEven(double time)
{
  return std::fmod(time, 2) == 0;
}

void NameGroup(vtkPolyData* lamp, const char* name)
{
  vtkNew<vtkStringArray> group;
  group->SetName("LightGroup");
  group->InsertNextValue(name);
  lamp->GetFieldData()->AddArray(group);
}

/// A room whose own lamp always shines, and another, of the group "second", that changes over time.
struct TwoLamps
{
  explicit TwoLamps(const std::function<void(vtkPolyData*, double)>& change)
    : Second(PartOverTime::Make(
        MakeLamp({ 0.6, 0.6, 2 }, 0.5, { 40 }), kSteps, [change](vtkPolyData* lamp, double time) {
          NameGroup(lamp, "second");
          change(lamp, time);
        }))
  {
    this->Light->AddInputConnection(0, this->Second->GetOutputPort());
    this->Light->ComputeLightGroupsOn();
  }

  vtkSmartPointer<PartOverTime> Second;
  vtkSmartPointer<vtkIrradianceFilter> Light = MakeFilter(MakeEmptyRoom(), 2000);
};

std::vector<double> Values(vtkMultiBlockDataSet* output, const char* name)
{
  return ValuesOf(OutputOf(output, 0, 0)->GetCellData()->GetArray(name));
}

void ExpectMultiple(
  const std::vector<double>& values, double factor, const std::vector<double>& times)
{
  ASSERT_EQ(values.size(), times.size());
  EXPECT_GT(*std::max_element(values.begin(), values.end()), 0);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    EXPECT_NEAR(values[i], factor * times[i], 1e-13 * values[i]) << i;
  }
}

void ExpectSum(const std::vector<double>& whole, const std::vector<double>& first,
  const std::vector<double>& second)
{
  ASSERT_EQ(whole.size(), first.size());
  ASSERT_EQ(whole.size(), second.size());
  std::vector<double> sum = first;
  std::transform(sum.begin(), sum.end(), second.begin(), sum.begin(), std::plus<>());
  ExpectMultiple(whole, 1, sum);
}

void SwitchOff(vtkPolyData* lamp, double time)
{
  SetField(lamp, "LightGroupFactor", { IsEven(time) ? 1.0 : 0.0 });
}

/// There is no such group then.
void Darken(vtkPolyData* lamp, double time)
{
  SetCellValues(lamp, "RadiantExitance", { IsEven(time) ? 40.0 : 0.0 });
}

}

// The trapezoidal rule gives the times 0 to 4 the weights 1/2, 1, 1, 1, 1/2: those with light 2 of 4.
TEST(GroupDose, IsHalfWhereTheGroupIsOffHalfOfTheTime)
{
  for (const auto& change : { SwitchOff, Darken })
  {
    const TwoLamps scene(change);
    const auto dose = MakeExposure(scene.Light);
    dose->Update();
    scene.Light->UpdateTimeStep(0);
    const auto second = Values(BlocksOf(dose), "RadiantExposure_second");
    ExpectMultiple(second, 2, Values(scene.Light->GetOutput(), "Irradiance_second"));
    ExpectSum(Values(BlocksOf(dose), "RadiantExposure"),
      Values(BlocksOf(dose), "RadiantExposure_Static"), second);
  }
}

TEST(GroupDose, OfALampThatDoesNotChangeIsItsLightTimesTheTime)
{
  const TwoLamps scene(SwitchOff);
  const auto dose = MakeExposure(scene.Light);
  dose->Update();
  ExpectMultiple(Values(BlocksOf(dose), "RadiantExposure_Static"), 4,
    Values(scene.Light->GetOutput(), "Irradiance_Static"));
}

TEST(GroupDose, AddsUpOnEachSideWithErrorsAndErrorControl)
{
  const TwoLamps scene(
    [](vtkPolyData* lamp, double time) { SetField(lamp, "LightGroupFactor", { time * time }); });
  scene.Light->SeparateSidesOn();
  scene.Light->ComputeStandardErrorOn();
  const auto dose = MakeErrorControlled(scene.Light, 4, 0.01);
  dose->Update();
  EXPECT_GT(FieldOf(dose, "NumberOfTimeSteps"), 4) << "appended to no other sums";
  ExpectSum(Values(BlocksOf(dose), "RadiantExposureFront"),
    Values(BlocksOf(dose), "RadiantExposureFront_Static"),
    Values(BlocksOf(dose), "RadiantExposureFront_second"));
  vtkCellData* const cells = OutputOf(BlocksOf(dose), 0, 0)->GetCellData();
  for (int i = 0; i < cells->GetNumberOfArrays(); ++i)
  {
    EXPECT_EQ(std::string(cells->GetArrayName(i)).rfind("Irradiance", 0), std::string::npos)
      << cells->GetArrayName(i) << " is left of the input";
  }
}

TEST(GroupDose, SensorsHaveWhatEachGroupBrings)
{
  const Mesh sensors = MakePoints({ { 0.5, 0.5, 1 }, { 2.5, 1, 2 } });
  SensorPipeline pipeline(MakeEmptyRoom(), 2000, sensors);
  const Mesh second = MakeLamp({ 0.6, 0.6, 2 }, 0.5, { 40 });
  NameGroup(second, "second");
  pipeline.Irradiance->AddInputDataObject(0, second);
  pipeline.ExpectNothingSaid();
  EXPECT_FALSE(pipeline.Array("FluenceRate_second"));
  pipeline.Irradiance->ComputeLightGroupsOn();
  const auto whole = pipeline.Update("FluenceRate");
  const auto first = ValuesOf(pipeline.Array("FluenceRate_Static")),
             other = ValuesOf(pipeline.Array("FluenceRate_second"));
  ExpectSum(whole, first, other);
  EXPECT_STREQ(pipeline.Probe->GetOutput()->GetPointData()->GetScalars()->GetName(), "FluenceRate");

  pipeline.Irradiance->SetLightGroupFactor("second", 0.5);
  ExpectMultiple(pipeline.Update("FluenceRate_second"), 0.5, other);
  pipeline.Irradiance->SetLightGroupFactor("second", 0);
  EXPECT_EQ(pipeline.Update("FluenceRate_second"), std::vector<double>({ 0, 0 }));
  EXPECT_EQ(ValuesOf(pipeline.Array("FluenceRate_Static")), first);
}
