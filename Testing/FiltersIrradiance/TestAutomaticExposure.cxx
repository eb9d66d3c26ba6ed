// SPDX-License-Identifier: BSD-3-Clause
// The dose that somebody gets who chooses no times: they follow from the irradiance, or from the
// input if that has some times alone.

#include "ExposureScenes.h"
#include "StripLamp.h"

#include "vtkKeyFramedPose.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <cstdio>

using namespace ExposureScenes;

namespace
{

Exposure MakeDefault(vtkAlgorithm* input)
{
  auto exposure = Exposure::New();
  exposure->SetInputConnection(input->GetOutputPort());
  return exposure;
}

}

TEST(AutomaticExposure, IsTheDefault)
{
  vtkNew<vtkRadiantExposureFilter> exposure;
  EXPECT_EQ(exposure->GetIntegrationMode(), vtkRadiantExposureFilter::Automatic);
}

// Two key frames are all that is said of the ride, whose steps by default are fine enough, too. With
// 50,000 walks the noise of a row is 0.7 %, and the integration over time may be off by 1 %: 4 % are
// exceeded once in 50,000 seeds.
TEST(AutomaticExposure, OfARideUnderALampIsTheClosedForm)
{
  vtkNew<vtkKeyFramedPose> ride;
  ride->SetInputData(StripLamp::Plate());
  ride->AddPose(0, -StripLamp::Way / 2, 0, 0, 0, 0, 0);
  ride->AddPose(StripLamp::Way / StripLamp::Speed, StripLamp::Way / 2, 0, 0, 0, 0, 0);
  const auto irradiance = MakeFilter({ { StripLamp::Lamp() }, {} }, 50000);
  irradiance->SetDefaultDiffuseReflectance(0);
  irradiance->AddInputConnection(1, ride->GetOutputPort());
  for (const auto& exposure : { MakeDefault(irradiance), MakeExposure(irradiance) })
  {
    ExpectNothing(Update(exposure));
    for (int row = 0; row < StripLamp::Rows; ++row)
    {
      const double exact = StripLamp::ExposureOfRow(row);
      EXPECT_NEAR(ExposureOf(exposure, 1, 0)->GetComponent(row, 0), exact, 0.04 * exact);
    }
  }
}

// A file has its steps alone, and its reader takes one of them for any other time.
TEST(AutomaticExposure, OfAFileIsTheTrapezoidOverItsSteps)
{
  const std::string name = testing::TempDir() + "irradiance_over_time.vtp";
  const std::vector<double> times{ 0, 1, 2 };
  Mesh square = MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetFileName(name.c_str());
  writer->SetInputData(square);
  writer->SetNumberOfTimeSteps(static_cast<int>(times.size()));
  writer->Start();
  for (const double time : times)
  {
    SetCellValues(square, "Irradiance", { 3 + 2 * time * time });
    writer->WriteNextTime(time);
  }
  writer->Stop();
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(name.c_str());
  const auto exposure = MakeDefault(reader);
  EXPECT_TRUE(Update(exposure).Errors.empty());
  EXPECT_EQ(SquareExposure(exposure), 0.5 * (3 + 5) + 0.5 * (5 + 11));
  EXPECT_EQ(IntegrationTimesOf(exposure), times);
  EXPECT_FALSE(exposure->GetOutputDataObject(0)->GetFieldData()->HasArray("TimeIntegrationError"));
  std::remove(name.c_str());
}

// The same if a part of the scene comes from a file: the irradiance filter computes any time, but
// the part stays where it was.
TEST(AutomaticExposure, OfASceneWithAPartFromAFileIsThatOfItsSteps)
{
  const WalkThrough scene(1000);
  scene.Ball->Change = [](vtkPolyData* ball, double time) {
    const auto step = std::prev(std::upper_bound(kTimes.begin(), kTimes.end(), time));
    MoveTo(ball, WalkThrough::PositionAt(*step));
    ball->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), *step);
  };
  const auto exposure = MakeDefault(scene.Irradiance);
  exposure->Update();
  EXPECT_EQ(IntegrationTimesOf(exposure), kTimes);
  ExpectSumOverFresh(exposure, scene, kTimes);
}

TEST(AutomaticExposure, ContinuesAfterAnAbort)
{
  for (const bool isFile : { false, true })
  {
    const auto make = [isFile] {
      return MakeLitSquare({ 0, 1, 4 }, [](double time) { return 3 + time * time; });
    };
    const auto square = make(), other = make();
    for (const auto& part : { square, other })
    {
      const auto change = part->Change;
      part->Change = [=](vtkPolyData* polyData, double time) {
        const double given = isFile ? std::floor(time) : time;
        change(polyData, given);
        polyData->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), given);
      };
    }
    const auto exposure = MakeDefault(square), whole = MakeDefault(other);
    const auto aborter = EventObserver::Watch(exposure);
    for (const int events : { 2, 3, 0 }) // first after the look between steps
    {
      aborter->AbortIn = events;
      exposure->SetAbortExecute(0);
      exposure->Modified();
      exposure->Update();
    }
    whole->Update();
    EXPECT_EQ(square->Visits, other->Visits);
    EXPECT_EQ(SquareExposure(exposure), SquareExposure(whole));
    EXPECT_EQ(IntegrationTimesOf(exposure), IntegrationTimesOf(whole));
  }
}

// Nothing changes, so there are no times but those asked for.
TEST(AutomaticExposure, OfAStillSceneIsItsIrradianceTimesTheTime)
{
  const auto square = MakeLitSquare({}, [](double) { return 5; });
  const auto exposure = MakeDefault(square);
  exposure->SetStartTime(1);
  exposure->SetEndTime(3);
  exposure->Update();
  EXPECT_NEAR(SquareExposure(exposure), 10, 1e-14);
  EXPECT_EQ(square->Visits.size(), 1u);
}
