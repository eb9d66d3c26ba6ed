// SPDX-License-Identifier: BSD-3-Clause
// Lamps by the angles of their beams: the table by a quadrature of its own, rings, and their light.

#include "ErrorObserver.h"
#include "TestScenes.h"

#include "vtkBeamLightSource.h"

#include <algorithm>
#include <numeric>

using namespace TestScenes;

namespace
{

vtkSmartPointer<vtkBeamLightSource> MakeBeam(double beam, double field, double flux = 1)
{
  auto source = vtkSmartPointer<vtkBeamLightSource>::New();
  source->SetBeamAngle(beam);
  source->SetFieldAngle(field);
  source->SetFlux(flux);
  return source;
}

/// The table of a round lamp.
struct RoundTable
{
  explicit RoundTable(vtkBeamLightSource* source)
  {
    source->Update();
    vtkFieldData* fields = source->GetOutput()->GetFieldData();
    Polar = ValuesOf(fields->GetArray("PolarAngles"));
    Intensity = ValuesOf(fields->GetArray("RadiantIntensity"));
    EXPECT_EQ(ValuesOf(fields->GetArray("AzimuthAngles")), std::vector<double>{ 0 });
    EXPECT_TRUE(std::is_sorted(Polar.begin(), Polar.end()));
    EXPECT_EQ(Polar.size(), Intensity.size());
    EXPECT_LE(Polar.back(), 90);
  }

  double At(double degrees) const
  {
    const auto i = static_cast<std::size_t>(
      std::upper_bound(Polar.begin(), Polar.end(), degrees) - Polar.begin());
    if (i == 0 || i == Polar.size())
    {
      return degrees == Polar.back() ? Intensity.back() : 0;
    }
    const double part = (degrees - Polar[i - 1]) / (Polar[i] - Polar[i - 1]);
    return Intensity[i - 1] + part * (Intensity[i] - Intensity[i - 1]);
  }

  /// Of what is linear: by the midpoint rule in parts of each step.
  double Flux() const
  {
    double sum = 0;
    constexpr int kParts = 100;
    for (std::size_t i = 1; i < Polar.size(); ++i)
    {
      const double width = (Polar[i] - Polar[i - 1]) / kParts;
      for (int part = 0; part < kParts; ++part)
      {
        const double angle = Polar[i - 1] + (part + 0.5) * width;
        sum += At(angle) * std::sin(vtkMath::RadiansFromDegrees(angle)) * width;
      }
    }
    return 2 * vtkMath::Pi() * vtkMath::RadiansFromDegrees(sum);
  }

  std::vector<double> Polar, Intensity;
};

/// How much light, of all, the table has elsewhere than the formula.
double MisplacedPart(const RoundTable& table, double (*formula)(double, double), double parameter)
{
  double off = 0, all = 0;
  constexpr int kParts = 200000;
  for (int i = 0; i < kParts; ++i)
  {
    const double angle = 90 * (i + 0.5) / kParts;
    const double weight = std::sin(vtkMath::RadiansFromDegrees(angle));
    const double right = formula(angle, parameter);
    off += weight * std::abs(table.At(angle) / table.Intensity[0] - right);
    all += weight * right;
  }
  return off / all;
}

double PowerOfCosine(double degrees, double exponent)
{
  return std::pow(std::cos(vtkMath::RadiansFromDegrees(degrees)), exponent);
}

std::string ErrorOf(vtkBeamLightSource* source)
{
  const Reports reports = Update(source);
  EXPECT_EQ(reports.Errors.size(), 1u);
  EXPECT_EQ(source->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(source->GetOutput()->GetFieldData()->GetNumberOfArrays(), 0);
  return reports.Errors.empty() ? "" : reports.Errors[0];
}

/// E on a small horizontal cell, a distance below the origin.
double IrradianceBelow(vtkBeamLightSource* source, double distance)
{
  source->Update();
  const double side = 0.002 * distance;
  const auto filter = MakeDefaultFilter(
    { { Copy(source->GetOutput()),
        MakeRectangle({ -side / 2, -side / 2, -distance }, { side, 0, 0 }, { 0, side, 0 }, 1) },
      {} },
    20000);
  filter->SetMethodToGathered();
  ExpectNothing(Update(filter));
  return IrradianceOf(filter, 0, 1)->GetComponent(0, 0);
}

}

TEST(BeamLightSource, HasHalfOfItsPeakAtTheBeamAngleAndATenthAtTheFieldAngle)
{
  const double angles[][2] = { { 60, 100 }, { 24, 25 }, { 0.1, 0.3 }, { 10, 170 }, { 120, 180 },
    { 0.02, 179 }, { 89, 90 } };
  for (const auto& [beam, field] : angles)
  {
    const RoundTable table(MakeBeam(beam, field, 7));
    EXPECT_NEAR(table.At(beam / 2) / table.At(0), 0.5, 1e-9) << beam;
    EXPECT_NEAR(table.At(field / 2) / table.At(0), 0.1, 1e-4) << beam;
    EXPECT_NEAR(table.Flux(), 7, 7e-4) << beam;
  }
}

TEST(BeamLightSource, TakesThePowerOfTheCosineFromTheBeamAngleAlone)
{
  for (const double beam : { 0.1, 10., 60., 120., 179. })
  {
    const RoundTable table(MakeBeam(beam, 0, 3));
    const double half = vtkMath::RadiansFromDegrees(beam / 2);
    const double exponent = std::log(0.5) / std::log(std::cos(half));
    EXPECT_NEAR(table.At(beam / 2) / table.At(0), 0.5, 1e-9) << beam;
    // The flux of I0 cos^n is 2 pi I0 / (n + 1).
    EXPECT_NEAR(table.At(0), 3 * (exponent + 1) / (2 * vtkMath::Pi()), 1e-3 * table.At(0)) << beam;
    EXPECT_LT(MisplacedPart(table, PowerOfCosine, exponent), 1e-3) << beam;
    EXPECT_NEAR(table.Flux(), 3, 3e-4) << beam;
  }
}

TEST(BeamLightSource, TakesAnExponent)
{
  for (const double exponent : { 0., 0.01, 1., 3., 1000. })
  {
    auto source = MakeBeam(20, 40);
    source->SetBeamFromToCosinePower();
    source->SetExponent(exponent);
    const RoundTable table(source);
    EXPECT_NEAR(table.At(0), (exponent + 1) / (2 * vtkMath::Pi()), 1e-3 * table.At(0)) << exponent;
    EXPECT_LT(MisplacedPart(table, PowerOfCosine, exponent), 1e-3) << exponent;
  }
}

// exp(-ln 2 (2 t)^p) of beams of one degree, from nearly a cone to nearly all in the tail.
TEST(BeamLightSource, FollowsTheFormula)
{
  for (const double power : { 40., 8., 2., 1., 0.4 })
  {
    const double ratio = std::pow(std::log2(10), 1 / power);
    const auto formula = [](double degrees, double p) {
      return std::exp2(-std::pow(2 * degrees, p));
    };
    EXPECT_LT(MisplacedPart(RoundTable(MakeBeam(1, ratio)), formula, power), 1e-3) << power;
  }
}

TEST(BeamLightSource, IsAPointOrADisc)
{
  auto source = MakeBeam(40, 0);
  source->SetCenter(1, 2, 3);
  source->Update();
  ASSERT_EQ(source->GetOutput()->GetNumberOfVerts(), 1);
  EXPECT_EQ(source->GetOutput()->GetNumberOfCells(), 1);
  EXPECT_EQ(source->GetOutput()->GetPoint(0)[2], 3);
  source->SetRadius(0.5);
  source->SetDirection(3, 0, 4);
  source->Update();
  vtkPolyData* lamp = source->GetOutput();
  ASSERT_EQ(lamp->GetNumberOfPolys(), 1);
  EXPECT_EQ(lamp->GetNumberOfCells(), 1);
  const Vector normal = PolygonNormal(lamp, lamp->GetCell(0)->GetPointIds());
  const Vector axis{ 0.6, 0, 0.8 };
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(normal[i], 2 * vtkMath::Pi() * 0.25 * axis[i], 1e-12);
    EXPECT_NEAR(lamp->GetCellData()->GetNormals()->GetComponent(0, i), axis[i], 1e-12);
  }
}

TEST(BeamLightSource, StandsInARing)
{
  auto source = MakeBeam(30, 50, 8);
  source->SetNumberOfLamps(4);
  source->SetRingRadius(0.1);
  source->SetTilt(30);
  source->SetRadius(0.005);
  source->SetCenter(0, 0, 0.2);
  source->Update();
  vtkPolyData* ring = source->GetOutput();
  ASSERT_EQ(ring->GetNumberOfCells(), 4);
  EXPECT_EQ(ring->GetNumberOfPoints(), 4 * 32);
  EXPECT_EQ(ring->GetFieldData()->GetArray("Flux")->GetTuple1(0), 2);
  EXPECT_EQ(ValuesOf(ring->GetCellData()->GetArray("LampId")), (std::vector<double>{ 0, 1, 2, 3 }));
  vtkDataArray* axes = ring->GetCellData()->GetArray("LampAxis");
  vtkDataArray* references = ring->GetCellData()->GetArray("LampReference");
  EXPECT_EQ(axes, ring->GetCellData()->GetNormals());
  EXPECT_EQ(references, ring->GetCellData()->GetVectors());
  const Vector out[] = { { 1, 0, 0 }, { 0, 1, 0 }, { -1, 0, 0 }, { 0, -1, 0 } };
  for (int lamp = 0; lamp < 4; ++lamp)
  {
    double center[3] = { 0, 0, 0 }, axis[3], reference[3];
    for (int corner = 0; corner < 32; ++corner)
    {
      vtkMath::Add(center, ring->GetPoint(32 * lamp + corner), center);
    }
    vtkMath::MultiplyScalar(center, 1. / 32);
    axes->GetTuple(lamp, axis);
    references->GetTuple(lamp, reference);
    EXPECT_NEAR(vtkMath::Dot(axis, reference), 0, 1e-12);
    // All look at one point.
    const double ahead = 0.1 / std::sin(vtkMath::RadiansFromDegrees(30.));
    for (int i = 0; i < 3; ++i)
    {
      EXPECT_NEAR(center[i], (i == 2 ? 0.2 : 0) + 0.1 * out[lamp][i], 1e-12);
      EXPECT_NEAR(center[i] + ahead * axis[i], i == 2 ? 0.2 - 0.1 * std::sqrt(3) : 0, 1e-12);
    }
  }
}

TEST(BeamLightSource, LightsWhatIsBelow)
{
  auto source = MakeBeam(20, 40, 5);
  const double intensity = RoundTable(source).At(0);
  EXPECT_NEAR(IrradianceBelow(source, 2), intensity / 4, 1e-3 * intensity / 4);
  source->SetRadius(0.01); // a small disc
  EXPECT_NEAR(IrradianceBelow(source, 2), intensity / 4, 5e-3 * intensity / 4);
  // A ring that looks at the cell: each lamp at the distance d shines at 30 degrees.
  source->SetRadius(0);
  source->SetNumberOfLamps(6);
  source->SetRingRadius(1);
  source->SetTilt(30);
  const double expected = intensity / 4 * std::cos(vtkMath::RadiansFromDegrees(30.));
  EXPECT_NEAR(IrradianceBelow(source, std::sqrt(3)), expected, 2e-3 * expected);
}

TEST(BeamLightSource, RefusesWhatCannotBe)
{
  auto source = MakeBeam(60, 50);
  ExpectWords(ErrorOf(source), { "FieldAngle is 50", "more than BeamAngle, 60" });
  source->SetFieldAngle(181);
  ExpectWords(ErrorOf(source), { "FieldAngle is 181" });
  source = MakeBeam(180, 0);
  ExpectWords(ErrorOf(source), { "BeamAngle is 180", "0.01 to 179.9" });
  source->SetBeamFromToCosinePower(); // then it does not matter
  source->SetExponent(-1);
  ExpectWords(ErrorOf(source), { "Exponent is -1", "0 to 1000000" });
  source = MakeBeam(60, 0, -2);
  ExpectWords(ErrorOf(source), { "Flux is -2", "0 or more" });
  source = MakeBeam(60, 0);
  source->SetDirection(0, 0, 0);
  ExpectWords(ErrorOf(source), { "Direction is 0 0 0" });
  source->SetDirection(1, vtkMath::Nan(), 0);
  ExpectWords(ErrorOf(source), { "Direction is nan", "finite" });
  source = MakeBeam(60, 0);
  source->SetNumberOfLamps(0);
  ExpectWords(ErrorOf(source), { "NumberOfLamps is 0" });
  source->SetNumberOfLamps(3);
  source->SetRadius(vtkMath::Inf());
  ExpectWords(ErrorOf(source), { "Radius is inf", "0 or more" });
  source->SetRadius(0);
  source->SetTilt(200);
  ExpectWords(ErrorOf(source), { "Tilt is 200", "-180 to 180" });
  source->SetTilt(0);
  ExpectNothing(Update(source));
}

TEST(BeamLightSource, PrintsItself)
{
  std::ostringstream text;
  vtkNew<vtkBeamLightSource>()->Print(text);
  ExpectWords(text.str(), { "BeamAngle: 60", "Direction: 0 0 -1", "NumberOfLamps: 1" });
}
