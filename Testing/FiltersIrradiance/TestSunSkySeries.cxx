// SPDX-License-Identifier: BSD-3-Clause
// A sky over time, from a file of weather; what there is at night; and input that has no sky.

#include "SkyOf.h"

#include "../WriteFile.h"
#include "ErrorObserver.h"

#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <limits>

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

constexpr SkyOf::Direction kUp{ 0, 0, 1 };

/// In Munich.
vtkSmartPointer<vtkSunSkySource> MakeSeries(const std::string& text)
{
  auto source = vtkSmartPointer<vtkSunSkySource>::New();
  source->SetLatitude(48.1);
  source->SetLongitude(11.6);
  source->SetTimeZone(1);
  source->SetWeatherFileName(WriteFile("Weather.csv", text).c_str());
  return source;
}

/// The only error of an update; the output must have no fields.
std::string SkyErrorOf(vtkSunSkySource* source)
{
  source->Modified(); // a file is read again
  const Reports reports = Update(source);
  EXPECT_EQ(source->GetOutput()->GetFieldData()->GetNumberOfArrays(), 0);
  EXPECT_EQ(reports.Errors.size(), 1u) << testing::PrintToString(reports.Errors);
  EXPECT_TRUE(reports.Warnings.empty());
  return reports.Errors.empty() ? "" : reports.Errors[0];
}

const char* const kDay = "\xef\xbb\xbf\"DHI\", Time, remark, dni\r\n"
                         "# one day\r\n"
                         "0,2024-06-21 00:00,night,0\r\n\r\n"
                         "95.5,2024-06-21T09:00:30,clear,700\r\n"
                         "120,2024-06-21 12:00,,800\r\n"
                         "4,2024-06-21 22:00,dusk,20\r\n";

}

TEST(SunSky, FollowsTheWeather)
{
  auto source = MakeSeries(kDay);
  source->SetDirectNormalIrradiance(-1); // the series counts
  source->SetSunFromToAngles();
  source->UpdateInformation();
  vtkInformation* info = source->GetOutputInformation(0);
  ASSERT_EQ(info->Length(Pipeline::TIME_STEPS()), 4);
  double steps[4];
  std::copy_n(info->Get(Pipeline::TIME_STEPS()), 4, steps);
  EXPECT_EQ(std::vector<double>(steps, steps + 4),
    (std::vector<double>{ 0, 9 * 3600 + 30, 12 * 3600, 22 * 3600 }));
  EXPECT_EQ(info->Get(Pipeline::TIME_RANGE())[1], 22 * 3600);

  const struct
  {
    double Time, Direct, Diffuse;
    bool IsNoted;
  } times[] = { { -5, 0, 0, false }, { 0, 0, 0, false }, { 32429, 0, 0, false },
    { 32430, 700, 95.5, false }, { 40000, 700, 95.5, false }, { 43200, 800, 120, false },
    { 79200, 0, 4, true }, { 1e9, 0, 4, true } };
  std::size_t angles = 0;
  for (const auto& time : times)
  {
    const SkyOf sky(source, time.Time);
    EXPECT_EQ(sky.SunIrradiance, time.Direct) << time.Time;
    const double row = source->GetOutput()->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP());
    EXPECT_EQ(row, *(std::upper_bound(steps, steps + 4, std::max(time.Time, 0.)) - 1));
    EXPECT_NEAR(sky.Irradiance(kUp), time.Diffuse, 1e-5 * time.Diffuse) << time.Time;
    EXPECT_EQ(sky.Sun[2] > 0, time.Direct > 0) << time.Time;
    EXPECT_EQ(!sky.Note.empty(), time.IsNoted) << sky.Note;
    angles = sky.PolarAngles.size();
    EXPECT_GT(angles, 30u);
  }
  const SkyOf night(source, 0);
  EXPECT_EQ(*std::max_element(night.Radiance.begin(), night.Radiance.end()), 0);
  ExpectWords(SkyOf(source, 79200).Note, { "line 7 of ", "the sun is below the horizon" });
  // At noon of local solar time the sun is in the south.
  EXPECT_LT(SkyOf(source, 43200).Sun[1], -0.3);
  source->SetWeatherFileName(nullptr);
  source->SetDirectNormalIrradiance(0);
  source->UpdateInformation();
  EXPECT_FALSE(info->Has(Pipeline::TIME_STEPS()));
  EXPECT_FALSE(info->Has(Pipeline::TIME_RANGE()));
}

TEST(SunSky, HasANight)
{
  auto source = vtkSmartPointer<vtkSunSkySource>::New();
  source->SetSkyModelToCIEClear();
  source->SetSunAltitude(-3);
  source->SetDirectNormalIrradiance(500);
  source->SetDiffuseHorizontalIrradiance(2);
  SkyOf sky(source);
  EXPECT_EQ(sky.SunIrradiance, 0);
  EXPECT_LT(sky.Sun[2], 0);
  EXPECT_NEAR(sky.Irradiance(kUp), 2, 1e-5);
  EXPECT_NEAR(sky.At(120, 0), 0.2 * 2 / vtkMath::Pi(), 1e-12); // the ground has no sunlight
  EXPECT_EQ(sky.Note, "the sun is below the horizon");
  const double below = sky.At(90, 180);
  source->SetSunAltitude(0);
  EXPECT_EQ(SkyOf(source).At(90, 180), below);
  source->SetDiffuseHorizontalIrradiance(0);
  source->SetSunAltitude(-3);
  sky = SkyOf(source);
  EXPECT_EQ(*std::max_element(sky.Radiance.begin(), sky.Radiance.end()), 0);
  EXPECT_EQ(sky.Note, "");
  source->SetSunAltitude(20); // the sun alone; the ground is in its light
  sky = SkyOf(source);
  EXPECT_EQ(sky.Irradiance(kUp), 0);
  EXPECT_EQ(sky.SunIrradiance, 500);
  EXPECT_GT(sky.At(120, 0), 10);
}

// Input for which the model of Perez has b > 0, or a radiance below 0.
TEST(SunSky, SaysWherePerezHasNoSky)
{
  auto source = vtkSmartPointer<vtkSunSkySource>::New();
  source->SetSunAltitude(80);
  source->SetDirectNormalIrradiance(150);
  source->SetDiffuseHorizontalIrradiance(50);
  ExpectWords(SkyErrorOf(source),
    { "SkyModel Perez", "DirectNormalIrradiance 150", "DiffuseHorizontalIrradiance 50",
      "altitude of 80", "without limit", "choose a CIE sky" });
  source->SetSunAltitude(60);
  source->SetDirectNormalIrradiance(60);
  source->SetDiffuseHorizontalIrradiance(20);
  ExpectWords(SkyErrorOf(source), { "DirectNormalIrradiance 60", "would be negative" });
  source->SetSkyModelToCIEClear();
  EXPECT_NEAR(SkyOf(source).Irradiance(kUp), 20, 1e-4);

  // On the equator at noon of an equinox, and when the sun is 60 degrees high.
  auto series = MakeSeries("time,DNI,DHI\n2024-03-20 10:08,60,20\n2024-03-20 12:00,150,50\n");
  series->SetLatitude(0);
  series->SetLongitude(0);
  series->SetTimeZone(0);
  SkyOf sky(series, 0);
  EXPECT_NEAR(sky.Irradiance(kUp), 20, 1e-4);
  ExpectWords(sky.Note, { "line 2 of ", "negative" });
  sky = SkyOf(series, 7000);
  EXPECT_NEAR(sky.Irradiance(kUp), 50, 1e-3);
  ExpectWords(sky.Note, { "line 3 of ", "without limit", "counts as 0" });
}

TEST(SunSky, RefusesBadProperties)
{
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = HUGE_VAL;
  using Change = void (*)(vtkSunSkySource*, double);
  const struct
  {
    const char* Name;
    Change Set;
    std::vector<double> Bad;
  } properties[] = {
    { "DirectNormalIrradiance", [](auto* s, double v) { s->SetDirectNormalIrradiance(v); },
      { -5, nan, infinite } },
    { "DiffuseHorizontalIrradiance",
      [](auto* s, double v) { s->SetDiffuseHorizontalIrradiance(v); }, { -0.1, nan } },
    { "SunAngularRadius", [](auto* s, double v) { s->SetSunAngularRadius(v); }, { -1, 11, nan } },
    { "SunAltitude", [](auto* s, double v) { s->SetSunAltitude(v); }, { -91, 90.5, nan } },
    { "SunAzimuth", [](auto* s, double v) { s->SetSunAzimuth(v); }, { infinite, nan } },
    { "North", [](auto* s, double v) { s->SetNorth(v); }, { -infinite, nan } },
    { "GroundReflectance", [](auto* s, double v) { s->SetGroundReflectance(v); }, { -1, 1.1 } },
    { "CIEType", [](auto* s, double v) { s->SetCIEType(static_cast<int>(v)); }, { 0, 16 } },
    { "Latitude", [](auto* s, double v) { s->SetLatitude(v); }, { -91, 91, nan } },
    { "Longitude", [](auto* s, double v) { s->SetLongitude(v); }, { -181, 361, nan } },
    { "TimeZone", [](auto* s, double v) { s->SetTimeZone(v); }, { -15, 60, nan } },
  };
  for (const auto& property : properties)
  {
    const std::string name = property.Name;
    auto source = vtkSmartPointer<vtkSunSkySource>::New();
    source->SetSkyModelToCIEGeneral();
    source->SetDateTime("2024-06-21 12:00");
    source->SetSunFrom(name == "Latitude" || name == "Longitude" || name == "TimeZone");
    for (const double bad : property.Bad)
    {
      property.Set(source, bad);
      std::ostringstream value;
      value << name << " is " << bad << "; it has to be ";
      ExpectWords(SkyErrorOf(source), { value.str() });
    }
    property.Set(source, 1);
    ExpectNothing(Update(source));
  }
  auto source = vtkSmartPointer<vtkSunSkySource>::New();
  source->SetSunFromToPlaceAndTime();
  for (const char* time : { "", "noon", "2024-06-21", "21.06.2024 12:00", "2024-06-21 12:0",
         "2024-06-21  2:00x", "2024-02-30 12:00", "2023-02-29 12:00", "2024-13-01 12:00",
         "2024-06-21 24:00", "2024-06-21 12:60", "1900-06-21 12:00", "2100-01-01 00:00",
         "2024-06-21 12:00 PM", "2024-06-21 12:00+02:00" })
  {
    source->SetDateTime(time);
    ExpectWords(SkyErrorOf(source), { "DateTime is \"" + std::string(time) + "\"" });
  }
  source->SetDateTime("2024-02-29 23:59:59");
  ExpectNothing(Update(source));
}

TEST(SunSky, RefusesBadFiles)
{
  const struct
  {
    const char* Text;
    std::vector<std::string> Words;
  } files[] = {
    { "", { "Weather.csv is empty" } },
    { "time,DNI,DHI\n", { "Weather.csv has no row of weather" } },
    { "time,DNI\n2024-01-01 12:00,1\n", { "line 1 of", "there is no column dhi" } },
    { "time,DNI,dni,DHI\n", { "two columns are named dni" } },
    { "time,DNI,DHI\n2024-01-01 12:00,1,-2\n", { "line 2 of", "column dhi: -2 W/m2" } },
    { "time,DNI,DHI\n2024-01-01 12:00,nan,2\n", { "line 2 of", "column dni: nan is not finite" } },
    { "time,DNI,DHI\n2024-01-01 12:00,,2\n", { "column dni: \"\" is not a number" } },
    { "time,DNI,DHI\n2024-01-01 12:00,1\n",
      { "line 2 of", "has 2 values and none in the column" } },
    { "time,DNI,DHI\n2024-01-01 12:00,1,2\n1/2/2024,1,2\n",
      { "line 3 of", "column time: \"1/2/2024\" is no time" } },
    { "time,DNI,DHI\n2024-01-01 12:00,1,2\n2024-01-01 12:00:00,1,2\n",
      { "line 3 of", "2024-01-01 12:00:00 is not after" } },
  };
  for (const auto& file : files)
  {
    ExpectWords(SkyErrorOf(MakeSeries(file.Text)), file.Words);
  }
  auto source = MakeSeries(kDay);
  source->SetWeatherFileName("/there/is/no/such/file.csv");
  ExpectWords(SkyErrorOf(source), { "/there/is/no/such/file.csv cannot be read" });
  source->SetWeatherFileName(WriteFile("Weather.csv", kDay).c_str());
  ExpectNothing(Update(source)); // it stayed usable
}
