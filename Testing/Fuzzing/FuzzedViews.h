// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ByteReader.h"

#include "../FiltersIrradiance/ErrorObserver.h"
#include "../FiltersIrradiance/OutputBits.h"

#include "vtkIrradianceProbeFilter.h"
#include "vtkOutgoingRadianceFilter.h"
#include "vtkPointIrradianceFilter.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

/// An eye and sensors anywhere, also where there is no place, and light at points.
namespace FuzzedViews
{

using irradiance::fuzzing::ByteReader;

[[noreturn]] inline void Fail(const std::string& what)
{
  std::fprintf(stderr, "%s\n", what.c_str());
  std::abort();
}

struct View
{
  bool HasEye = false, HasSensors = false, HasPoints = false;
  TestScenes::Vector Eye{ 0, 0, 0 };
  int NumberOfSpecularSamples = 1;
  TestScenes::Mesh Sensors = TestScenes::Mesh::New();
  int NumberOfPhotons = 4;
  double MaximumRadius = 1; ///< and MaximumDistance
};

/// Finite most of the time.
inline TestScenes::Vector ReadVector(ByteReader& bytes, bool isTame)
{
  const auto number = [&] { return isTame ? bytes.numberWithin(1e200) : bytes.number(); };
  const double x = number(), y = number();
  return { x, y, number() };
}

inline void Read(ByteReader& bytes, View& view)
{
  const bool isTame = !bytes.oneIn(16);
  view.Eye = ReadVector(bytes, isTame);
  view.NumberOfSpecularSamples = 1 + bytes.below(4);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(bytes.oneIn(64) ? 1 : 3);
  for (int i = bytes.below(5); i > 0; --i)
  {
    points->InsertNextPoint(ReadVector(bytes, isTame).data());
    TestScenes::Vector normal = ReadVector(bytes, isTame);
    normal[2] = normal == TestScenes::Vector{ 0, 0, 0 } && isTame ? 1 : normal[2];
    normals->InsertNextTuple(normal.data());
  }
  view.Sensors = TestScenes::Mesh::New();
  view.Sensors->SetPoints(points);
  view.Sensors->GetPointData()->AddArray(normals);
  view.NumberOfPhotons = bytes.byte();
  view.MaximumRadius = bytes.oneIn(2) ? HUGE_VAL : isTame ? 1 + bytes.byte() : bytes.number();
}

/// The filters behind one that computes irradiance.
class Filters
{
public:
  explicit Filters(vtkIrradianceFilter* filter)
  {
    this->Radiance->SetInputConnection(filter->GetOutputPort());
    this->Points->SetInputConnection(filter->GetOutputPort());
    this->Points->SetNumberOfRays(2);
    this->Probe->SetSourceConnection(filter->GetOutputPort());
    this->Probe->SetEstimateToNearest();
  }

  /// Only if the filter has an output: both end in one error, or in sound numbers.
  void Update(const View& view)
  {
    this->Radiance->SetEyePosition(view.Eye.data());
    this->Radiance->SetNumberOfSpecularSamples(view.NumberOfSpecularSamples);
    this->Probe->SetInputData(view.Sensors);
    this->Probe->SetNumberOfPhotons(view.NumberOfPhotons);
    this->Probe->SetMaximumRadius(view.MaximumRadius);
    this->Probe->SetMaximumDistance(view.MaximumRadius);
    if (view.HasPoints)
    {
      Execute(this->Points, this->PointErrors);
      this->CheckPoints();
    }
    if (view.HasEye)
    {
      Execute(this->Radiance, this->RadianceErrors);
      this->CheckRadiance();
    }
    if (view.HasSensors)
    {
      Execute(this->Probe, this->ProbeErrors);
      this->CheckSensors();
    }
  }

  friend testing::AssertionResult IsSame(const Filters& a, const Filters& b)
  {
    const auto atPoints =
      IsSame(OutputBits(a.Points->GetOutput()), OutputBits(b.Points->GetOutput()));
    const auto seen = atPoints
      ? IsSame(OutputBits(a.Radiance->GetOutput()), OutputBits(b.Radiance->GetOutput()))
      : atPoints;
    return seen ? IsSame(OutputBits(a.Measured()), OutputBits(b.Measured())) : seen;
  }

private:
  static void Execute(vtkAlgorithm* filter, ErrorObserver* errors)
  {
    errors->Clear();
    filter->Modified();
    filter->Update();
    if (errors->Errors.size() > 1)
    {
      Fail("two errors: " + errors->Errors[0] + errors->Errors[1]);
    }
  }

  vtkPolyData* Measured() const { return vtkPolyData::SafeDownCast(this->Probe->GetOutput()); }

  void CheckRadiance() const
  {
    const auto radianceOf = [](vtkPolyData* mesh) {
      return std::vector<vtkDataArray*>{ mesh->GetCellData()->GetArray("Radiance") };
    };
    CheckScene("radiance", this->RadianceErrors, this->Radiance->GetOutput(), radianceOf, false);
  }

  void CheckPoints() const
  {
    const auto lightOf = [](vtkPolyData* mesh) {
      const auto find = [mesh](const char* name) { return mesh->GetPointData()->GetArray(name); };
      return find("PointIrradiance")
        ? std::vector<vtkDataArray*>{ find("PointIrradiance") }
        : std::vector<vtkDataArray*>{ find("PointIrradianceFront"), find("PointIrradianceBack") };
    };
    CheckScene("points", this->PointErrors, this->Points->GetOutput(), lightOf, true);
  }

  /// `arraysOf`: a mesh.
  template <class ArraysOf>
  static void CheckScene(const char* what, ErrorObserver* errors, vtkMultiBlockDataSet* output,
    const ArraysOf& arraysOf, bool mayBeUnknown)
  {
    if (errors->Errors.empty() != (output->GetNumberOfBlocks() > 0))
    {
      Fail(what + std::string(": an output and an error, or neither"));
    }
    for (unsigned int port = 0; port < output->GetNumberOfBlocks(); ++port)
    {
      auto* blocks = vtkMultiBlockDataSet::SafeDownCast(output->GetBlock(port));
      for (unsigned int i = 0; i < blocks->GetNumberOfBlocks(); ++i)
      {
        for (vtkDataArray* array : arraysOf(TestScenes::OutputOf(output, port, i)))
        {
          Check(array, mayBeUnknown);
        }
      }
    }
  }

  void CheckSensors()
  {
    vtkPolyData* output = this->Measured();
    vtkDataArray* irradiance = output->GetPointData()->GetArray("Irradiance");
    if (this->ProbeErrors->Errors.empty() != (irradiance != nullptr))
    {
      Fail("sensors: an output and an error, or neither");
    }
    if (irradiance)
    {
      Check(irradiance, true);
    }
  }

  static void Check(vtkDataArray* light, bool mayBeUnknown)
  {
    for (vtkIdType i = 0; i < light->GetNumberOfTuples(); ++i)
    {
      for (int band = 0; band < light->GetNumberOfComponents(); ++band)
      {
        const double value = light->GetComponent(i, band);
        if (!(std::isfinite(value) && value >= 0) && !(mayBeUnknown && std::isnan(value)))
        {
          Fail(light->GetName() + (" " + std::to_string(i)) + " is " + std::to_string(value));
        }
      }
    }
  }

  vtkNew<vtkOutgoingRadianceFilter> Radiance;
  vtkNew<vtkIrradianceProbeFilter> Probe;
  vtkNew<vtkPointIrradianceFilter> Points;
  vtkSmartPointer<ErrorObserver> RadianceErrors = ErrorObserver::Watch(this->Radiance);
  vtkSmartPointer<ErrorObserver> ProbeErrors = ErrorObserver::Watch(this->Probe);
  vtkSmartPointer<ErrorObserver> PointErrors = ErrorObserver::Watch(this->Points);
};

}
