// SPDX-License-Identifier: BSD-3-Clause
// Lamp files of every kind: whichever way a table is written, its light goes where it should.

#include "LuminaireFiles.h"

#include "vtkNew.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"

using namespace LuminaireFiles;

namespace
{

/// The flux of what is linear in both angles, by Gauss' quadrature with ten nodes in each step.
double Quadrature(vtkPolyData* lamp)
{
  constexpr std::array<double, 5> kNodes{ 0.1488743389816312, 0.4333953941292472,
    0.6794095682990244, 0.8650633666889845, 0.9739065285171717 };
  constexpr std::array<double, 5> kWeights{ 0.2955242247147529, 0.2692667193099963,
    0.2190863625159820, 0.1494513491505806, 0.0666713443086881 };
  const std::vector<double> polar = Field(lamp, "PolarAngles"),
                            azimuth = Field(lamp, "AzimuthAngles"),
                            values = Field(lamp, "RadiantIntensity");
  const std::size_t rows = polar.size();
  double flux = 0;
  for (std::size_t plane = 0; plane < azimuth.size(); ++plane)
  {
    const double before = plane > 0 ? azimuth[plane] - azimuth[plane - 1] : 0,
                 after = plane + 1 < azimuth.size() ? azimuth[plane + 1] - azimuth[plane] : 0,
                 share = azimuth.size() == 1 ? 360 : (before + after) / 2;
    for (std::size_t row = 1; row < rows; ++row)
    {
      const double half = (polar[row] - polar[row - 1]) / 2;
      for (std::size_t node = 0; node < 10; ++node)
      {
        const double x = (node < 5 ? 1 : -1) * kNodes[node % 5],
                     *value = &values[plane * rows + row];
        flux += vtkMath::RadiansFromDegrees(share) * vtkMath::RadiansFromDegrees(half) *
          kWeights[node % 5] * Sin(polar[row - 1] + half * (1 + x)) *
          (value[-1] * (1 - x) + value[0] * (1 + x)) / 2;
      }
    }
  }
  return flux;
}

void ExpectEverywhere(vtkPolyData* lamp, const std::vector<double>& polar,
  const std::vector<double>& azimuth, const std::function<double(double, double)>& value)
{
  for (const double v : polar)
  {
    for (const double h : azimuth)
    {
      const double expected = value(v, h);
      EXPECT_NEAR(Intensity(lamp, DirectionC(v, h)), expected, 1e-9 * expected) << v << ", " << h;
    }
  }
  EXPECT_NEAR(Flux(lamp), Quadrature(lamp), 1e-12 * Flux(lamp));
}

void ExpectLopsided(vtkPolyData* lamp, const Direction& d)
{
  EXPECT_NEAR(Intensity(lamp, d), Lopsided(d), 1e-9) << d[0] << ", " << d[1] << ", " << d[2];
}

}

TEST(LuminaireReader, FluxHasItsClosedForm)
{
  Ies file;
  file.H = { 0 };
  file.Value = [](double, double) { return 3.; };
  const double pi = vtkMath::Pi();
  EXPECT_NEAR(Flux(Read(file.Text())), 4 * pi * 3, 1e-12 * 40);
  file.V = { 0, 10, 11, 90 };
  EXPECT_NEAR(Flux(Read(file.Text())), 2 * pi * 3, 1e-12 * 20);
  file.Value = [](double v, double) { return v / 90; };
  EXPECT_NEAR(Flux(Read(file.Text())), 4, 1e-12 * 4); // 4 times the integral of V sin V
  file.H = { 0, 90, 180, 360 };
  file.V = { 0, 30, 90 };
  file.Value = [](double v, double h) { return v / 90 * (h == 90 ? 2 : h == 180 ? 4 : 1); };
  EXPECT_NEAR(Flux(Read(file.Text())), 4 * (1.5 + 3 + 2 * 2.5) / 4, 1e-12 * 10);
}

TEST(LuminaireReader, FluxIsExactForManySmallSteps)
{
  Ies file;
  file.V = Steps(0, 180, 0.25);
  file.H = Steps(0, 360, 5);
  const auto lamp = Read(file.Text());
  EXPECT_NEAR(Flux(lamp), Quadrature(lamp), 1e-12 * Flux(lamp));
}

// Below the last angle there is light, past it there is none: no ramp.
TEST(LuminaireReader, LightEndsWithItsTable)
{
  Ies file;
  file.V = Steps(0, 90, 15);
  const auto lamp = Read(file.Text());
  EXPECT_EQ(Field(lamp, "PolarAngles").back(), 90);
  EXPECT_GT(Intensity(lamp, DirectionC(89.99, 10)), 10);
  EXPECT_EQ(Intensity(lamp, DirectionC(90.01, 10)), 0);
  file.V = { 0, 45, 60, 60, 90 }; // a jump within it
  const auto jump = Read(file.Text());
  EXPECT_EQ(Field(jump, "PolarAngles"), file.V);
  EXPECT_NEAR(Flux(jump), Quadrature(jump), 1e-12 * Flux(jump));
}

TEST(LuminaireReader, SymmetriesOfTypeCAreWrittenOut)
{
  const std::vector<double> polar = Steps(0, 180, 15), around = Steps(0, 345, 15);
  const auto folded = [](double last) { // the angle of a mirrored table that stands for another
    return [last](double v, double h) {
      h = last <= 180 && h > 180 ? 360 - h : h;
      h = last <= 90 && h > 90 ? 180 - h : h;
      return Lopsided(DirectionC(v, last == 0 ? 0 : h));
    };
  };
  for (const double last : { 0., 90., 180., 360., 345. })
  {
    SCOPED_TRACE(last);
    Ies file;
    file.H = Steps(0, last, 15);
    const auto lamp = Read(file.Text());
    ExpectEverywhere(lamp, polar, around, folded(last));
    const std::vector<double> azimuth = Field(lamp, "AzimuthAngles");
    EXPECT_EQ(azimuth.size(), last == 0 ? 1u : 25u);
    EXPECT_EQ(azimuth.back() - azimuth.front(), last == 0 ? 0 : 360);
  }
  Ies file; // of 1995: mirrored in the plane 90-270, and not turned
  file.H = Steps(90, 270, 15);
  ExpectEverywhere(Read(file.Text()), polar, around, [](double v, double h) {
    return Lopsided(DirectionC(v, h < 90 ? 180 - h : h > 270 ? 540 - h : h));
  });
}

TEST(LuminaireReader, TypesBAndAKeepTheirDirections)
{
  Ies file;
  const std::vector<double> half = Steps(-90, 90, 15);
  const auto directionB = [](double v, double h) {
    return Direction{ Cos(h) * Sin(v), -Sin(h), -Cos(h) * Cos(v) };
  };
  const auto directionA = [](double v, double h) {
    return Direction{ Cos(v) * Cos(h), -Cos(v) * Sin(h), Sin(v) };
  };
  for (const int type : { 2, 3 })
  {
    SCOPED_TRACE(type);
    const auto direction = [&](double v, double h) {
      return type == 2 ? directionB(v, h) : directionA(v, h);
    };
    file.Type = type;
    file.Value = [&](double v, double h) { return Lopsided(direction(v, h)); };
    file.V = file.H = half;
    const auto lamp = Read(file.Text());
    for (const double v : Steps(-75, 75, 15))
    {
      for (const double h : Steps(-75, 75, 15))
      {
        ExpectLopsided(lamp, direction(v, h));
      }
    }
    EXPECT_NEAR(Flux(lamp), Quadrature(lamp), 1e-12 * Flux(lamp));
    EXPECT_NEAR(Flux(lamp), 2 * vtkMath::Pi() * (type == 2 ? 23.5 : 21.5), 1);
    EXPECT_EQ(Intensity(lamp, { 0, 0, type == 2 ? 1. : -0.5 }) > 0, type == 3);
    EXPECT_EQ(Intensity(lamp, { -1, 0, 0.1 }), 0);
    file.H = Steps(0, 90, 15);
    const auto mirrored = Read(file.Text());
    file.V = Steps(0, 90, 15);
    const auto twice = Read(file.Text());
    EXPECT_EQ(Field(twice, "RadiantIntensity").size(), half.size() * half.size());
    EXPECT_NEAR(Intensity(mirrored, direction(-30, -45)), Lopsided(direction(-30, 45)), 1e-9);
    EXPECT_NEAR(Intensity(twice, direction(-30, -45)), Lopsided(direction(30, 45)), 1e-9);
  }
  file.Version = "any lamp"; // 1986: 1 stands for C and A
  file.Type = 1;
  file.V = file.H = half;
  file.Value = [&](double v, double h) { return Lopsided(directionA(v, h)); };
  ExpectLopsided(Read(file.Text()), directionA(-30, 45));
}

TEST(LuminaireReader, SymmetriesOfEulumdatAreWrittenOut)
{
  struct Case
  {
    int Symmetry;
    std::vector<double> Stored;
    std::function<double(double)> Plane; ///< which one stands for a plane
  };
  const auto half = [](double c) { return c > 180 ? 360 - c : c; };
  const auto across = [](double c) { return c > 90 && c < 270 ? 540 - c : c; };
  const std::vector<Case> cases{ { 0, Steps(0, 345, 15), [](double c) { return c; } },
    { 1, { 0 }, [](double) { return 0.; } }, { 2, Steps(0, 180, 15), half },
    { 3, Steps(270, 450, 15), across },
    { 4, Steps(0, 90, 15), [&](double c) { return half(c) > 90 ? 180 - half(c) : half(c); } } };
  for (const Case& c : cases)
  {
    SCOPED_TRACE(c.Symmetry);
    Eulumdat file;
    file.Symmetry = c.Symmetry;
    file.Stored = c.Stored;
    const auto lamp = Read(file.Text());
    ExpectEverywhere(lamp, file.Gamma, file.C,
      [&](double gamma, double plane) { return file.Value(gamma, c.Plane(plane)); });
  }
}

// Of an EULUMDAT file the length lies along y, of an IES file along x: C = H + 90.
TEST(LuminaireReader, OneLampInBothFormatsDiffersByAQuarterTurn)
{
  Ies ies;
  ies.Size = "0.1 1.2 0.05";
  Eulumdat ldt;
  ldt.LitSize = "1200\n100\n50\n50\n50\n50\n";
  ldt.Value = [](double gamma, double c) { return Lopsided(DirectionC(gamma, c - 90)); };
  ies.H = Steps(0, 360, 15);
  const auto first = Read(ies.Text());
  vtkNew<vtkTransform> turn;
  turn->RotateZ(-90);
  vtkNew<vtkTransformPolyDataFilter> turned;
  turned->SetTransform(turn);
  turned->SetInputData(Read(ldt.Text()));
  turned->Update();
  for (const double v : Steps(3, 180, 13))
  {
    for (const double h : Steps(2, 360, 17))
    {
      EXPECT_NEAR(
        Intensity(first, DirectionC(v, h)), Intensity(turned->GetOutput(), DirectionC(v, h)), 1e-9);
    }
  }
  EXPECT_NEAR(Flux(first), Flux(turned->GetOutput()), 1e-9);
  double a[6], b[6];
  first->GetBounds(a);
  turned->GetOutput()->GetBounds(b);
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(a[i], b[i], 1e-12);
  }
}

TEST(LuminaireReader, FactorsDependOnTheVersion)
{
  for (const auto& [version, third] :
    std::vector<std::pair<std::string, double>>{ { "Lamp of 1986", 0.5 }, { "IESNA91", 0.5 },
      { "IESNA:LM-63-1995", 1 }, { "IESNA:LM-63-2002", 1 }, { "IES:LM-63-2019", 1 } })
  {
    Ies file;
    file.Version = version;
    file.H = { 0 };
    file.Value = [](double, double) { return 1.; };
    file.Lamps = "2 700 3";
    file.Factors = "0.8 0.5 10";
    EXPECT_NEAR(Flux(Read(file.Text())), 4 * vtkMath::Pi() * 3 * 0.8 * third, 1e-12) << version;
  }
}

TEST(LuminaireReader, TiltIsReadAndCountsUntilted)
{
  const std::string tilt = "1\n 3 -10, 10\n20 .5 .75, 1\n";
  WriteFile("lamp.tlt", tilt);
  Ies file;
  const double flux = Flux(Read(file.Text()));
  file.Tilt = "INCLUDE\n" + tilt;
  EXPECT_NEAR(Flux(Read(file.Text())), 0.625 * flux, 1e-12 * flux);
  file.Tilt = "C:\\lamps\\lamp.tlt\n";
  EXPECT_NEAR(Flux(Read(file.Text())), 0.625 * flux, 1e-12 * flux);
  file.Tilt = "include\n1 2 0 90 0.5 1";
  file.Lamps = "\n1 -1 1";
  file.Labels = "[OTHER] with TILT=INCLUDE\n";
  EXPECT_NEAR(Flux(Read(file.Text())), 0.5 * flux, 1e-12 * flux);
}

TEST(LuminaireReader, UnitsBecomeWatts)
{
  Ies file;
  file.H = { 0 };
  file.Value = [](double, double) { return 100.; };
  const auto reader = MakeReader(file.Text());
  reader->SetLuminousEfficacy(250);
  EXPECT_NEAR(Flux(Read(reader)), 4 * vtkMath::Pi() * 100 / 250, 1e-12);
  EXPECT_EQ(Word(reader->GetOutput(), "IntensityUnit"), "cd");
  for (const auto& [label, watts] : std::vector<std::pair<std::string, double>>{
         { "[_INTENSITYUNITS] mW/sr\n", 0.1 }, { "[_IntensityUnits] W/sr\n", 100 },
         { "[TEST] Lumens-> mW, lux-> mW/m^2,\n[MORE] candela-> mW/sr\n", 0.1 },
         { "[_INTENSITYUNITS] \xB5W/sr\n", 1e-4 } })
  {
    file.Labels = "[MANUFAC] Maker\n[LUMINAIRE] A\n[MORE] lamp\n" + label;
    const auto radiant = MakeReader(file.Text());
    radiant->SetLuminousEfficacy(0);
    EXPECT_NEAR(Flux(Read(radiant)), 4 * vtkMath::Pi() * watts, 1e-12 * watts * 13);
    EXPECT_EQ(Word(radiant->GetOutput(), "Luminaire"), "A lamp");
    EXPECT_EQ(Word(radiant->GetOutput(), "Manufacturer"), "Maker");
    radiant->SetLuminousEfficacy(250);
    ExpectOne(Update(radiant).Warnings, { "W/sr", "LuminousEfficacy is not needed" });
  }
}

TEST(LuminaireReader, LumensOfTheChosenLampsCountInEulumdat)
{
  Eulumdat file;
  file.Symmetry = 1;
  file.Stored = { 0 };
  file.Value = [](double, double) { return 50.; };
  file.Conversion = "0,5";
  file.Sets = "2\n1\nA\n2000\nx\ny\nz\n-1\nB\n3000,0\nx\ny\nz\n";
  const auto reader = MakeReader(file.Text());
  EXPECT_NEAR(Flux(Read(reader)), 4 * vtkMath::Pi() * 50 * 0.5 * 2, 1e-12 * 700);
  reader->SetLampSet(1);
  EXPECT_NEAR(Flux(Read(reader)), 4 * vtkMath::Pi() * 50 * 0.5 * 3, 1e-12 * 700);
  EXPECT_EQ(Word(reader->GetOutput(), "Luminaire"), "Lamp");
  EXPECT_EQ(Word(reader->GetOutput(), "Manufacturer"), "Maker");
  reader->SetLampSet(2);
  ExpectOne(Update(reader).Errors, { "LampSet is 2", "lamp.any has 2 sets" });
}

TEST(LuminaireReader, TextMayBeWrittenInAnyWay)
{
  Ies ies;
  ies.Labels = "[MANUFAC] M\xFCller\n";
  Eulumdat ldt;
  for (const std::string& text : { ies.Text(), ldt.Text() })
  {
    const auto plain = Read(text);
    const auto replaced = [&](const std::string& old, const std::string& other) {
      std::string result;
      for (const char c : text)
      {
        result += old.find(c) == std::string::npos ? std::string(1, c) : other;
      }
      return result;
    };
    const std::string words = text.substr(0, text.find('\n'));
    for (const std::string& other : { replaced("\n", "\r\n"), replaced("\n", "\r"),
           "\xEF\xBB\xBF" + text, text + "\x1A\x1A more", text.substr(0, text.size() - 1) })
    {
      const auto lamp = Read(other);
      EXPECT_EQ(Field(lamp, "RadiantIntensity"), Field(plain, "RadiantIntensity"));
      EXPECT_EQ(Word(lamp, "Manufacturer"), Word(plain, "Manufacturer")) << words;
    }
  }
  EXPECT_EQ(Word(Read(ies.Text()), "Manufacturer"), "M\xC3\xBCller");
  ies.Labels = "[MANUFAC] M\xC3\xBCller\n";
  EXPECT_EQ(Word(Read(ies.Text()), "Manufacturer"), "M\xC3\xBCller");
}
