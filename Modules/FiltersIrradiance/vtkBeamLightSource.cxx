// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBeamLightSource.h"

#include "Data/NamedArray.h"
#include "Geometry/Vector.h"
#include "Pipeline/FilterRun.h"
#include "Progress/InputError.h"
#include "Sampling/DirectionTable.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

using namespace irradiance;

vtkStandardNewMacro(vtkBeamLightSource);

namespace
{

/// Intensity over its peak, and the angle at which it has fallen by a number of halves.
class BeamProfile
{
public:
  explicit BeamProfile(vtkBeamLightSource* source)
    : Half(source->GetBeamAngle() / 2)
    , Power(source->GetExponent())
  {
    const double field = source->GetFieldAngle();
    this->IsCosine = source->GetBeamFrom() == vtkBeamLightSource::CosinePower || field == 0;
    if (!this->IsCosine)
    {
      this->Power = std::log(std::log2(10)) / std::log(field / source->GetBeamAngle());
    }
    else if (source->GetBeamFrom() == vtkBeamLightSource::Angles)
    {
      this->Power = -1 / std::log2(std::cos(vtkMath::RadiansFromDegrees(this->Half)));
    }
  }

  double At(double degrees) const
  {
    return this->IsCosine
      ? std::pow(std::max(0., std::cos(vtkMath::RadiansFromDegrees(degrees))), this->Power)
      : std::exp2(-std::pow(degrees / this->Half, this->Power));
  }

  double AngleOf(double halves) const
  {
    return this->IsCosine ? vtkMath::DegreesFromRadians(std::acos(std::exp2(-halves / this->Power)))
                          : this->Half * std::pow(halves, 1 / this->Power);
  }

private:
  double Half, Power;
  bool IsCosine;
};

/// Angles between which the profile is nearly straight: near the middle in equal steps, and where
/// it falls by equal factors.
std::vector<double> PolarAnglesOf(const BeamProfile& profile)
{
  constexpr double kLast = 90, kHalves = 24;
  constexpr int kSteps = 64, kStepsOfHalf = 32;
  std::set<double> angles{ 0 };
  for (int i = 1; i <= kHalves * kStepsOfHalf; ++i)
  {
    angles.insert(std::min(kLast, profile.AngleOf(static_cast<double>(i) / kStepsOfHalf)));
  }
  const double half = std::min(kLast, profile.AngleOf(1));
  for (int i = 1; i < kSteps; ++i)
  {
    angles.insert(half * i / kSteps);
  }
  return { angles.begin(), angles.end() };
}

void AddBeam(vtkFieldData* fields, const BeamProfile& profile, double flux)
{
  const std::vector<double> polar = PolarAnglesOf(profile);
  std::vector<double> values(polar.size());
  std::transform(
    polar.begin(), polar.end(), values.begin(), [&](double angle) { return profile.At(angle); });
  const double scale = flux / DirectionTable(polar, { 0 }, values).integral();
  std::transform(
    values.begin(), values.end(), values.begin(), [scale](double value) { return scale * value; });
  addColumn(fields, "RadiantIntensity", values);
  addColumn(fields, "PolarAngles", polar);
  addColumn(fields, "AzimuthAngles", { 0 });
  addColumn(fields, "Flux", { flux });
}

void AddLamp(vtkPolyData* output, double radius, const Vector3& center, const Vector3& axis,
  const Vector3& reference)
{
  const int corners = radius > 0 ? 32 : 1;
  const double turn = 2 * vtkMath::Pi() / 32;
  const double reach = radius * std::sqrt(turn / std::sin(turn)); // for the area of the disc
  const Vector3 across = axis.cross(reference);
  vtkCellArray* cells = radius > 0 ? output->GetPolys() : output->GetVerts();
  cells->InsertNextCell(corners);
  for (int i = 0; i < corners; ++i)
  {
    const Vector3 corner =
      center + reach * (std::cos(i * turn) * reference + std::sin(i * turn) * across);
    cells->InsertCellPoint(output->GetPoints()->InsertNextPoint(corner.data()));
  }
}

}

vtkBeamLightSource::vtkBeamLightSource()
{
  this->SetNumberOfInputPorts(0);
}

void vtkBeamLightSource::CheckProperties() const
{
  checkWithin("Flux", this->Flux, 0, VTK_DOUBLE_MAX);
  if (this->BeamFrom == CosinePower)
  {
    checkWithin("Exponent", this->Exponent, 0, 1e6);
  }
  else
  {
    checkWithin("BeamAngle", this->BeamAngle, 0.01, 179.9);
    throwIf(
      this->FieldAngle != 0 && !(this->FieldAngle > this->BeamAngle && this->FieldAngle <= 180),
      "FieldAngle is ", this->FieldAngle, "; it has to be more than BeamAngle, ", this->BeamAngle,
      ", to 180, or 0");
  }
  for (int i = 0; i < 3; ++i)
  {
    checkWithin("Center", this->Center[i], -VTK_DOUBLE_MAX, VTK_DOUBLE_MAX);
    checkWithin("Direction", this->Direction[i], -VTK_DOUBLE_MAX, VTK_DOUBLE_MAX);
  }
  throwIf(Vector3(this->Direction).isZero(0), "Direction is 0 0 0");
  checkWithin("Radius", this->Radius, 0, VTK_DOUBLE_MAX);
  checkWithin("NumberOfLamps", this->NumberOfLamps, 1, 100000);
  checkWithin("RingRadius", this->RingRadius, 0, VTK_DOUBLE_MAX);
  checkWithin("Tilt", this->Tilt, -180, 180);
}

int vtkBeamLightSource::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkPolyData* output = vtkPolyData::GetData(outputs);
  return runFilter(this, output, [&] {
    this->CheckProperties();
    const int lamps = this->NumberOfLamps;
    AddBeam(output->GetFieldData(), BeamProfile(this), this->Flux / lamps);
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    output->SetPoints(points);
    output->SetVerts(vtkNew<vtkCellArray>());
    output->SetPolys(vtkNew<vtkCellArray>());
    vtkCellData* cells = output->GetCellData();
    const auto axes = addArray<vtkDoubleArray>(cells, "LampAxis", 3, lamps);
    const auto references = addArray<vtkDoubleArray>(cells, "LampReference", 3, lamps);
    const auto ids = addArray<vtkIntArray>(cells, "LampId", 1, lamps);
    const Vector3 axis = Vector3(this->Direction).stableNormalized();
    const Vector3 side = std::abs(axis[0]) > 0.999999 ? Vector3::UnitY() : Vector3::UnitX();
    const Vector3 first = (side - side.dot(axis) * axis).normalized();
    const double tilt = vtkMath::RadiansFromDegrees(this->Tilt);
    for (int i = 0; i < lamps; ++i)
    {
      const double turn = 2 * vtkMath::Pi() * i / lamps;
      const Vector3 out = std::cos(turn) * first + std::sin(turn) * first.cross(axis);
      const Vector3 ahead = std::cos(tilt) * axis - std::sin(tilt) * out;
      const Vector3 reference = std::cos(tilt) * out + std::sin(tilt) * axis;
      AddLamp(
        output, this->Radius, Vector3(this->Center) + this->RingRadius * out, ahead, reference);
      axes->SetTuple(i, ahead.data());
      references->SetTuple(i, reference.data());
      ids->SetValue(i, i);
    }
    cells->SetNormals(axes); // filters that transform points turn both along
    cells->SetVectors(references);
  });
}

void vtkBeamLightSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const double *center = this->Center, *to = this->Direction;
  os << indent << "Flux: " << this->Flux << "\n"
     << indent << "BeamFrom: " << this->BeamFrom << "\n"
     << indent << "BeamAngle: " << this->BeamAngle << "\n"
     << indent << "FieldAngle: " << this->FieldAngle << "\n"
     << indent << "Exponent: " << this->Exponent << "\n"
     << indent << "Center: " << center[0] << " " << center[1] << " " << center[2] << "\n"
     << indent << "Direction: " << to[0] << " " << to[1] << " " << to[2] << "\n"
     << indent << "Radius: " << this->Radius << "\n"
     << indent << "NumberOfLamps: " << this->NumberOfLamps << "\n"
     << indent << "RingRadius: " << this->RingRadius << "\n"
     << indent << "Tilt: " << this->Tilt << "\n";
}
