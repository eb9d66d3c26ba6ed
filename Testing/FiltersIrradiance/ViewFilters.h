// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ErrorObserver.h"
#include "OutputBits.h"
#include "OutputChecks.h"
#include "RandomView.h"

#include "vtkCamera.h"
#include "vtkIrradianceProbeFilter.h"
#include "vtkOutgoingRadianceFilter.h"
#include "vtkPointIrradianceFilter.h"

/// The filters behind a vtkIrradianceFilter that look at its photons.
class ViewFilters
{
public:
  explicit ViewFilters(vtkIrradianceFilter* filter)
  {
    this->Radiance->SetInputConnection(filter->GetOutputPort());
    this->Points->SetInputConnection(filter->GetOutputPort());
    this->Probe->SetSourceConnection(filter->GetOutputPort());
    this->Probe->SetEstimateToNearest();
  }

  void Apply(const RandomModels::View& view)
  {
    this->Given = view;
    this->Camera->SetPosition(view.Eye.data());
    this->Camera->SetFocalPoint(0, 0, 0);
    this->Camera->ParallelProjectionOn();
    this->Radiance->SetCamera(view.IsFar ? this->Camera.Get() : nullptr);
    this->Radiance->SetEyePosition(view.Eye.data());
    this->Radiance->SetNumberOfSpecularSamples(view.NumberOfSpecularSamples);
    this->Probe->SetInputData(view.Sensors);
    this->Probe->SetNumberOfPhotons(view.NumberOfPhotons);
    this->Probe->SetMaximumRadius(view.MaximumRadius);
    this->Probe->SetMaximumDistance(view.MaximumDistance);
    this->Points->SetNumberOfRays(view.NumberOfPointRays);
    this->Points->SetFeatureAngle(view.FeatureAngle);
  }

  /// Updates those that are used, and with them the vtkIrradianceFilter.
  void Update()
  {
    this->UpdateEach([](vtkAlgorithm* view) { view->Update(); });
  }
  void UpdateTimeStep(double time)
  {
    this->UpdateEach([time](vtkAlgorithm* view) { view->UpdateTimeStep(time); });
  }

  /// After an update, stale or not.
  void ExpectSound() const
  {
    for (const auto& reports : { this->EyeErrors, this->SensorErrors, this->PointErrors })
    {
      ASSERT_TRUE(reports->Errors.empty()) << reports->Errors.front();
    }
    if (this->Given.HasEye)
    {
      for (vtkPolyData* leaf : OutputChecks::LeavesOf(this->Radiance->GetOutput()))
      {
        ASSERT_TRUE(leaf->GetCellData()->HasArray("Radiance"));
        OutputChecks::ExpectFinite(leaf->GetCellData());
      }
    }
    if (this->Given.HasPoints)
    {
      for (vtkPolyData* leaf : OutputChecks::LeavesOf(this->Points->GetOutput()))
      {
        ExpectSoundPoints(leaf);
      }
    }
    for (vtkIdType i = 0; this->Given.HasSensors && i < this->Given.Sensors->GetNumberOfPoints();
         ++i)
    {
      ASSERT_NO_FATAL_FAILURE(this->ExpectSoundSensor(i));
    }
  }

  friend testing::AssertionResult IsSame(const ViewFilters& a, const ViewFilters& b)
  {
    auto same = testing::AssertionSuccess();
    if (a.Given.HasEye)
    {
      same = IsSame(a.Seen(), b.Seen());
    }
    if (same && a.Given.HasSensors)
    {
      same = IsSame(a.Measured(), b.Measured());
    }
    return same && a.Given.HasPoints ? IsSame(a.AtPoints(), b.AtPoints()) : same;
  }

  std::uint64_t Digest() const
  {
    return (this->Given.HasEye ? this->Seen().Digest() : 0) ^
      (this->Given.HasSensors ? this->Measured().Digest() : 0) ^
      (this->Given.HasPoints ? this->AtPoints().Digest() : 0);
  }

  vtkNew<vtkOutgoingRadianceFilter> Radiance;
  vtkNew<vtkIrradianceProbeFilter> Probe;
  vtkNew<vtkPointIrradianceFilter> Points;

private:
  template <class UpdateView>
  void UpdateEach(const UpdateView& updateView)
  {
    this->EyeErrors->Clear();
    this->SensorErrors->Clear();
    this->PointErrors->Clear();
    if (this->Given.HasEye)
    {
      updateView(this->Radiance);
    }
    if (this->Given.HasSensors)
    {
      updateView(this->Probe);
    }
    if (this->Given.HasPoints)
    {
      updateView(this->Points);
    }
  }

  OutputBits Seen() const { return OutputBits(this->Radiance->GetOutput()); }
  OutputBits AtPoints() const { return OutputBits(this->Points->GetOutput()); }
  OutputBits Measured() const { return OutputBits(this->Probe->GetOutput()); }

  /// Points of polygons with an area have a value; others have none.
  static void ExpectSoundPoints(vtkPolyData* leaf)
  {
    const bool areSidesApart = leaf->GetCellData()->HasArray("IrradianceFront");
    for (const char* name : { areSidesApart ? "PointIrradianceFront" : "PointIrradiance",
           areSidesApart ? "PointIrradianceBack" : "PointIrradiance" })
    {
      vtkDataArray* array = leaf->GetPointData()->GetArray(name);
      ASSERT_NE(array, nullptr) << name;
      for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
      {
        const double light = array->GetVariantValue(i).ToDouble();
        ASSERT_TRUE(std::isnan(light) || (std::isfinite(light) && light >= 0)) << light;
      }
    }
  }

  /// NaN says that no surface faces as the sensor does. Less photons than asked for are all within
  /// the largest radius.
  void ExpectSoundSensor(vtkIdType i) const
  {
    const auto value = [&](const char* name, int band = 0) {
      return this->Probe->GetOutput()->GetPointData()->GetArray(name)->GetComponent(i, band);
    };
    const double photons = value("NumberOfPhotons"), radius = value("SearchRadius");
    vtkDataArray* irradiance = this->Probe->GetOutput()->GetPointData()->GetArray("Irradiance");
    for (int band = 0; band < irradiance->GetNumberOfComponents(); ++band)
    {
      const double light = value("Irradiance", band);
      ASSERT_TRUE(std::isnan(light) ? photons == 0 : std::isfinite(light) && light >= 0)
        << light << " W/m2 at sensor " << i << " from " << photons << " photons";
    }
    ASSERT_LE(photons, this->Given.NumberOfPhotons);
    if (std::isnan(radius)) // it lies off all surface
    {
      ASSERT_TRUE(std::isnan(value("Irradiance")));
      return;
    }
    const double largest = this->Given.MaximumRadius;
    const bool areAll = photons < this->Given.NumberOfPhotons;
    ASSERT_GE(radius, 0);
    ASSERT_TRUE(largest == 0 || (areAll ? radius == largest : radius <= largest))
      << photons << " photons within " << radius;
  }

  RandomModels::View Given;
  vtkNew<vtkCamera> Camera;
  vtkSmartPointer<ErrorObserver> EyeErrors = ErrorObserver::Watch(this->Radiance);
  vtkSmartPointer<ErrorObserver> SensorErrors = ErrorObserver::Watch(this->Probe);
  vtkSmartPointer<ErrorObserver> PointErrors = ErrorObserver::Watch(this->Points);
};
