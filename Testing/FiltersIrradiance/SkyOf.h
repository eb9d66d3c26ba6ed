// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkMath.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkSunSkySource.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

/// What the field data of a vtkSunSkySource say, read as a user would.
class SkyOf
{
public:
  using Direction = std::array<double, 3>;

  explicit SkyOf(vtkSunSkySource* source)
  {
    source->Update();
    Read(source->GetOutput());
  }
  SkyOf(vtkSunSkySource* source, double time)
  {
    source->UpdateTimeStep(time);
    Read(source->GetOutput());
  }

  static Direction Towards(double polar, double azimuth)
  {
    const double z = vtkMath::RadiansFromDegrees(polar), a = vtkMath::RadiansFromDegrees(azimuth);
    return { std::sin(z) * std::sin(a), std::sin(z) * std::cos(a), std::cos(z) };
  }

  /// Bilinear between the angles; degrees.
  double At(double polar, double azimuth) const
  {
    const std::size_t z = Cell(PolarAngles, polar);
    const double v = Share(PolarAngles, z, polar);
    const auto column = [&](std::size_t a) {
      const double* values = Radiance.data() + a * PolarAngles.size();
      return (1 - v) * values[z] + v * values[z + 1];
    };
    if (Azimuths.size() == 1)
    {
      return column(0);
    }
    const double turned = azimuth - 360 * std::floor(azimuth / 360);
    const std::size_t a = Cell(Azimuths, turned);
    const double u = Share(Azimuths, a, turned);
    return (1 - u) * column(a) + u * column(a + 1);
  }

  /// The integral of radiance times `weight` over the directions of polar angles up to `last`.
  double Integral(const std::function<double(const Direction&)>& weight, double last = 90) const
  {
    std::vector<double> azimuths = Azimuths;
    while (azimuths.back() < 360) // of a round sky
    {
      azimuths.push_back(azimuths.back() + 5);
    }
    double sum = 0;
    for (std::size_t z = 0; z + 1 < PolarAngles.size() && PolarAngles[z + 1] <= last; ++z)
    {
      for (std::size_t a = 0; a + 1 < azimuths.size(); ++a)
      {
        sum += OverCell(
          { PolarAngles[z], PolarAngles[z + 1] }, { azimuths[a], azimuths[a + 1] }, weight);
      }
    }
    return sum;
  }

  /// On a plane with this normal, of the sky alone.
  double Irradiance(const Direction& normal, double last = 90) const
  {
    return Integral(
      [&](const Direction& w) { return std::max(0., vtkMath::Dot(w.data(), normal.data())); },
      last);
  }

  std::vector<double> Radiance, PolarAngles, Azimuths;
  Direction Sun{};
  double SunIrradiance = -1, SunRadius = -1;
  std::string Note;

private:
  using Ends = std::array<double, 2>;

  void Read(vtkPolyData* data)
  {
    vtkFieldData* fields = data->GetFieldData();
    const auto read = [&](const char* name) {
      auto* array = vtkDoubleArray::SafeDownCast(fields->GetArray(name));
      return array ? std::vector<double>(
                       array->GetPointer(0), array->GetPointer(0) + array->GetNumberOfValues())
                   : std::vector<double>();
    };
    Radiance = read("SkyRadiance");
    PolarAngles = read("SkyPolarAngles");
    Azimuths = read("SkyAzimuths");
    const auto sun = read("SunDirection"), power = read("SunIrradiance"),
               radius = read("SunAngularRadius");
    ASSERT_EQ(Radiance.size(), PolarAngles.size() * Azimuths.size());
    ASSERT_EQ(sun.size() + power.size() + radius.size(), 5u);
    ASSERT_EQ(data->GetNumberOfPoints() + data->GetNumberOfCells(), 0);
    std::copy(sun.begin(), sun.end(), Sun.begin());
    SunIrradiance = power[0];
    SunRadius = radius[0];
    auto* note = fields->GetAbstractArray("SkyNote");
    Note = note ? note->GetVariantValue(0).ToString() : "";
    EXPECT_TRUE(std::is_sorted(PolarAngles.begin(), PolarAngles.end()));
    EXPECT_TRUE(std::is_sorted(Azimuths.begin(), Azimuths.end()));
    EXPECT_GE(*std::min_element(Radiance.begin(), Radiance.end()), 0);
  }

  /// The last cell that an angle is in, so of a jump the part behind it.
  static std::size_t Cell(const std::vector<double>& angles, double angle)
  {
    const auto after = std::upper_bound(angles.begin() + 1, angles.end() - 1, angle);
    return static_cast<std::size_t>(after - angles.begin() - 1);
  }
  static double Share(const std::vector<double>& angles, std::size_t i, double angle)
  {
    return (angle - angles[i]) / (angles[i + 1] - angles[i]);
  }

  /// Gauss and Legendre, four points along each side.
  double OverCell(const Ends& polar, const Ends& azimuth,
    const std::function<double(const Direction&)>& weight) const
  {
    constexpr double kPoints[4] = { -.8611363116, -.3399810436, .3399810436, .8611363116 };
    constexpr double kWeights[4] = { .3478548451, .6521451549, .6521451549, .3478548451 };
    const Ends size = { (polar[1] - polar[0]) / 2, (azimuth[1] - azimuth[0]) / 2 };
    const double area = vtkMath::RadiansFromDegrees(size[0]) * vtkMath::RadiansFromDegrees(size[1]);
    double sum = 0;
    for (int i = 0; i < 16 && area > 0; ++i)
    {
      const double z = polar[0] + size[0] * (1 + kPoints[i / 4]);
      const double a = azimuth[0] + size[1] * (1 + kPoints[i % 4]);
      const Direction w = Towards(z, a);
      sum += kWeights[i / 4] * kWeights[i % 4] * area * At(z, a) *
        std::sin(vtkMath::RadiansFromDegrees(z)) * weight(w);
    }
    return sum;
  }
};
