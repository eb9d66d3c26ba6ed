// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../WriteFile.h"
#include "ErrorObserver.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkLuminaireReader.h"
#include "vtkMath.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

/// Lamp files as text, and what the reader makes of them.
namespace LuminaireFiles
{

using Direction = std::array<double, 3>;

inline double Cos(double degrees)
{
  return std::cos(vtkMath::RadiansFromDegrees(degrees));
}
inline double Sin(double degrees)
{
  return std::sin(vtkMath::RadiansFromDegrees(degrees));
}

/// Of IES type C, and EULUMDAT.
inline Direction DirectionC(double v, double h)
{
  return { Sin(v) * Cos(h), Sin(v) * Sin(h), -Cos(v) };
}

/// An intensity without any symmetry.
inline double Lopsided(const Direction& d)
{
  return 20 + 3 * d[0] + 5 * d[1] - 7 * d[2] + 2 * d[0] * d[1] + d[1] * d[2];
}

inline std::vector<double> Steps(double first, double last, double step)
{
  std::vector<double> steps;
  for (int i = 0; first + i * step <= last; ++i)
  {
    steps.push_back(first + i * step);
  }
  return steps;
}

/// A file of EULUMDAT or IES: numbers in lines of their own, as exact as they are.
template <class... Values>
std::string Lines(const Values&... values)
{
  std::ostringstream stream;
  stream.precision(17);
  ((stream << values << "\n"), ...);
  return stream.str();
}

inline std::string List(const std::vector<double>& values)
{
  std::ostringstream stream;
  stream.precision(17);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    stream << values[i] << (i % 7 == 6 ? ",\n" : i % 2 ? " " : ", ");
  }
  return stream.str() + "\n";
}

struct Ies
{
  std::string Version = "IESNA:LM-63-2002", Labels = "[TEST] none\n", Tilt = "NONE\n";
  std::string Lamps = "1 -1 1"; ///< and the multiplier
  int Type = 1, Units = 2;
  std::string Size = "0 0 0", Factors = "1 1 10";
  std::vector<double> V = Steps(0, 180, 15), H = Steps(0, 360, 30);
  std::function<double(double, double)> Value = [](double v, double h) {
    return Lopsided(DirectionC(v, h));
  };

  std::string Text() const
  {
    std::vector<double> values;
    for (const double h : this->H)
    {
      for (const double v : this->V)
      {
        values.push_back(this->Value(v, h));
      }
    }
    return Lines(this->Version) + this->Labels + "TILT=" + this->Tilt + this->Lamps +
      Lines("", this->V.size(), this->H.size(), this->Type, this->Units, this->Size) +
      Lines(this->Factors) + List(this->V) + List(this->H) + List(values);
  }
};

struct Eulumdat
{
  int Symmetry = 0;
  std::vector<double> C = Steps(0, 345, 15), Gamma = Steps(0, 180, 15);
  std::vector<double> Stored = Steps(0, 345, 15); ///< the planes of which there are values
  std::string LitSize = "0\n0\n0\n0\n0\n0\n";     ///< lines 16 to 21, mm
  std::string OutputRatio = "0", Conversion = "1.0";
  std::string Sets = "1\n1\nLED\n1000\n4000\n80\n20\n";
  std::function<double(double, double)> Value = [](double gamma, double c) {
    return Lopsided(DirectionC(gamma, c));
  };

  std::string Text() const
  {
    std::string text = Lines("Maker", 2, this->Symmetry, this->C.size(), 15, this->Gamma.size(), 15,
                         "report", "Lamp", "4711", "lamp.ldt", "today", 600, 600, 50) +
      this->LitSize + Lines("100", this->OutputRatio, this->Conversion, 0) + this->Sets +
      Lines(.1, .2, .3, .4, .5, .6, .7, .8, .9, 1);
    for (const auto& angles : { this->C, this->Gamma })
    {
      for (const double angle : angles)
      {
        text += Lines(angle);
      }
    }
    for (const double c : this->Stored)
    {
      for (const double gamma : this->Gamma)
      {
        text += Lines(this->Value(gamma, c));
      }
    }
    return text;
  }
};

/// A reader of a file with this text.
inline vtkSmartPointer<vtkLuminaireReader> MakeReader(
  const std::string& text, const std::string& name = "lamp.any")
{
  auto reader = vtkSmartPointer<vtkLuminaireReader>::New();
  reader->SetFileName(WriteFile(name, text).c_str());
  reader->SetLuminousEfficacy(1);
  return reader;
}

/// What was read; without an error and a warning.
inline vtkSmartPointer<vtkPolyData> Read(vtkLuminaireReader* reader)
{
  ExpectNothing(Update(reader));
  return reader->GetOutput();
}
inline vtkSmartPointer<vtkPolyData> Read(const std::string& text)
{
  return Read(MakeReader(text));
}

inline std::vector<double> Field(vtkPolyData* lamp, const char* name)
{
  auto* array = vtkDoubleArray::SafeDownCast(lamp->GetFieldData()->GetArray(name));
  return array
    ? std::vector<double>(array->GetPointer(0), array->GetPointer(array->GetNumberOfTuples()))
    : std::vector<double>();
}

inline std::string Word(vtkPolyData* lamp, const char* name)
{
  auto* array = vtkStringArray::SafeDownCast(lamp->GetFieldData()->GetAbstractArray(name));
  return array ? std::string(array->GetValue(0)) : "";
}

inline double Flux(vtkPolyData* lamp)
{
  return Field(lamp, "Flux").at(0);
}

/// The step of angles that a value is in, and where in it; `at` exactly on an angle: 0.
inline std::array<double, 2> Place(const std::vector<double>& angles, double at)
{
  const auto above = std::upper_bound(angles.begin(), angles.end() - 1, at);
  const auto i = std::max<std::ptrdiff_t>(above - angles.begin() - 1, 0);
  const double low = angles[static_cast<std::size_t>(i)],
               step = angles[static_cast<std::size_t>(i) + 1] - low;
  return { static_cast<double>(i), step > 0 ? (at - low) / step : 1 };
}

/// The intensity in a direction, found as the description of the output says.
inline double Intensity(vtkPolyData* lamp, const Direction& d)
{
  double axis[3], reference[3], across[3];
  lamp->GetCellData()->GetNormals()->GetTuple(0, axis);
  lamp->GetCellData()->GetVectors()->GetTuple(0, reference);
  vtkMath::Cross(reference, axis, across);
  const double x = vtkMath::Dot(d.data(), reference), y = vtkMath::Dot(d.data(), across);
  constexpr double kRounding = 1e-9;
  const double polar =
    vtkMath::DegreesFromRadians(std::atan2(std::hypot(x, y), vtkMath::Dot(d.data(), axis)));
  const std::vector<double> polars = Field(lamp, "PolarAngles"),
                            azimuths = Field(lamp, "AzimuthAngles"),
                            values = Field(lamp, "RadiantIntensity");
  double azimuth = vtkMath::DegreesFromRadians(std::atan2(y, x));
  while (azimuth < azimuths.front() - kRounding)
  {
    azimuth += 360;
  }
  const bool isRound = azimuths.size() == 1;
  if (polar < polars.front() - kRounding || polar > polars.back() + kRounding ||
    (!isRound && azimuth > azimuths.back() + kRounding))
  {
    return 0;
  }
  const auto [row, v] = Place(polars, polar);
  const auto [plane, h] = isRound ? std::array<double, 2>{ 0, 0 } : Place(azimuths, azimuth);
  const auto value = [&, r = row, p = plane](int i, int j) {
    return values[static_cast<std::size_t>(p + (isRound ? 0 : j)) * polars.size() +
      static_cast<std::size_t>(r + i)];
  };
  return (1 - h) * ((1 - v) * value(0, 0) + v * value(1, 0)) +
    h * ((1 - v) * value(0, 1) + v * value(1, 1));
}

}
