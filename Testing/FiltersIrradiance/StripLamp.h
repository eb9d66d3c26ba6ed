// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "TestScenes.h"

#include <cmath>

/// A plate of rows of cells rides with its rows along the way under a strip lamp that lies across
/// it. All is black.
struct StripLamp
{
  using Mesh = TestScenes::Mesh;

  static constexpr double Length = 1, Width = 0.125, Height = 0.25, Exitance = 1000; // m, W/m2
  static constexpr double Speed = 0.5, Way = 6;                                      // m/s, m
  static constexpr double PlateLength = 1, PlateWidth = 0.75; // m, along and across the way
  static constexpr int Rows = 3;

  /**
   * A lamp element dA sends E = M / pi * h^2 / r^4 dA to a point h below it. On a straight way at
   * the distance a = sqrt(y^2 + h^2) from it, the integral of 1 / r^4 is pi / (2 a^3) / v. So the
   * exposure at y is
   *
   *   M W / (2 v) * [u / sqrt(u^2 + h^2)], u from y - L/2 to y + L/2,
   *
   * and its mean over a row follows from the integral of that, sqrt(u^2 + h^2). What the way leaves
   * out is less than (2 / 3 pi) (h / x)^3 of it for a way from -x to x: 2e-4 at the ends of the
   * plate.
   */
  static double ExposureOfRow(int row)
  {
    const auto integral = [](double y) {
      return std::hypot(y + Length / 2, Height) - std::hypot(y - Length / 2, Height);
    };
    const double step = PlateWidth / Rows, y = -PlateWidth / 2 + row * step;
    return Exitance * Width / (2 * Speed) * (integral(y + step) - integral(y)) / step;
  }

  static Mesh Lamp()
  {
    Mesh lamp = TestScenes::MakeRectangle(
      { -Width / 2, -Length / 2, Height }, { 0, Length, 0 }, { Width, 0, 0 }, 1);
    TestScenes::SetCellValues(lamp, "RadiantExitance", { Exitance });
    return lamp;
  }
  /// Its middle is in the origin.
  static Mesh Plate()
  {
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(-PlateLength / 2, -PlateWidth / 2, 0);
    plane->SetPoint1(PlateLength / 2, -PlateWidth / 2, 0);
    plane->SetPoint2(-PlateLength / 2, PlateWidth / 2, 0);
    plane->SetResolution(1, Rows);
    plane->Update();
    return TestScenes::Copy(plane->GetOutput());
  }
};
